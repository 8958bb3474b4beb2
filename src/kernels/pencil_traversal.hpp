// SPDX-License-Identifier: Apache-2.0
// Whole batches of rays that smooth surfaces have mirrored or refracted through the wide tree, as tiles whose
// rays are seen along a pencil.
#pragma once

#include "src/kernels/beam_setup.hpp"
#include "src/kernels/packed_batch.hpp"
#include "src/kernels/pencil_culling.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Fewer rays than this are no pencil; they go as beams.
inline constexpr int least_pencil = 64;
// Groups of a batch that are tried in vain.
inline constexpr int max_pencil_failures = 2;

using PencilTraversal = TileTraversal<false, PencilView>;

FASTRT_INLINE void meet_run(PencilTraversal& tile, const TriangleRun& run) {
  const PencilFrame& f = tile.view.frame;
  const V3<PacketF> origin = broadcast3<PacketF>(f.origin);
  const V3<PacketF> a = load_vertices(run, 0) - origin, b = load_vertices(run, 1) - origin,
                    c = load_vertices(run, 2) - origin;
  // All hits lie in a triangle's box, not in the triangle as the pencil sees it: that may be edge-on.
  const V3<PacketF> low{min(a.x, min(b.x, c.x)), min(a.y, min(b.y, c.y)), min(a.z, min(b.z, c.z))};
  const V3<PacketF> high{max(a.x, max(b.x, c.x)), max(a.y, max(b.y, c.y)), max(a.z, max(b.z, c.z))};
  const Rectangles<PacketF> bounds = project_box(f, low, high);
  TouchedRun touched;
  touch_run(tile.view, run, bounds, touched);
  if (touched.some == 0) return;
  PencilEdges edges;
  // (With rounding: corners of tiny triangles may be as far apart as they are wrong.)
  lines_in_pencil(tile.view, a, b, c, largest(high - low) + PacketF(f.padding), edges);
  PairList list;
  list_pairs(tile.view, run, bounds, touched, edges, list);
  for_each_pair(tile, run, edges, list, [&](int i, int g, std::uint32_t rays) {
    const std::uint32_t towards = rays & rays_towards(tile.points, edges, i, g);
    if (towards != 0) meet_own_origins(tile, run, i, g, towards);
  });
}

// The largest |coordinate| of the live rays' origins.
FASTRT_INLINE float largest_origin(const RayBatch& rays, const LiveRays& live) {
  PacketF most(0.0F);
  for (int i = 0; i < rays.count; i += widest)
    most = max(select(live_lanes(live, i), largest(load_origin(rays, i)), PacketF(0.0F)), most);
  return reduce_max(most);
}

// Traces those of the live rays that a pencil through group `seed` fits, and takes them out of `live`. False,
// and nothing done, if they are few.
static bool trace_pencil(const GeometryView& scene, const RayBatch& rays, HitBatch& hits, float size,
                         int seed, LiveRays& live) noexcept {
  PencilTraversal tile(scene, rays, hits, live);
  PencilView& view = tile.view;
  PencilFrame& f = view.frame;
  f.size = size;
  if (!fit_pencil(scene, rays, seed, live.bits[seed], f)) return false;
  PencilErrors errors{PacketF(0.0F), PacketF(0.0F), PacketF(0.0F), PacketF(0.0F)};
  const auto place_group = [&](int g) {
    std::uint32_t bits = 0;
    for (int k = 0; k < group_size; k += widest)
      bits |= place_rays(f, rays, g * group_size + k, live.bits[g] >> k & register_bits, tile.points, errors)
              << k;
    return bits;
  };
  if (__builtin_popcount(place_group(seed)) * 4 < __builtin_popcount(live.bits[seed]) * 3) return false;
  int count = 0;
  for (int g = 0; g < batch_groups; ++g) {
    tile.open[g] = place_group(g);
    count += __builtin_popcount(tile.open[g]);
  }
  if (count < least_pencil) return false;
  bound_groups(tile.points, errors, view);
  find_far(hits, tile.open, view.groups);
  aim_view(view);
  if (primitives_seen(scene, view, __builtin_inff()) > most_in_pencil) return false;
  for (int g = 0; g < batch_groups; ++g) live.bits[g] &= ~tile.open[g];
  traverse(tile);
  count_tests(hits, tile.nodes, tile.tests);
  return true;
}

// Whether most of a group's rays leave one primitive, or none that they exclude: then they are likely to be a
// pencil.
FASTRT_INLINE bool leave_together(const RayBatch& rays, int g, std::uint32_t live) {
  const int first = g * group_size;
  const std::uint32_t same = rays_that_exclude(rays, first, rays.exclude[first + __builtin_ctz(live)]) & live;
  return __builtin_popcount(same) * 2 > __builtin_popcount(live);
}

// Traces what of the batch lies in pencils and takes it out of `looking`; false if there is none. hits:
// cleared by the caller.
static bool trace_pencils(const GeometryView& scene, const RayBatch& rays, RayBits& looking,
                          HitBatch& hits) noexcept {
  LiveRays live = find_live_rays(rays);
  if (live.first < 0 || live.backwards || live.extreme) return false;
  const float most = largest_origin(rays, live), size = larger(most, scene.largest_coordinate);
  if (!(most <= far_origin * scene.largest_coordinate && is_usual_length(size))) return false;
  int failures = 0;
  bool some = false;
  for (int g = 0; g < batch_groups && failures < max_pencil_failures; ++g) {
    if (__builtin_popcount(live.bits[g]) < group_size / 2) continue;
    if (failures != 0 && !leave_together(rays, g, live.bits[g])) continue;
    if (trace_pencil(scene, rays, hits, size, g, live))
      some = true;
    else
      ++failures;
  }
  // (Rays that are not live hit nothing.)
  for (int g = 0; g < batch_groups; ++g) looking.of_group[g] = live.bits[g];
  return some;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
