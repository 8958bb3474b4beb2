// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/trace/tracer_parts.hpp"

#include <fastrt/camera.hpp>

namespace fastrt {

// The media that contain a point, as a PathBatch holds them. The geometry and the materials must be ready.
void media_around(const Tracer::Parts& parts, const Vec3& point, std::int32_t (&media)[max_media]);

// Those that camera rays start in; of an orthographic camera the middle one.
void media_around(const Tracer::Parts& parts, const CameraFrame& camera, int width, int height,
                  std::int32_t (&media)[max_media]);

// What the photons and the shadow rays of the lights that have a place start in, into their rows.
void place_lights_in_media(Tracer::Parts& parts);

} // namespace fastrt
