// SPDX-License-Identifier: Apache-2.0
// A whole batch of rays with a common origin or a common direction through the wide tree at once. A node is
// met once for all rays; each entry of the stack knows which groups of 16 rays it concerns, so deep nodes
// concern few.
#pragma once

#include "src/kernels/tile_density.hpp"
#include "src/kernels/tile_leaves.hpp"
#include "src/kernels/tile_split.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

struct alignas(16) TileEntry {
  std::uint32_t child;
  std::uint32_t groups;
  float near;
};

// What will be looked at soon is asked for now: a miss beyond the last cache costs as much as testing a few
// blocks.
FASTRT_INLINE void prefetch_child(const GeometryView& scene, std::uint32_t child) {
  const char* at;
  int lines = 4;
  if (!is_leaf(child)) {
    at = reinterpret_cast<const char*>(&scene.nodes[child]);
  } else if (leaf_group(child) == triangle_group) {
    at = reinterpret_cast<const char*>(&scene.triangles[leaf_first_block(child)]);
    lines = 3;
  } else if (leaf_group(child) == sphere_group) {
    at = reinterpret_cast<const char*>(&scene.spheres[leaf_first_block(child)]);
    lines = 2;
  } else {
    at = reinterpret_cast<const char*>(&scene.shape_blocks[leaf_first_block(child)]);
    lines = 2;
  }
  for (int i = 0; i < lines; ++i) __builtin_prefetch(at + 64 * i);
}

// Puts the children that some of `groups` touch onto the stack. What comes first is on top: of rays that look
// for the closest hit the nearest child, of others the largest one, which is likeliest to hold something in
// their way. That is the last one. (Those push without a branch: what nothing touches is written over.)
template <bool any, class View>
FASTRT_INLINE TileEntry* push_children(const TileTraversal<any, View>& tile, const WideNode& node,
                                       std::uint32_t groups, TileEntry* top) {
  TileEntry* const bottom = top;
  for_each_touched(tile.view, node, groups, [&](int i, float near, std::uint32_t touched) {
    if (!any && touched == 0) return;
    prefetch_child(tile.scene, node.child[i]);
    TileEntry* place = top;
    if (!any)
      for (; place != bottom && place[-1].near < near; --place) *place = place[-1];
    store_together(node.child[i], touched, __builtin_bit_cast(std::uint32_t, near), 0U, place);
    top += touched != 0 ? 1 : 0;
  });
  return top;
}

template <bool any, class View>
FASTRT_INLINE void traverse(TileTraversal<any, View>& tile) {
  TileEntry stack[max_tree_stack];
  stack[0] = {tile.scene.root, (1U << batch_groups) - 1U, -__builtin_inff()};
  TileEntry* top = stack + 1;
  while (top != stack) {
    const TileEntry entry = *--top;
    const std::uint32_t groups = entry.groups & far_groups(tile.view.groups, entry.near);
    if (groups == 0) continue;
    if (is_leaf(entry.child)) {
      meet_leaf(tile, entry.child, groups);
      if (tile.shortened != 0) shorten_view(tile);
      continue;
    }
    const WideNode& node = tile.scene.nodes[entry.child];
    ++tile.nodes;
    top = push_children(tile, node, groups, top);
  }
  if (tile.waiting.count != 0) meet_waiting(tile);
}

// Sees to how far the groups of a tile that has been projected look.
template <bool any, class View>
FASTRT_INLINE void aim_tile(TileTraversal<any, View>& tile) {
  find_far(tile.hits, tile.open, tile.view.groups);
  aim_view(tile.view);
}

template <bool any, class View>
[[gnu::noinline]] static void trace_aimed(TileTraversal<any, View>& tile) noexcept {
  traverse(tile);
  count_tests(tile.hits, tile.nodes, tile.tests);
}

// How far the rays of a batch, or of a part of it, have come as one. What is left goes as beams or packets;
// or alone, where so many primitives lie before them that neighbours have little in common.
enum class TileEnd { traced, scattered, beams, alone };

// Traces the rays in `live` as one. If they are scattered, nothing is done but to move some of them to
// `others`.
template <bool any, class View>
static TileEnd trace_together(const GeometryView& scene, const RayBatch& rays, HitBatch& hits, LiveRays& live,
                              LiveRays& others) noexcept {
  TileTraversal<any, View> tile(scene, rays, hits, live);
  tile.view.frame = make_tile_frame(rays, live);
  const Projection projection =
      project_batch(scene, rays, live, tile.view.frame, tile.points, tile.view.groups);
  if (projection == Projection::too_wide) return TileEnd::beams;
  if (projection == Projection::scattered)
    return split_groups(tile.points, tile.view.groups, live, others) ? TileEnd::scattered : TileEnd::beams;
  aim_tile(tile);
  const float crowd = crowd_before<any>(scene, tile.view);
  if (crowd > most_before_beams<any> && scene.few_shapes != 0) return TileEnd::alone;
  if (crowd > most_before_tile<any>) return TileEnd::beams;
  trace_aimed(tile);
  return TileEnd::traced;
}

// Whether what tiles cull by holds for these rays.
FASTRT_INLINE bool suits_tiles(const GeometryView& scene, const LiveRays& live) {
  return !live.backwards && !live.extreme && is_usual_length(scene.largest_coordinate);
}

// Traces the batch as one, or in few parts. Where its rays don't allow that, some of them may have been
// traced all the same. hits: cleared by the caller.
template <bool any, class View>
static TileEnd trace_tile_in(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  LiveRays parts[max_tile_splits + 1];
  parts[0] = find_live_rays(rays);
  if (parts[0].first < 0) return TileEnd::traced;
  if (!suits_tiles(scene, parts[0])) return TileEnd::beams;
  int count = 1, splits = 0;
  while (count != 0) {
    LiveRays others;
    const TileEnd end = trace_together<any, View>(scene, rays, hits, parts[count - 1], others);
    if (end == TileEnd::traced)
      --count;
    else if (end != TileEnd::scattered)
      return end;
    else if (splits++ == max_tile_splits)
      return TileEnd::beams;
    else
      parts[count++] = others;
  }
  return TileEnd::traced;
}

// Traces the batch as one; false, and nothing done, where it is scattered.
template <bool any, class View>
static bool trace_dense_tile_in(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  const LiveRays live = find_live_rays(rays);
  if (live.first < 0) return true;
  if (!suits_tiles(scene, live)) return false;
  TileTraversal<any, View> tile(scene, rays, hits, live);
  tile.view.frame = make_tile_frame(rays, live);
  if (project_batch(scene, rays, live, tile.view.frame, tile.points, tile.view.groups) != Projection::done)
    return false;
  aim_tile(tile);
  if (primitives_seen(scene, tile.view, area_limit<View>) > most_in_tile) return false;
  trace_aimed(tile);
  return true;
}

template <bool any>
static TileEnd trace_tile(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  return is_parallel(rays.shape) ? trace_tile_in<any, ParallelView>(scene, rays, hits)
                                 : trace_tile_in<any, TileView>(scene, rays, hits);
}

template <bool any>
[[gnu::noinline]] static bool trace_dense_tile(const GeometryView& scene, const RayBatch& rays,
                                               HitBatch& hits) noexcept {
  return is_parallel(rays.shape) ? trace_dense_tile_in<any, ParallelView>(scene, rays, hits)
                                 : trace_dense_tile_in<any, TileView>(scene, rays, hits);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
