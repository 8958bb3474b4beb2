// SPDX-License-Identifier: Apache-2.0
// Cones, disks, polygons and planes at random.
#pragma once

#include "tests/unit/reference_shapes.hpp"

#include <fastrt/scene.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace fastrt::test {

// Two unit vectors square to `normal` and to each other.
struct Across {
  Vec3 x, y;
};
inline Across axes_across(const Vec3& normal) {
  const Vec3 n = glm::normalize(normal);
  const Vec3 other = std::fabs(n.x) < 0.5F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 x = glm::normalize(glm::cross(n, other));
  return {x, glm::cross(n, x)};
}

// A star with `tips` tips: concave where `inner` is less than 1; turned by an angle.
inline std::vector<Vec3> star(const Vec3& center, const Vec3& normal, float radius, int tips, float inner,
                              float turn = 0) {
  const auto [x, y] = axes_across(normal);
  std::vector<Vec3> contour;
  for (int i = 0; i < 2 * tips; ++i) {
    const float angle = turn + std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(tips);
    const float reach = i % 2 == 0 ? radius : inner * radius;
    contour.push_back(center + reach * (std::cos(angle) * x + std::sin(angle) * y));
  }
  return contour;
}

// Open and capped; cylinders, blunt and pointed cones, long and flat ones.
inline void add_any_cone(SceneBuilder& builder, std::uint32_t material, const Vec3& center, float size,
                         Random& random) {
  const Vec3 half = size * std::exp(random.uniform(-2, 1)) * random.direction();
  const float r0 = size * random.uniform(0.05F, 1);
  const std::uint32_t choice = random.below(4);
  const float r1 = choice == 0 ? r0 : choice == 1 ? 0.0F : size * random.uniform(0, 1);
  const Vec3 axis = random.below(4) == 0 ? Vec3(0, 0, glm::length(half)) : half;
  builder.add_cone(center - axis, r0, center + axis, r1, material, random.below(2) == 0);
}

inline void add_any_disk(SceneBuilder& builder, std::uint32_t material, const Vec3& center, float size,
                         Random& random) {
  const Vec3 normal = random.below(4) == 0 ? Vec3(0, -2, 0) : random.direction();
  builder.add_disk(center, normal, size * random.uniform(0.1F, 1), material);
}

// Stars, every other one with a hole; some along the axes, and some that cross themselves.
inline void add_any_polygon(SceneBuilder& builder, std::uint32_t material, const Vec3& center, float size,
                            Random& random) {
  const Vec3 normal = random.below(3) == 0 ? Vec3(0, 0, 1) : random.direction();
  const int tips = 2 + static_cast<int>(random.below(12));
  std::vector<std::vector<Vec3>> contours{
      star(center, normal, size, tips, random.uniform(0.2F, 1), random.uniform(0, 3))};
  if (random.below(2) == 0) contours.push_back(star(center, normal, 0.4F * size, 3, 0.8F));
  if (random.below(6) == 0) std::swap(contours[0][0], contours[0][1]);
  builder.add_polygon(contours, material);
}

// Any one of the kinds that a tree holds.
inline void add_any_shape(SceneBuilder& builder, std::uint32_t material, const Vec3& center, float size,
                          Random& random) {
  switch (random.below(4)) {
  case 0:
    return add_any_disk(builder, material, center, size, random);
  case 1:
    return add_any_polygon(builder, material, center, size, random);
  default:
    return add_any_cone(builder, material, center, size, random);
  }
}

inline void add_any_plane(SceneBuilder& builder, std::uint32_t material, Random& random) {
  const Vec3 normal = random.below(2) == 0 ? Vec3(0, 1, 0) : random.direction();
  builder.add_plane(-random.uniform(1, 3) * normal, normal, material);
}

} // namespace fastrt::test
