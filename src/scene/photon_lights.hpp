// SPDX-License-Identifier: Apache-2.0
// Which lights send out how many photons, and where to: data for both paths (docs/numerics.md, "Photons").
#pragma once

#include <fastrt/scene.hpp>

#include <cstdint>
#include <vector>

namespace fastrt {

// A light that sends out photons.
struct PhotonLight {
  std::uint32_t light; // of the scene
  std::uint32_t count; // photons
  // Of no use to meshes, whose photons go wherever their triangles point.
  Vec3 u, v, w;     // orthonormal: directions are around w; parallel light travels along w
  float cap_height; // of the cap of directions on the unit sphere; 0: parallel light
  // Parallel light starts on a square with this middle and half side, along u and v.
  Vec3 middle;
  float half_side;
  Vec3 flux;                        // of one photon, times PhotonPlan::count
  std::vector<std::uint16_t> cells; // of the square of places (src/film/photon_sampling.hpp), ascending
};

struct PhotonPlan {
  std::vector<PhotonLight> lights;
  std::uint64_t count = 0; // photons of all lights: nearly as many as were asked for
};

// Photons for the whole scene. Planes alone get no parallel light: it covers what has bounds.
PhotonPlan plan_forward_photons(const Scene& scene, std::int64_t photons);

// Photons for what reflects or bends light, of the lights that cast shadows.
PhotonPlan plan_caustic_photons(const Scene& scene, std::int64_t photons);

} // namespace fastrt
