// SPDX-License-Identifier: Apache-2.0
// Boxes as rectangles of a batch's projection, and the groups of rays that rectangles touch.
#pragma once

#include "src/kernels/tile_setup.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// A rectangle per lane, and the depths at which its contents begin and end.
template <class F>
struct Rectangles {
  F x0, x1, y0, y1, near, end;
};

// The part of the plane that a box covers, given its extent along u, v, w seen from the origin. Behind the
// origin or around it the answer is the whole plane.
template <class F>
FASTRT_INLINE Rectangles<F> project_extent(const TileFrame& f, const F& u0, const F& u1, const F& v0,
                                           const F& v1, const F& w0, const F& w1) {
  if (!f.perspective) return {u0, u1, v0, v1, w0, w1};
  const F zero(0.0F), one(1.0F), everywhere(__builtin_inff()), nowhere(-__builtin_inff());
  const F nearest = one / w0, farthest = one / w1;
  const MaskOf<F> around = w0 <= zero;
  const auto low = [&](const F& a) {
    return select(around, nowhere, a * select(a < zero, nearest, farthest));
  };
  const auto high = [&](const F& a) {
    return select(around, everywhere, a * select(a > zero, nearest, farthest));
  };
  const F x0 = low(u0), x1 = high(u1), y0 = low(v0), y1 = high(v1);
  const F margin(rectangle_margin);
  return {x0 - (abs(x0) + one) * margin,
          x1 + (abs(x1) + one) * margin,
          y0 - (abs(y0) + one) * margin,
          y1 + (abs(y1) + one) * margin,
          w0,
          w1};
}

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

// Groups that a rectangle touches and that look from before `end` as far as `near`.
template <bool apart>
FASTRT_INLINE std::uint32_t touched_groups(const TileGroups& groups, float x0, float x1, float y0, float y1,
                                           float near, float end) {
  std::uint32_t bits = 0;
  for (int g = 0; g < batch_groups; g += widest) {
    PacketM touched = (PacketF::load_aligned(groups.x0 + g) <= PacketF(x1)) &
                      (PacketF::load_aligned(groups.x1 + g) >= PacketF(x0)) &
                      (PacketF::load_aligned(groups.y0 + g) <= PacketF(y1)) &
                      (PacketF::load_aligned(groups.y1 + g) >= PacketF(y0)) &
                      (PacketF::load_aligned(groups.far + g) >= PacketF(near));
    if (apart) touched = touched & (PacketF::load_aligned(groups.begin + g) <= PacketF(end));
    bits |= to_bits(touched) << g;
  }
  return bits;
}

// About as many groups can be held against all rectangles at once in the time that `rectangle_cost /
// group_cost` rectangles take to be held against all groups.
inline constexpr int group_cost = 5, rectangle_cost = widest == batch_groups ? 7 : 10;

// The groups of `groups` that each rectangle touches, as touched_groups() finds them, for the lanes in
// `lanes`; 0 elsewhere. Returns the lanes that touch any.
template <bool apart, class F>
FASTRT_INLINE std::uint32_t touch_groups(const TileGroups& all, const Rectangles<F>& r, std::uint32_t lanes,
                                         std::uint32_t groups, std::uint32_t* touched) {
  constexpr int width = width_of<F>;
  if (__builtin_popcount(groups) * group_cost <= __builtin_popcount(lanes) * rectangle_cost) {
    IntsOf<F> bits(0);
    std::uint32_t some = 0;
    for (; groups != 0; groups &= groups - 1) {
      const int g = __builtin_ctz(groups);
      MaskOf<F> met = (r.x0 <= F(all.x1[g])) & (r.x1 >= F(all.x0[g])) & (r.y0 <= F(all.y1[g])) &
                      (r.y1 >= F(all.y0[g])) & (r.near <= F(all.far[g]));
      if (apart) met = met & (r.end >= F(all.begin[g]));
      bits = select_ints<F>(met, bits | IntsOf<F>(static_cast<std::int32_t>(1U << g)), bits);
      some |= to_bits(met);
    }
    bits.store_unaligned(reinterpret_cast<std::int32_t*>(touched));
    return some & lanes;
  }
  alignas(sizeof(F)) float x0[width], x1[width], y0[width], y1[width], near[width], end[width];
  r.x0.store_aligned(x0);
  r.x1.store_aligned(x1);
  r.y0.store_aligned(y0);
  r.y1.store_aligned(y1);
  r.near.store_aligned(near);
  r.end.store_aligned(end);
  std::uint32_t some = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const int i = __builtin_ctz(lanes);
    touched[i] = touched_groups<apart>(all, x0[i], x1[i], y0[i], y1[i], near[i], end[i]) & groups;
    some |= touched[i] != 0 ? 1U << i : 0U;
  }
  return some;
}

template <class View, class F>
FASTRT_INLINE std::uint32_t touch_groups(const View& view, const Rectangles<F>& r, std::uint32_t lanes,
                                         std::uint32_t groups, std::uint32_t* touched) {
  return touch_groups<View::begins_apart>(view.groups, r, lanes, groups, touched);
}

// A node's children as the batch sees them; bits: those that some group touches, and which groups do.
struct TouchedChildren {
  alignas(32) float near[wide_children];
  std::uint32_t groups[wide_children];
  std::uint32_t bits;
};

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

template <class View>
FASTRT_INLINE void touch_children(const View& view, const WideNode& node, std::uint32_t groups,
                                  TouchedChildren& out) {
  using N = Floats<node_lanes>;
  const N padding(view.frame.padding);
  out.bits = 0;
  for (int half = 0; half < wide_children; half += node_lanes) {
    const float* const columns = node.lower_x + half;
    const Extent<N> w = box_extent(view.w, columns, padding);
    const Extent<N> u = box_extent(view.u, columns, padding);
    const Extent<N> v = box_extent(view.v, columns, padding);
    const Rectangles<N> r = project_extent(view.frame, u.low, u.high, v.low, v.high, w.low, w.high);
    const MaskOf<N> met = (r.x0 <= N(view.x1)) & (r.x1 >= N(view.x0)) & (r.y0 <= N(view.y1)) &
                          (r.y1 >= N(view.y0)) & (w.high >= N(view.frame.near)) & (w.low <= N(view.far));
    const std::uint32_t bits = boxes_ahead(view, columns, w.low, to_bits(met));
    r.near.store_aligned(out.near + half);
    if (bits != 0) out.bits |= touch_groups(view, r, bits, groups, out.groups + half) << half;
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
