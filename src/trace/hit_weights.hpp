// SPDX-License-Identifier: Apache-2.0
// (u, v) of hits that are known.
#pragma once

#include "src/trace/shape_weights.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

static void hit_weights(const ShadingView& scene, const RayBatch& rays, const HitBatch& hits, float* u,
                        float* v) noexcept {
  for (int i = 0; i < rays.count; i += widest) {
    const int count = rays.count - i < widest ? rays.count - i : widest;
    InstanceLanes lanes;
    gather_instances(scene.shapes, hits, i, count, lanes);
    std::uint32_t triangles = 0;
    for (int lane = 0; lane < count; ++lane)
      if (lanes.primitive[lane] >= 0 &&
          static_cast<std::uint32_t>(lanes.primitive[lane]) < scene.triangle_count)
        triangles |= 1U << lane;
    const auto [a, b, c] = gather_corners(scene, PathI::load_aligned(lanes.primitive), triangles);
    PathV origin = load3<PathF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    if (lanes.bits != 0) rays_to_objects(lanes, origin, dir);
    alignas(64) float o[3][widest], d[3][widest];
    store3(origin, o[0], o[1], o[2]);
    store3(dir, d[0], d[1], d[2]);
    const auto weights = triangle_weights(set_up_triangle(a - origin, b - origin, c - origin), dir);
    const PathM mask = from_bits<widest>(triangles);
    select(mask, weights.u, PathF(0.0F)).store_unaligned(u + i);
    select(mask, weights.v, PathF(0.0F)).store_unaligned(v + i);
    for (int k = 0; k < count; ++k) {
      if (lanes.primitive[k] < static_cast<std::int32_t>(scene.triangle_count)) continue;
      const ShapeWeights found =
          shape_weights(scene, lanes.primitive[k], V3<float>{o[0][k], o[1][k], o[2][k]},
                        V3<float>{d[0][k], d[1][k], d[2][k]}, hits.t[i + k]);
      u[i + k] = found.u;
      v[i + k] = found.v;
    }
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
