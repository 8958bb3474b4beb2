// SPDX-License-Identifier: Apache-2.0
// Numbers of a texture that lookups need, computed once per scene for both paths.
#pragma once

#include <fastrt/material.hpp>

#include <cmath>

namespace fastrt {

// How many pixels of level 0 a unit of area of (u, v) holds.
inline float texture_pixels(const Texture& texture) {
  const float repeats = std::fabs(texture.scale.x * texture.scale.y);
  return repeats * (static_cast<float>(texture.image->width()) * static_cast<float>(texture.image->height()));
}

// For heights: the factor from a difference of two values, per step of 1 / width (1 / height) of level 0, to
// a slope along u and v. For normal maps: what x and y are multiplied by. A mirrored texture slopes the other
// way.
inline Vec2 bump_slope(const Material& material, const Texture& bump) {
  const Vec2 slope{std::copysign(material.bump_scale, material.bump_scale * bump.scale.x),
                   std::copysign(material.bump_scale, material.bump_scale * bump.scale.y)};
  if (material.bump_is_normal_map) return slope;
  return {slope.x / static_cast<float>(bump.image->width()),
          slope.y / static_cast<float>(bump.image->height())};
}

} // namespace fastrt
