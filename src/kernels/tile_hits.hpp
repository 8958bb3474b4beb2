// SPDX-License-Identifier: Apache-2.0
// What a tile carries through the tree, and how it takes hits.
#pragma once

#include "src/kernels/tile_edges.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Blocks of triangles that are met together: of as many leaves as it takes to fill a register, each with the
// groups of rays that reached its leaf.
struct TriangleRun {
  static constexpr int most_blocks = widest / block_size;

  [[gnu::always_inline]] inline const TriangleBlock& block_of(int lane) const {
    return *block[lane / block_size];
  }
  [[gnu::always_inline]] inline std::int32_t primitive(int lane) const {
    return block_of(lane).primitive[lane % block_size];
  }

  const TriangleBlock* block[most_blocks];
  std::uint32_t groups[most_blocks];
  int count = 0; // of blocks
};

// All that a traversal carries. View: how the rays are seen.
template <bool any, class View>
struct TileTraversal {
  TileTraversal(const GeometryView& s, const RayBatch& r, HitBatch& h, const LiveRays& l)
      : scene(s), rays(r), hits(h) {
    for (int g = 0; g < batch_groups; ++g) open[g] = l.bits[g];
  }

  const GeometryView& scene;
  const RayBatch& rays;
  HitBatch& hits;
  std::uint32_t open[batch_groups]; // the rays that still look for a hit: bit l of word g is ray 16 g + l
  typename View::Points points;
  View view;
  TriangleRun waiting; // triangles of leaves that were reached
  std::uint32_t nodes = 0, tests = 0;
  std::uint32_t shortened = 0; // groups that may look less far than the view knows
};

// After hits of the rays in `bits` of group g. Rays that have a hit look no more if any will do.
template <bool any, class View>
FASTRT_INLINE void shorten_group(TileTraversal<any, View>& tile, int g, std::uint32_t bits) {
  if constexpr (any) tile.open[g] &= ~bits;
  tile.shortened |= (!any || tile.open[g] == 0 ? 1U : 0U) << g;
}

// After a leaf: how far the groups that have changed still look. (Not after each test: a group is met by
// several triangles of a leaf, and finding out takes as long as another test.)
template <bool any, class View>
FASTRT_INLINE void shorten_view(TileTraversal<any, View>& tile) {
  TileGroups& groups = tile.view.groups;
  for (std::uint32_t left = tile.shortened; left != 0; left &= left - 1) {
    const int g = __builtin_ctz(left);
    groups.far[g] = any ? -__builtin_inff() : group_far(tile.hits, groups, tile.open[g], g);
  }
  tile.view.far = most_of(groups.far);
  tile.shortened = 0;
}

// Keeps hits of the rays from row i on. Returns the lanes that took them.
template <bool any, class View>
FASTRT_INLINE std::uint32_t keep_hits(TileTraversal<any, View>& tile, int i, const PacketM& hit,
                                      const PacketF& t, std::int32_t primitive) {
  const PacketI exclude = PacketI::load_aligned(tile.rays.exclude + i);
  PacketF best_t = PacketF::load_aligned(tile.hits.t + i);
  PacketI best_primitive = PacketI::load_aligned(tile.hits.primitive + i);
  if constexpr (any) {
    const PacketI id(primitive);
    const PacketM taken = hit & (t < best_t) & simd::bool_cast(id != exclude);
    select_ints<PacketF>(taken, id, best_primitive).store_aligned(tile.hits.primitive + i);
    return to_bits(taken);
  } else {
    const std::uint32_t kept = keep_closest(best_t, best_primitive, exclude, hit, t, primitive);
    if (kept == 0) return 0;
    best_t.store_aligned(tile.hits.t + i);
    best_primitive.store_aligned(tile.hits.primitive + i);
    return kept;
  }
}

// One primitive against the rays of group g in `bits`. meet(ray) gives the lanes that it hits and their t.
template <bool any, class View, class Meet>
FASTRT_INLINE void meet_group(TileTraversal<any, View>& tile, int g, std::uint32_t bits,
                              std::int32_t primitive, const Meet& meet) {
  tile.tests += static_cast<std::uint32_t>(__builtin_popcount(bits));
  std::uint32_t changed = 0;
  for (int k = 0; k < group_size; k += widest) {
    if (widest < group_size && (bits >> k & register_bits) == 0) continue;
    const int i = g * group_size + k;
    const auto [hit, t] = meet(i);
    const PacketM counted = hit & from_bits<widest>(bits >> k);
    if (to_bits(counted) == 0) continue;
    changed |= keep_hits(tile, i, counted, t, primitive) << k;
  }
  if (changed != 0) shorten_group(tile, g, changed);
}

// Of the 16 rays from row `first` on those that a primitive is excluded for: often it is the surface that
// they leave or go to, which all of them would be tested against.
FASTRT_INLINE std::uint32_t rays_that_exclude(const RayBatch& rays, int first, std::int32_t primitive) {
  const PacketI id(primitive);
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest)
    bits |= to_bits(simd::bool_cast(PacketI::load_aligned(rays.exclude + first + k) == id)) << k;
  return bits;
}

struct MetLanes {
  PacketM hit;
  PacketF t;
};

FASTRT_INLINE V3<PacketF> load_dir(const RayBatch& rays, int i) {
  return {PacketF::load_aligned(rays.dir_x + i), PacketF::load_aligned(rays.dir_y + i),
          PacketF::load_aligned(rays.dir_z + i)};
}
FASTRT_INLINE V3<PacketF> load_origin(const RayBatch& rays, int i) {
  return {PacketF::load_aligned(rays.origin_x + i), PacketF::load_aligned(rays.origin_y + i),
          PacketF::load_aligned(rays.origin_z + i)};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
