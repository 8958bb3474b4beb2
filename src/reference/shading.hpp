// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/film/light_sampling.hpp"
#include "src/film/photon_map.hpp"
#include "src/reference/hit_finder.hpp"
#include "src/reference/media.hpp"
#include "src/reference/surface.hpp"
#include "src/scene/light_meshes.hpp"

#include <fastrt/render.hpp>
#include <fastrt/scene.hpp>

#include <vector>

namespace fastrt::reference {

// exp(x) and x^y, x > 0: the functions that both paths share (src/simd/shared_math.hpp).
float shared_exp(float x);
float shared_pow(float x, float y);

// The share of light that passes through a surface of this material and opacity.
Vec3 transmittance(const Material& material, float opacity);
// Whether any light passes somewhere.
bool is_transmissive(const Material& material);

// The lecture's phongModel for one light in the unit direction `to_light`: what the surface sends to the
// viewer, before the light's intensity and its shadow. cos_n: of the angle between to_light and the shading
// normal.
Vec3 phong_model(const Material& material, const Finish& finish, const Surface& surface, const Vec3& to_light,
                 float cos_n);

// How much of a spot light's intensity goes into a unit direction; 0 outside of its cone.
float spot_share(const Light& light, const Vec3& direction);

inline MeshShares shares_of(const LightMesh& mesh) {
  return {mesh.begin.data(), mesh.scale.data(), static_cast<std::uint32_t>(mesh.triangles.size())};
}

// Which points of lights with a size are asked, and what shadow rays start in.
struct LightSampling {
  LightQuestion question;                // about light 0
  int count;                             // points of each
  const Media& surface_media;            // of the ray that found the surface
  const std::vector<Media>& light_media; // of each light
};

// What is left of the light along a ray between a light or the eye and a surface, that starts in `media`:
// begins as 1, and every stretch through a medium and every surface on the way take their parts.
// bodies_block: those that bend light stop all of it, because photons carry what they let through.
Vec3 let_through(const Scene& scene, const HitFinder& finder, Ray ray, Media media, bool bodies_block);

// The local component of the lecture's rtShade: emission, ambient, and every light that is not in shadow.
// Each shadow that is asked for adds one to rays.shadow, and what it leaves of the light to light_left.
// caustics: null for none.
Vec3 shade(const Scene& scene, const HitFinder& finder, const Surface& surface, const LightSampling& sampling,
           const PhotonMap* caustics, RayCounts& rays, Vec3& light_left);

} // namespace fastrt::reference
