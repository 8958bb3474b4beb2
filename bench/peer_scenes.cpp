// SPDX-License-Identifier: Apache-2.0
#include "bench/peer_scenes.hpp"

#include <fastrt/error.hpp>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>

namespace fastrt::bench {
namespace {

// A text file that is written with printf's words.
class TextFile {
public:
  explicit TextFile(const std::filesystem::path& path)
      : path_(path.string()), file_(std::fopen(path_.c_str(), "w"), &std::fclose) {
    if (file_ == nullptr) throw OutputError("cannot write " + path_);
  }
  [[gnu::format(printf, 2, 3)]] void print(const char* format, ...) {
    std::va_list values;
    va_start(values, format);
    std::vfprintf(file_.get(), format, values);
    va_end(values);
  }
  void finish() {
    if (std::fflush(file_.get()) != 0) throw OutputError("cannot write " + path_);
  }

private:
  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

double number(float value) { return static_cast<double>(value); }

void print_vector(TextFile& file, const char* format, const Vec3& v) {
  char text[128];
  std::snprintf(text, sizeof text, format, number(v.x), number(v.y), number(v.z));
  file.print("%s", text);
}

} // namespace

void write_povray(const Picture& picture, const std::filesystem::path& path) {
  TextFile file(path);
  const Camera& camera = picture.camera;
  file.print("#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 5 }\n");
  file.print("background { rgb 0.03 }\ncamera { perspective right -x up y angle %g\n",
             number(camera.fov_degrees));
  print_vector(file, "  location <%.9g, %.9g, %.9g>\n", camera.eye);
  print_vector(file, "  sky <%.9g, %.9g, %.9g>\n", camera.up);
  print_vector(file, "  look_at <%.9g, %.9g, %.9g> }\n", camera.look_at);
  const float far_away = 100.0F * glm::length(camera.look_at - camera.eye);
  const Vec3 light = camera.look_at - far_away * glm::normalize(picture.light_travel);
  print_vector(file, "light_source { <%.9g, %.9g, %.9g> rgb 0.9 parallel", light);
  print_vector(file, " point_at <%.9g, %.9g, %.9g> }\n", camera.look_at);
  const SceneDesc& scene = picture.scene;
  file.print("mesh2 {\n vertex_vectors { %zu", scene.positions.size());
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    print_vector(file, ",\n<%.9g,%.9g,%.9g>", scene.positions[i]);
  file.print(" }\n face_indices { %zu", scene.triangles.size());
  const TriangleColumns& t = scene.triangles;
  for (std::size_t i = 0; i < t.size(); ++i) file.print(",\n<%u,%u,%u>", t.v0[i], t.v1[i], t.v2[i]);
  file.print(" }\n pigment { rgb 1 } finish { ambient 0.1 diffuse 0.8 }\n}\n");
  file.finish();
}

void write_plain_obj(const SceneDesc& scene, const std::filesystem::path& path) {
  TextFile file(path);
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    print_vector(file, "v %.9g %.9g %.9g\n", scene.positions[i]);
  const TriangleColumns& t = scene.triangles;
  for (std::size_t i = 0; i < t.size(); ++i)
    file.print("f %u %u %u\n", t.v0[i] + 1, t.v1[i] + 1, t.v2[i] + 1);
  file.finish();
}

// tachyon's camera is left-handed: the picture comes out mirrored, which costs it nothing.
void write_tachyon(const Picture& picture, const std::filesystem::path& path) {
  TextFile file(path);
  const Camera& camera = picture.camera;
  const double half_angle = number(camera.fov_degrees) * std::numbers::pi / 360.0;
  file.print("BEGIN_SCENE\nRESOLUTION %d %d\nCAMERA\nZOOM %.9g\n", picture.size, picture.size,
             0.5 / std::tan(half_angle));
  file.print("ASPECTRATIO 1.0\nANTIALIASING 0\nRAYDEPTH 5\n");
  print_vector(file, "CENTER %.9g %.9g %.9g\n", camera.eye);
  print_vector(file, "VIEWDIR %.9g %.9g %.9g\n", glm::normalize(camera.look_at - camera.eye));
  print_vector(file, "UPDIR %.9g %.9g %.9g\nEND_CAMERA\n", camera.up);
  print_vector(file, "DIRECTIONAL_LIGHT DIRECTION %.9g %.9g %.9g COLOR 0.9 0.9 0.9\n",
               glm::normalize(picture.light_travel));
  file.print("BACKGROUND 0.03 0.03 0.03\nTEXDEF grey AMBIENT 0.1 DIFFUSE 0.8 SPECULAR 0 OPACITY 1\n"
             "COLOR 1 1 1 TEXFUNC 0\n");
  const TriangleColumns& t = picture.scene.triangles;
  const Columns3& p = picture.scene.positions;
  for (std::size_t i = 0; i < t.size(); ++i) {
    print_vector(file, "TRI V0 %.9g %.9g %.9g", p[t.v0[i]]);
    print_vector(file, " V1 %.9g %.9g %.9g", p[t.v1[i]]);
    print_vector(file, " V2 %.9g %.9g %.9g grey\n", p[t.v2[i]]);
  }
  file.print("END_SCENE\n");
  file.finish();
}

} // namespace fastrt::bench
