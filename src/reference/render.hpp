// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/film/light_sampling.hpp"
#include "src/film/photon_map.hpp"
#include "src/reference/hit_finder.hpp"
#include "src/reference/media.hpp"
#include "src/reference/surface.hpp"

#include <fastrt/camera.hpp>
#include <fastrt/render.hpp>

namespace fastrt::reference {

// The picture that render_reference() makes, with any way of finding hits. Throws UsageError for settings out
// of their ranges and InputError for a degenerate camera.
Frame render(const Scene& scene, const HitFinder& finder, const Camera& camera,
             const RenderSettings& settings);

// What AOVs tell of a ray from the camera.
struct Sight {
  Hit hit;
  Surface surface;       // if something was hit
  Vec3 light_left{0.0F}; // of the lights that cast shadows, summed up over them
  int deepest = 0;       // bounces of the longest path below the ray
};

// What one ray from the camera brings back: the lecture's rayTrace. around: of the camera and the lights.
// question: of its pixel and sample. Adds the rays below it to `rays`. caustics: null for none.
Vec3 ray_trace(const Scene& scene, const HitFinder& finder, const Ray& ray, const RenderSettings& settings,
               const Surroundings& around, const LightQuestion& question, const PhotonMap* caustics,
               RayCounts& rays, Sight& sight);

// The AOVs that the frame holds, at one pixel. ray_count: traced for it.
void record_aovs(const Scene& scene, const Sight& sight, std::uint64_t ray_count, std::size_t pixel,
                 Frame& frame);

} // namespace fastrt::reference
