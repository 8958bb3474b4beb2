// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/reference/ray.hpp"

#include <fastrt/scene.hpp>

#include <cstdint>
#include <optional>

namespace fastrt::reference {

// The terms of a material at one point.
struct Finish {
  Vec3 ambient, diffuse, specular, emission;
  float opacity;
};

// What shading needs to know of the place where a ray met a surface.
struct Surface {
  Vec3 point{0.0F};
  Vec3 geometric_normal{0.0F};         // unit, on the viewer's side
  Vec3 shading_normal{0.0F};           // unit, interpolated where the mesh has normals
  Vec3 incident{0.0F};                 // the ray's direction, unit
  Vec3 to_viewer{0.0F};                // -incident
  float distance = 0;                  // from the ray's origin, in units of length
  float magnitude = 0;                 // the largest number that the point was computed from
  float growth = 1;                    // of the instance's map: by how much it blows up rounding errors
  std::int32_t planar = no_primitive;  // the primitive if it is flat: rays that leave it exclude it
  std::int32_t instance = no_instance; // that shows the primitive
  std::uint32_t material = 0;
  float width = 0;              // of the ray's footprint here
  std::optional<Finish> finish; // where the material has textures
};

// The material's own terms, or what its textures make of them.
inline Finish finish_of(const Material& material, const Surface& surface) {
  if (surface.finish) return *surface.finish;
  return {material.ambient, material.diffuse, material.specular, material.emission, material.opacity};
}

// `hit` must be a hit of `ray`.
Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit);

// How far secondary rays start off the surface: follows the size of the numbers, not of the scene.
inline float offset_for(float magnitude) { return magnitude * 0x1p-20F; }

} // namespace fastrt::reference
