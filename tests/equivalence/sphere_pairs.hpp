// SPDX-License-Identifier: Apache-2.0
// Rays and spheres that are hard on each other.
#pragma once

#include "tests/equivalence/pairs.hpp"

namespace fastrt::test {

enum class SphereKind {
  random,
  tangent,
  from_inside,
  from_centre,
  from_surface,
  from_far,
  axis_parallel,
  tiny_radius,
  huge_radius,
  extreme,
  odd_ray,
  odd_numbers,
  count
};

inline reference::SphereShape sphere_of(const Pair& pair) { return {get(pair, 0), pair.primitive[3]}; }

inline void put_sphere(Pair& pair, const Vec3& center, float radius) {
  put(pair, 0, center);
  pair.primitive[3] = radius;
}

// At the silhouette: a point of the sphere at a right angle to the way to it.
inline void aim_at_rim(Pair& pair, const Vec3& origin, Random& random) {
  const auto [center, radius] = sphere_of(pair);
  const Vec3 side = glm::normalize(glm::cross(center - origin, random.direction()));
  pair.ray.origin = origin;
  pair.ray.direction = any_size(random, -5, 5) * (center + radius * side - origin);
}

inline Pair sphere_pair(SphereKind kind, Random& random) {
  Pair pair;
  const Vec3 center = random.in_cube();
  float radius = any_size(random, -5, 1);
  if (kind == SphereKind::tiny_radius) radius = any_size(random, -80, -5);
  if (kind == SphereKind::huge_radius) radius = any_size(random, 1, 85);
  put_sphere(pair, center, radius);
  const Vec3 on_surface = center + radius * random.direction();
  pair.ray.origin = 4.0F * random.in_cube();
  pair.ray.direction = any_size(random, -5, 5) * (on_surface - pair.ray.origin);
  switch (kind) {
  case SphereKind::random:
    pair.ray.direction = random.in_cube();
    pair.ray.t_min = random.uniform(-2, 2);
    break;
  case SphereKind::tangent:
    aim_at_rim(pair, pair.ray.origin, random);
    break;
  case SphereKind::from_inside:
    pair.ray.origin = center + radius * random.uniform() * random.direction();
    break;
  case SphereKind::from_centre:
    pair.ray.origin = center;
    break;
  case SphereKind::from_surface:
    pair.ray.origin = on_surface;
    pair.ray.direction = random.direction();
    break;
  case SphereKind::from_far:
    aim_at_rim(pair, center + any_size(random, 2, 16) * radius * random.direction(), random);
    break;
  case SphereKind::axis_parallel:
    pair.ray.direction = axis_direction(random);
    pair.ray.origin = on_surface - random.uniform(-1, 3) * pair.ray.direction;
    break;
  case SphereKind::extreme:
    put_sphere(pair, any_size(random, -60, 60) * center, any_size(random, -60, 60));
    pair.ray.direction *= any_size(random, -60, 60);
    break;
  case SphereKind::odd_ray:
    (random.below(2) == 0 ? pair.ray.origin : pair.ray.direction) = odd_vector(random);
    pair.ray.t_min = odd_number(random);
    break;
  case SphereKind::odd_numbers:
    for (float& number : pair.primitive) number = odd_number(random);
    pair.ray.origin = odd_vector(random);
    pair.ray.direction = odd_vector(random);
    break;
  case SphereKind::tiny_radius:
  case SphereKind::huge_radius:
  case SphereKind::count:
    break;
  }
  return pair;
}

} // namespace fastrt::test
