// SPDX-License-Identifier: Apache-2.0
// The naive photon tracer: one photon after the other, from its light on.
#pragma once

#include "src/film/frame.hpp"
#include "src/film/photon_map.hpp"
#include "src/reference/hit_finder.hpp"
#include "src/reference/secondary.hpp"
#include "src/scene/photon_chunks.hpp"

#include <fastrt/render.hpp>

#include <functional>
#include <vector>

namespace fastrt::reference {

// A photon on its way.
struct PhotonNode {
  Ray ray;
  Vec3 weight{1.0F};
  float strength = 1; // multiplies the weight, but does not say whether the photon is worth following
  float length = 0;   // of the way from the light
  std::uint32_t key = 0;
  std::uint32_t index = 0; // of the photon among those of its light
  int depth = 0;
  bool bent = false;      // it met a mirror or was bent
  bool scattered = false; // it left a diffuse surface
  Media media;
};

// A photon's light on a surface that scatters it.
struct Arrival {
  const PhotonLight* light;
  std::uint32_t row; // of the plan
  PhotonNode photon; // as it arrived
  Surface surface;
  Vec3 albedo;
  float strength; // weight * strength is what arrives
};

// Called for every arrival, from several threads; adds its own rays.
using Arrive = std::function<void(const Arrival& arrival, RayCounts& rays)>;

// Follows all photons of the plan. around: what the lights lie in. scatter: whether diffuse surfaces send
// them on.
void trace_photons(const Scene& scene, const HitFinder& finder, const Surroundings& around,
                   const PhotonPlan& plan, const std::vector<PhotonChunk>& chunks,
                   const RenderSettings& settings, bool scatter, const Arrive& arrive,
                   FrameProgress& progress);

// The photons of caustics.
PhotonMap trace_caustics(const Scene& scene, const HitFinder& finder, const Surroundings& around,
                         const PhotonPlan& plan, const std::vector<PhotonChunk>& chunks,
                         const RenderSettings& settings, FrameProgress& progress);

// What they bring to a surface, before its own colour. Looks at every photon.
Vec3 caustic_light(const PhotonMap& map, const Surface& surface);

// render() for Integrator::forward.
Frame render_forward(const Scene& scene, const HitFinder& finder, const Camera& camera,
                     const RenderSettings& settings);

} // namespace fastrt::reference
