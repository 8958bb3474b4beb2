// SPDX-License-Identifier: Apache-2.0
// The two questions about a batch of rays, and the choice of how to trace it.
#pragma once

#include "src/kernels/tile_traversal.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Nothing hit yet. Fills up to the next full group, so that kernels may read whole ones.
FASTRT_INLINE void clear_hits(const RayBatch& rays, HitBatch& hits) {
  for (int i = 0; i < (rays.count + group_size - 1) / group_size * group_size; i += widest) {
    load<PacketF>(rays.t_max + i).store_aligned(hits.t + i);
    PacketI(-1).store_aligned(hits.primitive + i);
  }
}

template <bool any>
static void trace_batch(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  clear_hits(rays, hits);
  if (scene.root == no_child) return;
  if (rays.shape == BatchShape::any) {
    trace_rays_alone<any>(scene, rays, hits);
    return;
  }
  const bool alike = rays.shape == BatchShape::common_origin || rays.shape == BatchShape::parallel;
  if (alike && trace_tile<any>(scene, rays, hits)) return;
  for (int first = 0; first < rays.count; first += widest) trace_packet<any>(scene, rays, hits, first);
}

// The closest hit of every ray: t = t_max and primitive = -1 on a miss.
static void find_closest_hits(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  trace_batch<false>(scene, rays, hits);
}

// Some hit of every ray that has one: only whether primitive >= 0 means anything.
static void find_any_hits(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  trace_batch<true>(scene, rays, hits);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
