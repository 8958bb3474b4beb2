// SPDX-License-Identifier: Apache-2.0
// Prototypes and maps at random.
#pragma once

#include "tests/unit/shape_scenes.hpp"

#include <fastrt/scene.hpp>

#include <cmath>
#include <cstdint>

namespace fastrt::test {

inline Affine scaled(const Vec3& scale, const Vec3& origin = Vec3(0.0F)) {
  return {{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}, origin};
}

// Three unit vectors square to each other.
inline Affine any_rotation(Random& random) {
  Affine map;
  map.x = random.direction();
  map.y = axes_across(map.x).x;
  map.z = glm::cross(map.x, map.y);
  return map;
}

// Rotated, stretched by up to e^stretch along each axis, sheared, mirrored.
inline Affine any_map(const Vec3& origin, float size, float stretch, Random& random) {
  Affine map = any_rotation(random);
  const auto factor = [&] { return size * std::exp(random.uniform(-stretch, stretch)); };
  map.x *= factor();
  map.y *= factor();
  map.z *= factor();
  if (random.below(3) == 0) map.x += random.uniform(-1, 1) * map.y + random.uniform(-1, 1) * map.z;
  if (random.below(2) == 0) map.z = -map.z;
  // Along the axes, in numbers that lose nothing.
  if (random.below(4) == 0)
    map = scaled({size < 1 ? 0.25F : 2.0F, random.below(2) == 0 ? 0.5F : -1.0F, 1.0F});
  map.origin = origin;
  return map;
}

// One of each kind of thing, around the origin.
inline std::uint32_t add_prototype(SceneBuilder& builder, std::uint32_t kind, std::uint32_t material,
                                   Random& random) {
  builder.begin_prototype();
  switch (kind % 6) {
  case 0:
    add(builder, jittered(icosphere(1), 0.1F, random), material);
    break;
  case 1:
    builder.add_sphere(0.2F * random.in_cube(), random.uniform(0.3F, 1), material);
    break;
  case 2:
    for (int i = 0; i < 3; ++i) add_any_cone(builder, material, random.in_cube(), 0.6F, random);
    break;
  case 3:
    add_any_disk(builder, material, 0.5F * random.in_cube(), 1, random);
    add_any_polygon(builder, material, 0.5F * random.in_cube(), 0.8F, random);
    break;
  case 4: // everything, in numbers enough for a tree of its own
    add(builder, soup(20, 0.5F, random), material);
    for (int i = 0; i < 12; ++i) builder.add_sphere(random.in_cube(), random.uniform(0.05F, 0.3F), material);
    for (int i = 0; i < 20; ++i)
      add_any_shape(builder, material, random.in_cube(), random.uniform(0.1F, 0.4F), random);
    break;
  default: // nothing
    break;
  }
  return builder.end_prototype();
}

} // namespace fastrt::test
