// SPDX-License-Identifier: Apache-2.0
// Rays that go on from a surface, as docs/numerics.md ("Offset of secondary rays") starts and ends them.
#pragma once

#include "src/reference/surface.hpp"
#include "tests/equivalence/geometry_scenes.hpp"

namespace fastrt::test {

// The next ray from a surface: reflected if `light` is null, else from the light to it.
inline Ray next_ray(const reference::Surface& surface, const Vec3* light, Random& random) {
  Ray ray;
  ray.excluded = surface.planar;
  ray.excluded_instance = surface.instance;
  const Vec3& normal = surface.geometric_normal;
  if (light == nullptr) {
    ray.origin = surface.point + reference::offset_for(surface.magnitude) * normal;
    ray.direction = random.direction();
    // Often at a grazing angle.
    if (random.below(2) == 0) ray.direction += -0.99F * glm::dot(ray.direction, normal) * normal;
    if (glm::dot(ray.direction, normal) < 0.0F) ray.direction = -ray.direction;
    return ray;
  }
  const float size = reference::max(surface.magnitude, reference::largest_magnitude(*light) * surface.growth);
  ray.origin = *light;
  ray.direction = (surface.point + reference::offset_for(size) * normal) - *light;
  ray.t_max = 1;
  return ray;
}

} // namespace fastrt::test
