// SPDX-License-Identifier: Apache-2.0
// What of a beam can reach boxes: groups against eight of them at once, and rays against one.
#pragma once

#include "src/kernels/beam_setup.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Boxes (or triangles), one per lane, by their extents across the beam and in depth.
template <class F>
struct Extents {
  Extent<F> u, v, w;
};

// Lower and upper planes of a node's boxes along an axis, padded.
template <class F>
FASTRT_INLINE Extent<F> axis_extent(const float* columns, int axis, const F& padding) {
  const float* const lower = columns + 2 * axis * wide_children;
  return {load<F>(lower) - padding, load<F>(lower + wide_children) + padding};
}

template <class F>
FASTRT_INLINE Extent<F> in_depth(const Beam& beam, const Extent<F>& along) {
  const F depth(beam.depth);
  if (beam.backwards) return {negate(along.high) - depth, negate(along.low) - depth};
  return {along.low - depth, along.high - depth};
}

FASTRT_INLINE Extent<LeafF> padded(const Extent<LeafF>& e, const LeafF& padding) {
  return {e.low - padding, e.high + padding};
}

// Groups that are held against the boxes at a time, in turn in each box's lanes.
inline constexpr int groups_at_once = widest / node_lanes;
inline constexpr int group_steps = beam_groups / groups_at_once;
using GroupedF = Floats<widest>;
static_assert(leaf_lanes == node_lanes);

// Each lane for all groups that are looked at together.
FASTRT_INLINE GroupedF for_groups(const LeafF& lanes) {
#if defined(__AVX512DQ__)
  const __m512i twice = _mm512_setr_epi32(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7);
  return GroupedF(_mm512_permutexvar_ps(twice, _mm512_castps256_ps512(lanes.data)));
#else
  return lanes;
#endif
}

// What a column of groups holds for those of one step.
FASTRT_INLINE GroupedF of_groups(const float* column, int step) {
#if defined(__AVX512DQ__)
  std::int64_t two;
  __builtin_memcpy(&two, column + 2 * step, sizeof(two));
  return GroupedF(_mm512_castsi512_ps(_mm512_set1_epi64(two)));
#else
  return GroupedF(column[step]);
#endif
}

// The rays that still look as far as `near`.
FASTRT_INLINE std::uint64_t rays_as_far_as(const BeamRays& rays, float near) {
  std::uint64_t bits = 0;
  for (int i = 0; i < beam_size; i += widest)
    bits |= std::uint64_t{to_bits(PacketF::load_aligned(rays.far + i) >= PacketF(near))} << i;
  return bits;
}

// Where the groups of a step lie between two depths.
struct GroupRectangles {
  GroupedF x0, x1, y0, y1;
};

FASTRT_INLINE GroupRectangles rectangles_of(const BeamGroups& groups, int step, const GroupedF& begin,
                                            const GroupedF& end) {
  const auto low = [&](const float* at, const float* slopes) {
    const GroupedF slope = of_groups(slopes, step), from = of_groups(at, step);
    return min(cull_mul_add(slope, begin, from), cull_mul_add(slope, end, from));
  };
  const auto high = [&](const float* at, const float* slopes) {
    const GroupedF slope = of_groups(slopes, step), from = of_groups(at, step);
    return max(cull_mul_add(slope, begin, from), cull_mul_add(slope, end, from));
  };
  return {low(groups.x0, groups.slope_x0), high(groups.x1, groups.slope_x1), low(groups.y0, groups.slope_y0),
          high(groups.y1, groups.slope_y1)};
}

using Grouped = Extents<GroupedF>;
FASTRT_INLINE Grouped for_groups(const Extents<LeafF>& e) {
  return {{for_groups(e.u.low), for_groups(e.u.high)},
          {for_groups(e.v.low), for_groups(e.v.high)},
          {for_groups(max(e.w.low, LeafF(0.0F))), for_groups(e.w.high)}};
}

// The groups of a step that touch the boxes.
FASTRT_INLINE PacketM touch_boxes(const GroupRectangles& r, const Grouped& e) {
  return (r.x0 <= e.u.high) & (r.x1 >= e.u.low) & (r.y0 <= e.v.high) & (r.y1 >= e.v.low) &
         (e.w.high >= GroupedF(0.0F));
}

// Places of pairs of a group and a lane among bits: pair_lanes * group + lane.
inline constexpr int pair_lanes = 8;

// Bits of lanes (in turn for the groups of a step) to bits of places.
FASTRT_INLINE std::uint32_t places_of(std::uint32_t lanes, int step) {
#if defined(__AVX512DQ__)
  return (_pext_u32(lanes, 0x5555U) | _pext_u32(lanes, 0xAAAAU) << pair_lanes) << (2 * step * pair_lanes);
#else
  return lanes << (step * pair_lanes);
#endif
}

// All places of the groups of `rays`.
FASTRT_INLINE std::uint32_t places_of(std::uint64_t rays) {
  const __m128i none = _mm_cmpeq_epi16(_mm_cvtsi64_si128(static_cast<long long>(rays)), _mm_setzero_si128());
  return ~static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_packs_epi16(none, none)));
}

// The places of groups that touch the boxes.
FASTRT_INLINE std::uint32_t touch_boxes(const Beam& beam, const Extents<LeafF>& e) {
  const Grouped boxes = for_groups(e);
  std::uint32_t touched = 0;
  for (int step = 0; step < group_steps; ++step) {
    const GroupRectangles r = rectangles_of(beam.groups, step, boxes.w.low, boxes.w.high);
    touched |= places_of(to_bits(touch_boxes(r, boxes)), step);
  }
  return touched;
}

// One box's extents, for looking at single rays.
struct LoneExtents {
  float u0, u1, v0, v1, begin, end; // depths: 0 or more
};

// Extents of the boxes of a node or of a run, as columns: across the beam, and depths from 0 on.
struct StoredExtents {
  alignas(32) float u0[wide_children], u1[wide_children], v0[wide_children], v1[wide_children],
      begin[wide_children], end[wide_children];

  // A register of them, from box `first` on. Depths: 0 or more.
  [[gnu::always_inline]] inline void store(const Extents<LeafF>& e, int first) {
    e.u.low.store_aligned(u0 + first);
    e.u.high.store_aligned(u1 + first);
    e.v.low.store_aligned(v0 + first);
    e.v.high.store_aligned(v1 + first);
    e.w.low.store_aligned(begin + first);
    e.w.high.store_aligned(end + first);
  }
  [[gnu::always_inline]] inline LoneExtents of(std::uint32_t i) const {
    return {u0[i], u1[i], v0[i], v1[i], begin[i], end[i]};
  }
};

// The rays of group g that can touch a box, from where they begin on.
FASTRT_INLINE std::uint32_t touch_rays(const BeamRays& rays, const LoneExtents& e, int g) {
  const PacketF end(e.end);
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) {
    const int i = g * group_size + k;
    const PacketF x = PacketF::load_aligned(rays.x + i), y = PacketF::load_aligned(rays.y + i);
    const PacketF sx = PacketF::load_aligned(rays.slope_x + i), sy = PacketF::load_aligned(rays.slope_y + i);
    const PacketF from = PacketF::load_aligned(rays.begin + i), begin = max(from, PacketF(e.begin));
    const PacketF xb = cull_mul_add(sx, begin, x), xe = cull_mul_add(sx, end, x);
    const PacketF yb = cull_mul_add(sy, begin, y), ye = cull_mul_add(sy, end, y);
    const PacketM met = (min(xb, xe) <= PacketF(e.u1)) & (max(xb, xe) >= PacketF(e.u0)) &
                        (min(yb, ye) <= PacketF(e.v1)) & (max(yb, ye) >= PacketF(e.v0)) & (from <= end);
    bits |= to_bits(met) << k;
  }
  return bits;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
