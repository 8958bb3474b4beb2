// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>

#include <cstdint>

namespace fastrt {

enum class LightKind : std::uint32_t { point, directional };

// A light without size. Its strength does not fade with distance.
struct Light {
  LightKind kind = LightKind::point;
  Vec3 position{0.0F};               // point lights: world space
  Vec3 direction{0.0F, -1.0F, 0.0F}; // directional lights: the way the light travels; any length but 0
  Vec3 intensity{1.0F};              // linear RGB
  bool casts_shadows = true;
};

} // namespace fastrt
