// SPDX-License-Identifier: Apache-2.0
#include "src/scene/light_numbers.hpp"

#include <numbers>

namespace fastrt {

LightAxes light_axes(const Light& light) {
  if (light.kind == LightKind::rectangle) return {light.half_u, light.half_v, Vec3(0.0F)};
  if (light.kind == LightKind::sphere) {
    const float r = light.radius;
    return {{r, 0.0F, 0.0F}, {0.0F, r, 0.0F}, {0.0F, 0.0F, r}};
  }
  if (light.kind != LightKind::disk) return {};
  const Vec3 normal = glm::normalize(light.direction);
  const Vec3 other = std::fabs(normal.x) < 0.5F ? Vec3(1.0F, 0.0F, 0.0F) : Vec3(0.0F, 1.0F, 0.0F);
  const Vec3 u = glm::normalize(glm::cross(normal, other));
  return {light.radius * u, light.radius * glm::cross(normal, u), Vec3(0.0F)};
}

SpotCone spot_cone(const Light& light) {
  const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); };
  const double rim = cosine(static_cast<double>(light.cone_degrees));
  const double inside =
      cosine(static_cast<double>(light.cone_degrees) - static_cast<double>(light.penumbra_degrees));
  return {glm::normalize(light.direction), static_cast<float>(rim), static_cast<float>(1.0 / (inside - rim))};
}

} // namespace fastrt
