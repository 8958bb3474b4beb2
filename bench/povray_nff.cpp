// SPDX-License-Identifier: Apache-2.0
#include <fastrt/error.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "bench/nff_scenes.hpp"
#include "bench/nff_statements.hpp"

namespace fastrt::bench {
namespace {

std::ostream& operator<<(std::ostream& out, const Vec3& v) {
  return out << '<' << v.x << ',' << v.y << ',' << v.z << '>';
}

class PovrayWriter final : public NffWriter {
public:
  PovrayWriter(std::ostream& out, int depth) : out_(out) {
    out_ << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level " << depth << " }\n";
  }

  void view(const NffView& view) override {
    out_ << "camera { perspective right -x up y angle " << view.angle << " location " << view.from << " sky "
         << view.up << " look_at " << view.at << " }\n";
  }
  void background(const Vec3& color) override { out_ << "background { rgb " << color << " }\n"; }
  void light(const Vec3& position, float intensity) override {
    out_ << "light_source { " << position << " rgb " << intensity << " }\n";
  }
  void fill(const NffFill& fill) override;
  void cone(const NffCone& cone) override;
  void sphere(const Vec3& center, float radius) override {
    close_mesh();
    out_ << "sphere { " << center << ", " << radius << texture_ << " }\n";
  }
  void triangle(const NffTriangle& triangle) override;
  void end() override { close_mesh(); }

private:
  void close_mesh() {
    if (in_mesh_) out_ << texture_ << " }\n";
    in_mesh_ = false;
  }

  std::ostream& out_;
  std::string texture_; // of what follows
  bool in_mesh_ = false;
};

void PovrayWriter::fill(const NffFill& fill) {
  close_mesh();
  const Vec3& color = fill.color;
  std::ostringstream text;
  text << " pigment { rgbt <" << color.x << ',' << color.y << ',' << color.z << ',' << fill.transmittance
       << "> } finish { ambient 0 diffuse " << fill.diffuse << " phong " << fill.specular << " phong_size "
       << std::max(1.0F, fill.shine) << " reflection " << fill.specular << " }";
  if (fill.transmittance > 0) text << " interior { ior " << (fill.ior > 0 ? fill.ior : 1.0F) << " }";
  texture_ = text.str();
}

void PovrayWriter::cone(const NffCone& cone) {
  close_mesh();
  if (cone.base_radius == cone.apex_radius)
    out_ << "cylinder { " << cone.base << ", " << cone.apex << ", " << cone.base_radius;
  else
    out_ << "cone { " << cone.base << ", " << cone.base_radius << ", " << cone.apex << ", "
         << cone.apex_radius;
  out_ << " open" << texture_ << " }\n";
}

void PovrayWriter::triangle(const NffTriangle& triangle) {
  if (!in_mesh_) out_ << "mesh {\n";
  in_mesh_ = true;
  out_ << (triangle.smooth ? "smooth_triangle {" : "triangle {");
  for (std::size_t i = 0; i < 3; ++i) {
    out_ << (i == 0 ? " " : ", ") << triangle.corners[i];
    if (triangle.smooth) out_ << ", " << triangle.normals[i];
  }
  out_ << " }\n";
}

} // namespace

void write_povray_of_nff(const std::filesystem::path& nff, const std::filesystem::path& pov, int depth) {
  std::ofstream out(pov);
  out.precision(9);
  PovrayWriter writer(out, depth);
  read_nff_statements(nff, writer);
  out.close();
  if (!out) throw OutputError("cannot write " + pov.string());
}

} // namespace fastrt::bench
