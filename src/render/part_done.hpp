// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/film/frame.hpp"
#include "src/trace/tile_job.hpp"

namespace fastrt {

// Adds what kernels counted in a part of a frame, some tile or some photons.
inline void part_done(const TileRayCounts& rays, FrameProgress& progress) {
  const auto counts = [](const TileTestCounts& tests) { return TestCounts{tests.boxes, tests.primitives}; };
  progress.part_done({rays.primary, rays.shadow, rays.reflected, rays.refracted},
                     {counts(rays.primary_tests), counts(rays.shadow_tests), counts(rays.secondary_tests)});
}

} // namespace fastrt
