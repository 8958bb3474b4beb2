// SPDX-License-Identifier: Apache-2.0
// The triangles of lights that are meshes, computed once per scene: data that both paths read.
#pragma once

#include <fastrt/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastrt {

struct EmitterTriangle {
  Vec3 a, b, c;
  Vec3 normal; // unit, on either side
};

// What a light of LightKind::mesh is made of. Triangle i is chosen by the numbers from begin[i] up to the
// next one's, or to 2^32: as many of the 2^32 as it has of the area. begin and scale: of MeshShares.
struct LightMesh {
  std::vector<EmitterTriangle> triangles; // none of lights of other kinds
  std::vector<std::uint32_t> begin;
  std::vector<float> scale;
  Vec3 radiance{0.0F}; // of its points: Ke times the light's intensity
  float area_over_pi = 0;
  float magnitude = 0; // the largest |coordinate| of a corner
  Vec3 middle{0.0F};   // of the first triangle
};

// As Scene::lights().
struct LightMeshes {
  std::vector<LightMesh> lights;
  std::size_t bytes() const noexcept;
};

// Of a scene that has been checked. Throws InputError where a light's material is on no triangle with an
// area.
LightMeshes make_light_meshes(const SceneDesc& desc);

} // namespace fastrt
