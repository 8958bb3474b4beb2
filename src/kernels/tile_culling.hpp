// SPDX-License-Identifier: Apache-2.0
// What a batch sees of a node's boxes.
#pragma once

#include "src/kernels/tile_rectangles.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Which of a node's columns hold the least and the greatest corner along an axis of the frame, and the axis
// itself.
struct ExtentAxis {
  V3<float> axis;
  int low_x, low_y, low_z; // 0: the lower planes are least; 8: the upper ones
  float offset;            // of the origin along the axis
};

template <class Frame>
FASTRT_INLINE ExtentAxis extent_axis(const Frame& f, const V3<float>& axis) {
  return {axis, axis.x < 0.0F ? wide_children : 0, axis.y < 0.0F ? wide_children : 0,
          axis.z < 0.0F ? wide_children : 0, dot(f.origin, axis)};
}

template <class F>
struct Extent {
  F low, high;
};

// The extent of eight boxes (or four) along an axis; `columns` points at the node's first column.
template <class F>
FASTRT_INLINE Extent<F> box_extent(const ExtentAxis& a, const float* columns, const F& padding) {
  const F x(a.axis.x), y(a.axis.y), z(a.axis.z), offset(a.offset);
  const float* const cy = columns + 2 * wide_children;
  const float* const cz = columns + 4 * wide_children;
  const F low = cull_mul_add(
      z, load<F>(cz + a.low_z),
      cull_mul_add(y, load<F>(cy + a.low_y), cull_mul_sub(x, load<F>(columns + a.low_x), offset)));
  const F high =
      cull_mul_add(z, load<F>(cz + (wide_children - a.low_z)),
                   cull_mul_add(y, load<F>(cy + (wide_children - a.low_y)),
                                cull_mul_sub(x, load<F>(columns + (wide_children - a.low_x)), offset)));
  return {low - padding, high + padding};
}

// The projection with what node tests need of it.
struct TileView {
  using Points = TilePoints;
  // Whether groups begin at depths of their own, so that they are behind boxes that others reach.
  static constexpr bool begins_apart = false;
  static constexpr bool strays = false; // rays may be elsewhere than their points
  TileFrame frame;
  ExtentAxis u, v, w;
  ExtentAxis
      sides[4]; // inner normals of the planes through the origin and the sides of the batch's rectangle
  TileGroups groups;
  float x0, x1, y0, y1, far; // around all groups
};

// The same of parallel rays.
struct ParallelView : TileView {
  static constexpr bool begins_apart = true;
};

template <class View>
FASTRT_INLINE void bound_view(View& view) {
  const GroupBounds bounds = bounds_of(view.groups);
  view.x0 = bounds.x0;
  view.x1 = bounds.x1;
  view.y0 = bounds.y0;
  view.y1 = bounds.y1;
  view.far = most_of(view.groups.far);
}

FASTRT_INLINE V3<float> tilted(const V3<float>& across, const V3<float>& w, float sign, float at) {
  return {sign * (across.x - at * w.x), sign * (across.y - at * w.y), sign * (across.z - at * w.z)};
}

FASTRT_INLINE void aim_view(TileView& view) {
  const TileFrame& f = view.frame;
  bound_view(view);
  view.u = extent_axis(f, f.u);
  view.v = extent_axis(f, f.v);
  view.w = extent_axis(f, f.w);
  if (!f.perspective) return;
  view.sides[0] = extent_axis(f, tilted(f.u, f.w, 1.0F, view.x0));
  view.sides[1] = extent_axis(f, tilted(f.u, f.w, -1.0F, view.x1));
  view.sides[2] = extent_axis(f, tilted(f.v, f.w, 1.0F, view.y0));
  view.sides[3] = extent_axis(f, tilted(f.v, f.w, -1.0F, view.y1));
}

// Boxes that reach behind the origin have no rectangle; the four sides still tell which of them the batch
// can't meet.
FASTRT_INLINE std::uint32_t within_sides(const TileView& view, const float* columns) {
  using N = Floats<node_lanes>;
  const N padding(4.0F * view.frame.padding);
  MaskOf<N> within = N(0.0F) <= box_extent(view.sides[0], columns, padding).high;
  for (int i = 1; i < 4; ++i) within = within & (N(0.0F) <= box_extent(view.sides[i], columns, padding).high);
  return to_bits(within);
}

// Of the boxes in `bits` those that may be met for all that their rectangles say; low: where they begin.
FASTRT_INLINE std::uint32_t boxes_ahead(const TileView& view, const float* columns,
                                        const Floats<node_lanes>& low, std::uint32_t bits) {
  if (!view.frame.perspective || (to_bits(low <= Floats<node_lanes>(0.0F)) & bits) == 0) return bits;
  return bits & within_sides(view, columns);
}

// The node's children that may be met by some of the batch: act(child's place, where it begins, the groups of
// `groups` that touch it), of which the last may still be none.
template <class View, class Act>
FASTRT_INLINE void for_each_touched(const View& view, const WideNode& node, std::uint32_t groups,
                                    const Act& act) {
  using N = Floats<node_lanes>;
  const N padding(view.frame.padding);
  for (int half = 0; half < wide_children; half += node_lanes) {
    const float* const columns = node.lower_x + half;
    const Extent<N> w = box_extent(view.w, columns, padding);
    const Extent<N> u = box_extent(view.u, columns, padding);
    const Extent<N> v = box_extent(view.v, columns, padding);
    const Rectangles<N> r = project_extent(view.frame, u.low, u.high, v.low, v.high, w.low, w.high);
    const MaskOf<N> met = (r.x0 <= N(view.x1)) & (r.x1 >= N(view.x0)) & (r.y0 <= N(view.y1)) &
                          (r.y1 >= N(view.y0)) & (w.high >= N(view.frame.near)) & (w.low <= N(view.far));
    const StoredRectangles<N> stored(r);
    for (std::uint32_t bits = boxes_ahead(view, columns, w.low, to_bits(met)); bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      act(half + i, stored.near[i], touched_groups<View::begins_apart>(view.groups, stored, i) & groups);
    }
  }
}

// Groups that still look as far as `near`.
FASTRT_INLINE std::uint32_t far_groups(const TileGroups& groups, float near) {
  std::uint32_t bits = 0;
  for (int g = 0; g < batch_groups; g += widest)
    bits |= to_bits(PacketF::load_aligned(groups.far + g) >= PacketF(near)) << g;
  return bits;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
