// SPDX-License-Identifier: Apache-2.0
// (u, v) of hits that are known.
#pragma once

#include "src/trace/surface.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

static void hit_weights(const ShadingView& scene, const RayBatch& rays, const HitBatch& hits, float* u,
                        float* v) noexcept {
  for (int i = 0; i < rays.count; i += widest) {
    std::uint32_t triangles = 0;
    for (int lane = 0; lane < widest && i + lane < rays.count; ++lane)
      if (hits.primitive[i + lane] >= 0 &&
          static_cast<std::uint32_t>(hits.primitive[i + lane]) < scene.triangle_count)
        triangles |= 1U << lane;
    Corners corners{};
    gather_corners(scene, hits.primitive + i, triangles, corners);
    const PathV origin = load3<PathF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    const auto weights =
        triangle_weights(set_up_triangle(corner(corners, 0) - origin, corner(corners, 1) - origin,
                                         corner(corners, 2) - origin),
                         dir);
    const PathM mask = from_bits<widest>(triangles);
    select(mask, weights.u, PathF(0.0F)).store_unaligned(u + i);
    select(mask, weights.v, PathF(0.0F)).store_unaligned(v + i);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
