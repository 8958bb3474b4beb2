// SPDX-License-Identifier: Apache-2.0
#include "bench/povray_nff.hpp"

#include "src/load/polygon.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace fastrt::bench {
namespace {

std::ostream& operator<<(std::ostream& out, const Vec3& v) {
  return out << '<' << v.x << ',' << v.y << ',' << v.z << '>';
}

class Writer {
public:
  Writer(std::istream& in, std::ostream& out) : in_(in), out_(out) {}

  // All statements up to the end of the file; false if one of them is not NFF.
  bool run(int depth);

private:
  Vec3 vector();
  void view();
  void fill();
  void cone();
  void polygon(bool patch);
  void open_mesh();
  void close_mesh();

  std::istream& in_;
  std::ostream& out_;
  std::string texture_; // of what follows
  std::vector<Vec3> lights_;
  bool lights_written_ = false, in_mesh_ = false;
  void write_lights();
  PolygonTriangulator triangulator_;
};

Vec3 Writer::vector() {
  Vec3 v{0.0F};
  in_ >> v.x >> v.y >> v.z;
  return v;
}

void Writer::view() {
  std::string word;
  Vec3 from{0.0F}, at{0.0F}, up{0.0F};
  float angle = 0, hither = 0, width = 0, height = 0;
  in_ >> word, from = vector(), in_ >> word, at = vector(), in_ >> word, up = vector();
  in_ >> word >> angle >> word >> hither >> word >> width >> height;
  out_ << "camera { perspective right -x up y angle " << angle << " location " << from << " sky " << up
       << " look_at " << at << " }\n";
}

// Lights without a colour share 1 / sqrt(count), as in fastrt, so they wait for the first object.
void Writer::write_lights() {
  if (lights_written_) return;
  lights_written_ = true;
  const double intensity = 1.0 / std::sqrt(static_cast<double>(std::max<std::size_t>(1, lights_.size())));
  for (const Vec3& light : lights_) out_ << "light_source { " << light << " rgb " << intensity << " }\n";
}

void Writer::fill() {
  const Vec3 color = vector();
  float diffuse = 0, specular = 0, shine = 0, transmittance = 0, ior = 0;
  in_ >> diffuse >> specular >> shine >> transmittance >> ior;
  std::ostringstream text;
  text << " pigment { rgbt <" << color.x << ',' << color.y << ',' << color.z << ',' << transmittance
       << "> } finish { ambient 0 diffuse " << diffuse << " phong " << specular << " phong_size "
       << std::max(1.0F, shine) << " reflection " << specular << " }";
  if (transmittance > 0) text << " interior { ior " << (ior > 0 ? ior : 1.0F) << " }";
  texture_ = text.str();
}

void Writer::cone() {
  const Vec3 base = vector();
  float base_radius = 0, apex_radius = 0;
  in_ >> base_radius;
  const Vec3 apex = vector();
  in_ >> apex_radius;
  base_radius = std::abs(base_radius);
  apex_radius = std::abs(apex_radius);
  if (base_radius == apex_radius)
    out_ << "cylinder { " << base << ", " << apex << ", " << base_radius;
  else
    out_ << "cone { " << base << ", " << base_radius << ", " << apex << ", " << apex_radius;
  out_ << " open" << texture_ << " }\n";
}

void Writer::open_mesh() {
  if (!in_mesh_) out_ << "mesh {\n";
  in_mesh_ = true;
}

void Writer::close_mesh() {
  if (in_mesh_) out_ << texture_ << " }\n";
  in_mesh_ = false;
}

void Writer::polygon(bool patch) {
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
  open_mesh();
  for (const auto& triangle : triangles) {
    out_ << (patch ? "smooth_triangle {" : "triangle {");
    for (std::size_t i = 0; i < 3; ++i) {
      out_ << (i == 0 ? " " : ", ") << corners[triangle[i]];
      if (patch) out_ << ", " << normals[triangle[i]];
    }
    out_ << " }\n";
  }
}

bool Writer::run(int depth) {
  out_ << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level " << depth << " }\n";
  for (std::string word; in_ >> word;) {
    if (word != "p" && word != "pp") close_mesh();
    if (word == "f" || word == "s" || word == "c" || word == "p" || word == "pp") write_lights();
    if (word == "v")
      view();
    else if (word == "b")
      out_ << "background { rgb " << vector() << " }\n";
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
      float radius = 0;
      in_ >> radius;
      out_ << "sphere { " << center << ", " << std::abs(radius) << texture_ << " }\n";
    } else if (word[0] != '#') {
      return false;
    }
    if (word[0] == '#' || word == "l") in_.ignore(1 << 20, '\n'); // a comment; a light's colour
    if (!in_ && !in_.eof()) return false;
  }
  close_mesh();
  return true;
}

} // namespace

void write_povray_of_nff(const std::filesystem::path& nff, const std::filesystem::path& pov, int depth) {
  std::ifstream in(nff);
  std::ofstream out(pov);
  out.precision(9);
  if (!in || !Writer(in, out).run(depth)) throw InputError(nff.string() + ": not NFF");
  out.close();
  if (!out) throw OutputError("cannot write " + pov.string());
}

} // namespace fastrt::bench
