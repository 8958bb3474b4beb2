// SPDX-License-Identifier: Apache-2.0
#include <fastrt/error.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "bench/nff_scenes.hpp"
#include "bench/nff_statements.hpp"

namespace fastrt::bench {
namespace {

std::ostream& operator<<(std::ostream& out, const Vec3& v) { return out << v.x << ' ' << v.y << ' ' << v.z; }

class TachyonWriter final : public NffWriter {
public:
  TachyonWriter(std::ostream& out, int size, int depth) : out_(out), size_(size), depth_(depth) {
    out_ << "BEGIN_SCENE\n";
  }

  void view(const NffView& view) override;
  void background(const Vec3& color) override {
    background_ = color;
    if (has_view_) write_background();
  }
  void light(const Vec3& position, float intensity) override {
    out_ << "LIGHT CENTER " << position << " RAD 0.001 COLOR " << Vec3(intensity) << '\n';
  }
  void fill(const NffFill& fill) override;
  void cone(const NffCone& cone) override {
    out_ << "FCYLINDER BASE " << cone.base << " APEX " << cone.apex << " RAD "
         << 0.5F * (cone.base_radius + cone.apex_radius);
    end_object();
  }
  void sphere(const Vec3& center, float radius) override {
    out_ << "SPHERE CENTER " << center << " RAD " << radius;
    end_object();
  }
  void triangle(const NffTriangle& triangle) override;
  void end() override { out_ << "END_SCENE\n"; }

private:
  void write_background() { out_ << "BACKGROUND " << background_ << '\n'; }
  void end_object() { out_ << " fill" << fills_ << '\n'; }

  std::ostream& out_;
  int size_, depth_;
  Vec3 background_{0.0F};
  bool has_view_ = false; // which comes first
  int fills_ = 0;
};

void TachyonWriter::view(const NffView& view) {
  const float half_angle = view.angle * std::numbers::pi_v<float> / 360.0F;
  out_ << "RESOLUTION " << size_ << ' ' << size_ << "\nCAMERA\nZOOM " << 0.5F / std::tan(half_angle)
       << "\nASPECTRATIO 1.0\nANTIALIASING 0\nRAYDEPTH " << depth_ << "\nCENTER " << view.from << "\nVIEWDIR "
       << glm::normalize(view.at - view.from) << "\nUPDIR " << view.up << "\nEND_CAMERA\n";
  has_view_ = true;
  write_background();
}

void TachyonWriter::fill(const NffFill& fill) {
  out_ << "TEXDEF fill" << ++fills_ << " AMBIENT 0 DIFFUSE " << fill.diffuse << " SPECULAR " << fill.specular
       << " OPACITY " << 1.0F - fill.transmittance << "\nPHONG PLASTIC " << fill.specular << " PHONG_SIZE "
       << std::max(1.0F, fill.shine) << " COLOR " << fill.color << " TEXFUNC 0\n";
}

void TachyonWriter::triangle(const NffTriangle& triangle) {
  out_ << (triangle.smooth ? "STRI" : "TRI");
  for (std::size_t i = 0; i < 3; ++i) out_ << " V" << i << ' ' << triangle.corners[i];
  if (triangle.smooth)
    for (std::size_t i = 0; i < 3; ++i) out_ << " N" << i << ' ' << triangle.normals[i];
  end_object();
}

} // namespace

void write_tachyon_of_nff(const std::filesystem::path& nff, const std::filesystem::path& scene, int size,
                          int depth) {
  std::ofstream out(scene);
  out.precision(9);
  TachyonWriter writer(out, size, depth);
  read_nff_statements(nff, writer);
  out.close();
  if (!out) throw OutputError("cannot write " + scene.string());
}

} // namespace fastrt::bench
