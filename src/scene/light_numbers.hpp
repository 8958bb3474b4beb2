// SPDX-License-Identifier: Apache-2.0
// Numbers of a light that shading needs, computed once per light for both paths.
#pragma once

#include "src/film/light_sampling.hpp"

#include <fastrt/light.hpp>

#include <cmath>

namespace fastrt {

inline LightShape shape_of(const Light& light) {
  switch (light.kind) {
  case LightKind::rectangle:
    return LightShape::rectangle;
  case LightKind::disk:
    return LightShape::disk;
  case LightKind::sphere:
    return LightShape::sphere;
  case LightKind::mesh:
    return LightShape::mesh;
  default:
    return LightShape::none;
  }
}

inline bool fades(const Light& light) {
  return light.kind != LightKind::directional &&
         (light.constant != 1.0F || light.linear != 0.0F || light.quadratic != 0.0F);
}

// The half axes of a light with a size; 0 for others, and for meshes.
struct LightAxes {
  Vec3 u{0.0F}, v{0.0F}, w{0.0F};
};
LightAxes light_axes(const Light& light);

// The largest |coordinate| of the box around a light that is no mesh.
inline float light_magnitude(const Light& light) {
  const LightAxes axes = light_axes(light);
  const Vec3 reach = glm::abs(light.position) + glm::abs(axes.u) + glm::abs(axes.v) + glm::abs(axes.w);
  return std::fmax(reach.x, std::fmax(reach.y, reach.z));
}

// A spot light's cone: the way that it points, the cosine at its rim, and 1 / (the cosine where the penumbra
// begins - that at the rim), infinite without a penumbra.
struct SpotCone {
  Vec3 axis;
  float rim, inverse_width;
};
SpotCone spot_cone(const Light& light);

} // namespace fastrt
