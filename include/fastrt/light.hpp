// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>

#include <cstdint>

namespace fastrt {

enum class LightKind : std::uint32_t {
  point,
  directional,
  spot,      // a point that lights a cone
  rectangle, // these have a size and cast soft shadows
  disk,
  sphere,
  mesh, // all triangles of a material that emits light
};

// A light. It is not seen itself, but for meshes. Lights with a size light all around, each of their points
// like a point light; RenderSettings::light_samples of them are asked. A mesh's points light as those of a
// matt surface do that shines Material::emission to both sides, so it needs no fall-off of its own.
struct Light {
  LightKind kind = LightKind::point;
  Vec3 position{0.0F}; // world space; the middle of lights with a size; directional lights have none
  // Directional lights: the way the light travels. Spots: where they point. Disks: what they are square to.
  // Any length but 0.
  Vec3 direction{0.0F, -1.0F, 0.0F};
  Vec3 intensity{1.0F}; // linear RGB; of meshes what multiplies their emission
  bool casts_shadows = true;
  Vec3 ambient{0.0F}; // what it adds to the scene's ambient light, everywhere

  // At distance d the light is 1 / (constant + linear * d + quadratic * d^2) of its intensity; none of
  // directional lights.
  float constant = 1, linear = 0, quadratic = 0;

  // Spots: the angle between the axis and the rim of the cone, in (0, 180]; how much of it, from the rim
  // inwards, is penumbra; and the power of the cosine to the axis by which light falls off within it.
  float cone_degrees = 30, penumbra_degrees = 5, exponent = 0;

  Vec3 half_u{0.5F, 0.0F, 0.0F}, half_v{0.0F, 0.0F, 0.5F}; // rectangles: from the middle to two sides
  float radius = 0.5F;                                     // disks and spheres
  std::uint32_t material = 0;                              // meshes: index of SceneDesc::materials
};

} // namespace fastrt
