// SPDX-License-Identifier: Apache-2.0
// Which triangles of a run may concern which groups of rays: by their rectangles, and by their edges at the
// corners of the groups' rectangles.
#pragma once

#include "src/kernels/pair_list.hpp"
#include "src/kernels/tile_hits.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The lanes of a run that hold triangles.
FASTRT_INLINE std::uint32_t lanes_of(const TriangleRun& run) { return (1U << run.count * block_size) - 1U; }

FASTRT_INLINE std::uint32_t groups_of_any(const TriangleRun& run) {
  std::uint32_t groups = 0;
  for (int k = 0; k < run.count; ++k) groups |= run.groups[k];
  return groups;
}

// What rectangles tell of a run before its edges are known.
struct TouchedRun {
  std::uint32_t some; // triangles that may concern some group
#if !defined(__AVX512DQ__)
  std::uint32_t groups[widest]; // of each triangle
#endif
};

#if defined(__AVX512DQ__)

// Here a register holds as many triangles as there are groups: to hold all against the edges of each other
// is cheap, and the whole batch's rectangle will do before.
template <class View>
FASTRT_INLINE void touch_run(const View& view, const TriangleRun& run, const Rectangles<PacketF>& r,
                             TouchedRun& touched) {
  const PacketM met = (r.x0 <= PacketF(view.x1)) & (r.x1 >= PacketF(view.x0)) & (r.y0 <= PacketF(view.y1)) &
                      (r.y1 >= PacketF(view.y0)) & (r.near <= PacketF(view.far));
  touched.some = to_bits(met) & lanes_of(run);
}

// A register of groups for each triangle.
template <class View, class Edges>
FASTRT_INLINE void list_by_triangles(const View& view, const TriangleRun& run, const Rectangles<PacketF>& r,
                                     std::uint32_t some, const Edges& edges, PairList& list) {
  const StoredRectangles<PacketF> stored(r);
  for (; some != 0; some &= some - 1) {
    const int i = __builtin_ctz(some);
    const std::uint32_t groups =
        touched_groups<View::begins_apart>(view.groups, stored, i) & run.groups[i / block_size];
    append_groups(i, groups_inside_edges(view.groups, edges, i, groups), list);
  }
}

// A register of triangles for each group.
template <class View, class Edges>
FASTRT_INLINE void list_by_groups(const View& view, const TriangleRun& run, const Rectangles<PacketF>& r,
                                  std::uint32_t groups, const Edges& edges, PairList& list) {
  const TileGroups& all = view.groups;
  alignas(64) std::uint32_t reached[widest];
  for (int k = 0; k < TriangleRun::most_blocks; ++k)
    Ints<block_size>(static_cast<std::int32_t>(k < run.count ? run.groups[k] : 0U))
        .store_aligned(reinterpret_cast<std::int32_t*>(reached) + k * block_size);
  const PacketI reach = PacketI::load_aligned(reinterpret_cast<const std::int32_t*>(reached));
  for (; groups != 0; groups &= groups - 1) {
    const int g = __builtin_ctz(groups);
    const PacketM met = touching_rectangles<View::begins_apart>(all, r, g) & triangles_around(edges, all, g);
    const std::uint32_t bits =
        to_bits(met) & to_bits(simd::bool_cast((reach & PacketI(1 << g)) != PacketI(0)));
    append_pairs(numbers_above(20) | PacketI(g << 16), bits, list);
  }
}

// By triangles where they are few, as measured.
template <class View, class Edges>
FASTRT_INLINE void list_pairs(const View& view, const TriangleRun& run, const Rectangles<PacketF>& r,
                              const TouchedRun& touched, const Edges& edges, PairList& list) {
  const std::uint32_t groups = groups_of_any(run);
  if (__builtin_popcount(touched.some) * 5 < __builtin_popcount(groups) * 2)
    list_by_triangles(view, run, r, touched.some, edges, list);
  else
    list_by_groups(view, run, r, groups, edges, list);
}

#else

// touch_groups() for a run's triangles, each of which may only touch groups that reached its leaf.
template <class View>
FASTRT_INLINE void touch_run(const View& view, const TriangleRun& run, const Rectangles<PacketF>& bounds,
                             TouchedRun& touched) {
  const std::uint32_t of_any = groups_of_any(run);
  touched.some = touch_groups(view, bounds, lanes_of(run), of_any, touched.groups);
  for (int k = 0; k < run.count; ++k) {
    if (run.groups[k] == of_any) continue;
    for (int i = k * block_size; i < (k + 1) * block_size; ++i) {
      touched.groups[i] &= run.groups[k];
      touched.some &= ~((touched.groups[i] == 0 ? 1U : 0U) << i);
    }
  }
}

// A triangle that covers more groups than this by its rectangle is held against their corners by its edges.
inline constexpr int many_groups = 4;

template <class View, class Edges>
FASTRT_INLINE void list_pairs(const View& view, const TriangleRun& /*run*/, const Rectangles<PacketF>& /*r*/,
                              const TouchedRun& touched, const Edges& edges, PairList& list) {
  for (std::uint32_t some = touched.some; some != 0; some &= some - 1) {
    const int i = __builtin_ctz(some);
    std::uint32_t groups = touched.groups[i];
    if (__builtin_popcount(groups) > many_groups) groups = groups_inside_edges(view.groups, edges, i, groups);
    append_groups(i, groups, list);
  }
}

#endif

} // namespace fastrt::FASTRT_ISA_NAMESPACE
