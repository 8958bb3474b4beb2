// SPDX-License-Identifier: Apache-2.0
// A beam in an inner node: groups against its eight boxes, and single rays where a box is small beside a
// group or is a leaf's. What they reach goes onto the stack.
#pragma once

#include "src/kernels/beam_culling.hpp"
#include "src/kernels/beam_order.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Bits of boxes (in turn for the groups of a step) to bits 4 * box + group.
FASTRT_INLINE std::uint32_t spread_pairs(std::uint32_t boxes, int half, int step) {
#if defined(__AVX512DQ__)
  return _pdep_u32(boxes, 0x33333333U << (2 * step)) << (beam_groups * half);
#elif defined(__BMI2__)
  return _pdep_u32(boxes, 0x11111111U << step) << (beam_groups * half);
#else
  return ((boxes & 1U) | (boxes & 2U) << 3U | (boxes & 4U) << 6U | (boxes & 8U) << 9U)
         << (beam_groups * half + step);
#endif
}

// The boxes of leaves, with all groups.
FASTRT_INLINE std::uint32_t leaf_pairs(const WideNode& node) {
  std::uint32_t pairs = 0;
  for (int half = 0; half < wide_children; half += node_lanes) {
    const auto child =
        Ints<node_lanes>::load_aligned(reinterpret_cast<const std::int32_t*>(node.child) + half);
    const std::uint32_t leaves = to_bits(simd::bool_cast(child < Ints<node_lanes>(0)));
#if defined(__BMI2__)
    pairs |= _pdep_u32(leaves, 0x11111111U) * 15U;
#else
    pairs |= spread_pairs(leaves, half, 0) * 15U;
#endif
  }
  return pairs;
}

// Pairs of a box and a group, bit 4 * box + group: those that touch, and those where the box is small beside
// the group.
struct TouchedPairs {
  std::uint32_t touched, small;
};

FASTRT_INLINE TouchedPairs touch_pairs(const Beam& beam, const WideNode& node, StoredExtents& out) {
  const LeafF padding(beam.padding);
  TouchedPairs pairs{0, 0};
  for (int half = 0; half < wide_children; half += node_lanes) {
    const float* const columns = node.lower_x + half;
    Extents<LeafF> e{axis_extent(columns, beam.x, padding), axis_extent(columns, beam.y, padding),
                     in_depth(beam, axis_extent(columns, beam.z, padding))};
    e.w.low = max(e.w.low, LeafF(0.0F));
    out.store(e, half);
    const Grouped boxes = for_groups(e);
    const GroupedF size = for_groups(LeafF(2.0F) * ((e.u.high - e.u.low) * (e.v.high - e.v.low)));
    for (int step = 0; step < group_steps; ++step) {
      const GroupRectangles r = rectangles_of(beam.groups, step, boxes.w.low, boxes.w.high);
      pairs.touched |= spread_pairs(to_bits(touch_boxes(r, boxes)), half, step);
      pairs.small |= spread_pairs(to_bits((r.x1 - r.x0) * (r.y1 - r.y0) > size), half, step);
    }
  }
  return pairs;
}

// Puts the children of a node that some of `rays` reach onto the stack; returns the new top.
FASTRT_INLINE int push_children(const Beam& beam, const WideNode& node, std::uint64_t rays, BeamStack& stack,
                                int top) {
  StoredExtents extents;
  const TouchedPairs pairs = touch_pairs(beam, node, extents);
  const std::uint32_t touched = pairs.touched & groups_with(rays) * 0x11111111U;
  ReachedRays reached(touched, rays);
  for (std::uint32_t asked = touched & (pairs.small | leaf_pairs(node)); asked != 0; asked &= asked - 1) {
    const auto at = static_cast<std::uint32_t>(__builtin_ctz(asked));
    reached.narrow(asked & (0U - asked),
                   touch_rays(beam.rays, extents.of(at / beam_groups), static_cast<int>(at % beam_groups)));
  }
  return reached.push(node, extents.begin, stack, top);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
