// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>
#include <fastrt/scene.hpp>
#include <fastrt/tracer.hpp>

#include <cstdint>

namespace fastrt::reference {

// r(t) = origin + t * direction, t_min < t < t_max. The direction need not be normalised. `excluded` is never
// hit: the planar primitive that the ray starts from, or that a shadow ray ends on.
struct Ray {
  Vec3 origin{0.0F};
  Vec3 direction{0.0F};
  float t_min = 0;
  float t_max = infinity;
  std::int32_t excluded = no_primitive;
  std::int32_t excluded_instance = no_instance; // the one in which the primitive is excluded
  // Of the ray's footprint, for textures: its width at the origin, and how much it widens per unit of length.
  float width = 0;
  float spread = 0;
};

// On a miss: t is the ray's t_max and primitive is no_primitive. (u, v) weigh a triangle's second and third
// vertex; docs/numerics.md says what those of the other primitives are.
struct Hit {
  float t = infinity;
  float u = 0;
  float v = 0;
  std::int32_t primitive = no_primitive;
  std::int32_t instance = no_instance; // the one that shows the primitive
  bool found() const noexcept { return primitive != no_primitive; }
};

} // namespace fastrt::reference
