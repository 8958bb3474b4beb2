// SPDX-License-Identifier: Apache-2.0
// Pictures whose every pixel is known beforehand, by geometry in double precision. The same checks run for
// the reference and for the kernels of every ISA that this machine has.
#pragma once

#include <fastrt/render.hpp>
#include <fastrt/scene.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace fastrt::test {

using DVec3 = glm::dvec3;

// A way of making pictures.
struct Path {
  std::string name;
  std::function<Frame(Scene, const Camera&, const RenderSettings&)> render;
};

inline void PrintTo(const Path& path, std::ostream* out) { *out << path.name; }

inline std::vector<Path> all_paths() {
  std::vector<Path> paths;
  paths.push_back({"reference", [](const Scene& scene, const Camera& camera, const RenderSettings& settings) {
                     return render_reference(scene, camera, settings);
                   }});
  for (const Isa isa : available_isas()) {
    std::string name = std::string("kernels_") + isa_name(isa);
    std::erase(name, '.');
    paths.push_back({name, [isa](Scene scene, const Camera& camera, const RenderSettings& settings) {
                       TracerSettings tracer;
                       tracer.isa = isa;
                       return render(Tracer(std::move(scene), tracer), camera, settings);
                     }});
  }
  return paths;
}

class Picture : public testing::TestWithParam<Path> {
protected:
  Frame render(SceneBuilder& builder, const Camera& camera, const RenderSettings& settings) const {
    return GetParam().render(builder.build(), camera, settings);
  }
};

inline std::string path_name(const testing::TestParamInfo<Path>& info) { return info.param.name; }

#define FASTRT_PICTURES(Suite)                                                                               \
  INSTANTIATE_TEST_SUITE_P(Paths, Suite, testing::ValuesIn(all_paths()), path_name)

inline RenderSettings settings_of(int width, int height) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.min_contribution = 0;
  return settings;
}

// A pinhole in double precision, from the camera's definition and not from make_camera_frame.
class Pinhole {
public:
  Pinhole(const Camera& camera, const RenderSettings& settings)
      : eye_(camera.eye), width_(settings.width), height_(settings.height) {
    forward_ = glm::normalize(DVec3(camera.look_at) - eye_);
    right_ = glm::normalize(glm::cross(forward_, DVec3(camera.up)));
    up_ = glm::cross(right_, forward_);
    focal_ = 0.5 * height_ / std::tan(0.5 * camera.fov_degrees * std::numbers::pi / 180);
  }
  const DVec3& eye() const { return eye_; }
  // Pixels per unit of length at distance 1.
  double focal() const { return focal_; }
  // Unit direction through an image point.
  DVec3 direction(double px, double py) const {
    return glm::normalize(focal_ * forward_ + (px - 0.5 * width_) * right_ + (0.5 * height_ - py) * up_);
  }
  // The image point that shows `point`.
  std::pair<double, double> project(const DVec3& point) const {
    const DVec3 v = point - eye_;
    const double scale = focal_ / glm::dot(v, forward_);
    return {0.5 * width_ + scale * glm::dot(v, right_), 0.5 * height_ - scale * glm::dot(v, up_)};
  }

private:
  DVec3 eye_, forward_{0}, right_{0}, up_{0};
  double width_, height_, focal_ = 0;
};

struct DSphere {
  DVec3 center;
  double radius;
};

// How far outside of the sphere the ray passes: below 0 it meets the sphere, if that is before it.
inline double gap(const DVec3& origin, const DVec3& unit_direction, const DSphere& sphere) {
  const DVec3 v = sphere.center - origin;
  const double along = glm::dot(v, unit_direction);
  if (along <= 0) return glm::length(v) - sphere.radius;
  return glm::length(v - along * unit_direction) - sphere.radius;
}

inline Vec3 color_at(const Frame& frame, int x, int y) {
  const std::size_t i =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x));
  return {frame.rgb[i], frame.rgb[i + 1], frame.rgb[i + 2]};
}
inline std::int32_t primitive_at(const Frame& frame, int x, int y) {
  return frame.primitive[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                         static_cast<std::size_t>(x)];
}

inline double difference(const Vec3& a, const Vec3& b) {
  const Vec3 d = glm::abs(a - b);
  return static_cast<double>(std::max(d.x, std::max(d.y, d.z)));
}

// The colour that a pixel must have, seen along a unit direction; nothing where the direction is so close to
// an edge that rounding may decide.
using Prediction = std::function<std::optional<Vec3>(const DVec3& direction)>;

// Every pixel whose colour can be foretold must have it, and at most one in twenty can't be.
inline void expect_pixels(const Frame& frame, const Pinhole& pinhole, double tolerance,
                          const Prediction& predict) {
  int wrong = 0;
  int unsure = 0;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const std::optional<Vec3> expected = predict(pinhole.direction(x + 0.5, y + 0.5));
      const Vec3 seen = color_at(frame, x, y);
      if (!expected)
        ++unsure;
      else if (!(difference(seen, *expected) <= tolerance) && ++wrong <= 3)
        ADD_FAILURE() << "pixel " << x << "," << y << " is " << seen.x << " " << seen.y << " " << seen.z
                      << ", not " << expected->x << " " << expected->y << " " << expected->z;
    }
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(20 * unsure, frame.width * frame.height);
}

// Materials that do one thing.
inline Material black() {
  Material material;
  material.ambient = material.diffuse = Vec3(0.0F);
  return material;
}
inline Material glowing(const Vec3& color) {
  Material material = black();
  material.emission = color;
  material.unlit = true;
  return material;
}
inline Material mirror(float share) {
  Material material = black();
  material.mirror = Vec3(share);
  return material;
}
inline Material clear(float ior, const Vec3& transmission = Vec3(1.0F)) {
  Material material = black();
  material.opacity = 0;
  material.transmission = transmission;
  material.ior = ior;
  return material;
}

// The parallelogram corner + a * right + b * up, 0 <= a, b <= 1: two triangles.
inline void add_quad(SceneBuilder& builder, const Vec3& corner, const Vec3& right, const Vec3& up,
                     std::uint32_t material) {
  const std::vector<Vec3> positions{corner, corner + right, corner + right + up, corner + up};
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  builder.add_mesh(positions, indices, material);
}

// A closed box: twelve triangles.
inline void add_box(SceneBuilder& builder, const Vec3& lower, const Vec3& upper, std::uint32_t material) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 8; ++i)
    positions.emplace_back((i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y,
                           (i & 4) != 0 ? upper.z : lower.z);
  const std::vector<std::uint32_t> indices{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                           2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  builder.add_mesh(positions, indices, material);
}

} // namespace fastrt::test
