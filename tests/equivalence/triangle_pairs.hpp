// SPDX-License-Identifier: Apache-2.0
// Rays and triangles that are hard on each other.
#pragma once

#include "tests/equivalence/pairs.hpp"

namespace fastrt::test {

enum class TriangleKind {
  random,
  at_vertex,
  at_edge,
  inside,
  in_plane,
  grazing,
  axis_parallel,
  from_vertex,
  from_far,
  degenerate,
  tiny,
  huge,
  odd_ray,
  odd_numbers,
  count
};

inline reference::TriangleVertices triangle_of(const Pair& pair) {
  return {get(pair, 0), get(pair, 3), get(pair, 6)};
}

inline Vec3 mixed(const Pair& pair, float u, float v) {
  const auto [a, b, c] = triangle_of(pair);
  return a + u * (b - a) + v * (c - a);
}

inline void aim(Pair& pair, const Vec3& origin, const Vec3& target, Random& random) {
  pair.ray.origin = origin;
  pair.ray.direction = any_size(random, -5, 5) * (target - origin);
}

inline void make_degenerate(Pair& pair, Random& random) {
  const auto [a, b, c] = triangle_of(pair);
  switch (random.below(4)) {
  case 0:
    return put(pair, 3, a);
  case 1:
    put(pair, 3, a);
    return put(pair, 6, a);
  case 2:
    return put(pair, 6, a + random.uniform(-2, 2) * (b - a));
  default:
    return put(pair, 6, b + any_size(random, -20, -10) * (c - b));
  }
}

// A ray that is in the triangle's plane, or `height` above it at its start.
inline void aim_along_plane(Pair& pair, float height, Random& random) {
  const auto [a, b, c] = triangle_of(pair);
  const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const Vec3 origin = mixed(pair, random.uniform(-3, 3), random.uniform(-3, 3)) + height * normal;
  aim(pair, origin, mixed(pair, random.uniform(0, 0.5F), random.uniform(0, 0.5F)), random);
}

inline void scale(Pair& pair, float factor) {
  for (float& number : pair.primitive) number *= factor;
  pair.ray.origin *= factor;
}

inline Pair triangle_pair(TriangleKind kind, Random& random) {
  Pair pair;
  for (int v = 0; v < 3; ++v) put(pair, 3 * v, random.in_cube());
  const Vec3 origin = 3.0F * random.in_cube();
  const float u = random.uniform();
  const float v = random.uniform() * (1.0F - u);
  aim(pair, origin, mixed(pair, u, v), random);
  switch (kind) {
  case TriangleKind::random:
    pair.ray.direction = random.in_cube();
    pair.ray.t_min = random.uniform(-2, 2);
    break;
  case TriangleKind::at_vertex:
    aim(pair, origin, get(pair, 3 * static_cast<int>(random.below(3))), random);
    break;
  case TriangleKind::at_edge:
    aim(pair, origin, random.below(2) == 0 ? mixed(pair, u, 0) : mixed(pair, u, 1 - u), random);
    break;
  case TriangleKind::in_plane:
    aim_along_plane(pair, 0, random);
    break;
  case TriangleKind::grazing:
    aim_along_plane(pair, any_size(random, -20, -3), random);
    break;
  case TriangleKind::axis_parallel:
    pair.ray.direction = axis_direction(random);
    pair.ray.origin = mixed(pair, u, v) - random.uniform(-1, 3) * pair.ray.direction;
    break;
  case TriangleKind::from_vertex:
    pair.ray.origin = get(pair, 3 * static_cast<int>(random.below(3)));
    pair.ray.t_min = random.below(2) == 0 ? -1.0F : 0.0F;
    break;
  case TriangleKind::from_far:
    aim(pair, any_size(random, 3, 16) * random.direction(), mixed(pair, u, v), random);
    break;
  case TriangleKind::degenerate:
    make_degenerate(pair, random);
    break;
  case TriangleKind::tiny:
    scale(pair, any_size(random, -50, -5));
    break;
  case TriangleKind::huge:
    scale(pair, any_size(random, 5, 75));
    break;
  case TriangleKind::odd_ray:
    (random.below(2) == 0 ? pair.ray.origin : pair.ray.direction) = odd_vector(random);
    pair.ray.t_min = odd_number(random);
    break;
  case TriangleKind::odd_numbers:
    for (float& number : pair.primitive) number = odd_number(random);
    pair.ray.origin = odd_vector(random);
    pair.ray.direction = odd_vector(random);
    break;
  case TriangleKind::inside:
  case TriangleKind::count:
    break;
  }
  return pair;
}

} // namespace fastrt::test
