// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/reference/hit_finder.hpp"

#include <fastrt/camera.hpp>
#include <fastrt/render.hpp>

namespace fastrt::reference {

// The picture that render_reference() makes, with any way of finding hits. Throws UsageError for settings out
// of their ranges and InputError for a degenerate camera.
Frame render(const Scene& scene, const HitFinder& finder, const Camera& camera,
             const RenderSettings& settings);

// What one ray from the camera brings back: the lecture's rayTrace. Adds the rays below it to `rays`; gives
// the hit of the ray itself in `first_hit`.
Vec3 ray_trace(const Scene& scene, const HitFinder& finder, const Ray& ray, const RenderSettings& settings,
               RayCounts& rays, Hit& first_hit);

} // namespace fastrt::reference
