// SPDX-License-Identifier: Apache-2.0
#include "bench/nff_statements.hpp"

#include "src/load/polygon.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace fastrt::bench {
namespace {

class Statements {
public:
  Statements(std::istream& in, NffWriter& writer) : in_(in), writer_(writer) {}

  // All up to the end of the file; false if one of them is not NFF.
  bool run();

private:
  Vec3 vector();
  float radius();
  void view();
  void write_lights();
  void fill();
  void cone();
  void polygon(bool patch);
  bool statement(const std::string& word);

  std::istream& in_;
  NffWriter& writer_;
  std::vector<Vec3> lights_; // that wait: how bright each is depends on how many there are
  bool lights_written_ = false;
  PolygonTriangulator triangulator_;
};

Vec3 Statements::vector() {
  Vec3 v{0.0F};
  in_ >> v.x >> v.y >> v.z;
  return v;
}

float Statements::radius() {
  float radius = 0;
  in_ >> radius;
  return std::abs(radius);
}

void Statements::view() {
  std::string word;
  NffView view;
  float hither = 0, width = 0, height = 0;
  in_ >> word, view.from = vector(), in_ >> word, view.at = vector(), in_ >> word, view.up = vector();
  in_ >> word >> view.angle >> word >> hither >> word >> width >> height;
  writer_.view(view);
}

void Statements::write_lights() {
  if (lights_written_) return;
  lights_written_ = true;
  const float intensity = 1.0F / std::sqrt(static_cast<float>(std::max<std::size_t>(1, lights_.size())));
  for (const Vec3& light : lights_) writer_.light(light, intensity);
}

void Statements::fill() {
  NffFill fill;
  fill.color = vector();
  in_ >> fill.diffuse >> fill.specular >> fill.shine >> fill.transmittance >> fill.ior;
  write_lights();
  writer_.fill(fill);
}

void Statements::cone() {
  NffCone cone;
  cone.base = vector();
  cone.base_radius = radius();
  cone.apex = vector();
  cone.apex_radius = radius();
  writer_.cone(cone);
}

void Statements::polygon(bool patch) {
  std::size_t count = 0;
  in_ >> count;
  if (!in_ || count < 3) return;
  std::vector<Vec3> corners(count), normals(count);
  for (std::size_t i = 0; i < count; ++i) {
    corners[i] = vector();
    if (patch) normals[i] = vector();
  }
  std::vector<PolygonTriangulator::Triangle> triangles;
  triangulator_.run(corners, triangles);
  for (const auto& t : triangles)
    writer_.triangle({{corners[t[0]], corners[t[1]], corners[t[2]]},
                      {normals[t[0]], normals[t[1]], normals[t[2]]},
                      patch});
}

bool Statements::statement(const std::string& word) {
  if (word == "v")
    view();
  else if (word == "b")
    writer_.background(vector());
  else if (word == "l")
    lights_.push_back(vector());
  else if (word == "f")
    fill();
  else if (word == "c")
    cone();
  else if (word == "p" || word == "pp")
    polygon(word == "pp");
  else if (word == "s") {
    const Vec3 center = vector();
    writer_.sphere(center, radius());
  } else if (word[0] != '#') {
    return false;
  }
  return true;
}

bool Statements::run() {
  for (std::string word; in_ >> word;) {
    if (!statement(word)) return false;
    if (word[0] == '#' || word == "l") in_.ignore(1 << 20, '\n'); // a comment; a light's colour
    if (!in_ && !in_.eof()) return false;
  }
  writer_.end();
  return true;
}

} // namespace

void read_nff_statements(const std::filesystem::path& nff, NffWriter& writer) {
  std::ifstream in(nff);
  if (!in || !Statements(in, writer).run()) throw InputError(nff.string() + ": not NFF");
}

} // namespace fastrt::bench
