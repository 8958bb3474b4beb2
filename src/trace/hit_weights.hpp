// SPDX-License-Identifier: Apache-2.0
// (u, v) of hits that are known.
#pragma once

#include "src/trace/shape_weights.hpp"

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
    for (int k = i; k < i + widest && k < rays.count; ++k) {
      if (hits.primitive[k] < static_cast<std::int32_t>(scene.triangle_count)) continue;
      const ShapeWeights found = shape_weights(
          scene, hits.primitive[k], V3<float>{rays.origin_x[k], rays.origin_y[k], rays.origin_z[k]},
          V3<float>{rays.dir_x[k], rays.dir_y[k], rays.dir_z[k]}, hits.t[k]);
      u[k] = found.u;
      v[k] = found.v;
    }
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
