// SPDX-License-Identifier: Apache-2.0
// Boxes as rectangles of a batch's projection, and the groups of rays, and the rays, that these touch.
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

// One rectangle, for looking at single rays.
struct LoneRectangle {
  float x0, x1, y0, y1;
};

// Rectangles as columns.
template <class F>
struct StoredRectangles {
  alignas(sizeof(F)) float x0[width_of<F>], x1[width_of<F>], y0[width_of<F>], y1[width_of<F>],
      near[width_of<F>], end[width_of<F>];

  [[gnu::always_inline]] inline explicit StoredRectangles(const Rectangles<F>& r) {
    r.x0.store_aligned(x0);
    r.x1.store_aligned(x1);
    r.y0.store_aligned(y0);
    r.y1.store_aligned(y1);
    r.near.store_aligned(near);
    r.end.store_aligned(end);
  }
  [[gnu::always_inline]] inline LoneRectangle of(int lane) const {
    return {x0[lane], x1[lane], y0[lane], y1[lane]};
  }
};

// Groups that rectangle i touches and that look from before its end as far as where it begins.
template <bool apart, class F>
FASTRT_INLINE std::uint32_t touched_groups(const TileGroups& groups, const StoredRectangles<F>& r, int i) {
  const PacketF x0(r.x0[i]), x1(r.x1[i]), y0(r.y0[i]), y1(r.y1[i]), near(r.near[i]);
  std::uint32_t bits = 0;
  for (int g = 0; g < batch_groups; g += widest) {
    PacketM touched =
        (PacketF::load_aligned(groups.x0 + g) <= x1) & (PacketF::load_aligned(groups.x1 + g) >= x0) &
        (PacketF::load_aligned(groups.y0 + g) <= y1) & (PacketF::load_aligned(groups.y1 + g) >= y0) &
        (PacketF::load_aligned(groups.far + g) >= near);
    if (apart) touched = touched & (PacketF::load_aligned(groups.begin + g) <= PacketF(r.end[i]));
    bits |= to_bits(touched) << g;
  }
  return bits;
}

// The rectangles that touch group g, as far as it looks.
template <bool apart, class F>
FASTRT_INLINE MaskOf<F> touching_rectangles(const TileGroups& groups, const Rectangles<F>& r, int g) {
  const MaskOf<F> touching = (r.x0 <= F(groups.x1[g])) & (r.x1 >= F(groups.x0[g])) &
                             (r.y0 <= F(groups.y1[g])) & (r.y1 >= F(groups.y0[g])) &
                             (r.near <= F(groups.far[g]));
  if constexpr (apart) return touching & (r.end >= F(groups.begin[g]));
  return touching;
}

// About as many groups can be held against all rectangles at once in the time that `rectangle_cost /
// group_cost` rectangles take to be held against all groups.
inline constexpr int group_cost = 5, rectangle_cost = widest == batch_groups ? 7 : 10;

// The groups of `groups` that each rectangle touches, as touched_groups() finds them, for the lanes in
// `lanes`; 0 elsewhere. Returns the lanes that touch any.
template <bool apart, class F>
FASTRT_INLINE std::uint32_t touch_groups(const TileGroups& all, const Rectangles<F>& r, std::uint32_t lanes,
                                         std::uint32_t groups, std::uint32_t* touched) {
  if (__builtin_popcount(groups) * group_cost <= __builtin_popcount(lanes) * rectangle_cost) {
    IntsOf<F> bits(0);
    std::uint32_t some = 0;
    for (; groups != 0; groups &= groups - 1) {
      const int g = __builtin_ctz(groups);
      const MaskOf<F> met = touching_rectangles<apart>(all, r, g);
      bits = select_ints<F>(met, bits | IntsOf<F>(static_cast<std::int32_t>(1U << g)), bits);
      some |= to_bits(met);
    }
    bits.store_unaligned(reinterpret_cast<std::int32_t*>(touched));
    return some & lanes;
  }
  const StoredRectangles<F> stored(r);
  std::uint32_t some = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const int i = __builtin_ctz(lanes);
    touched[i] = touched_groups<apart>(all, stored, i) & groups;
    some |= touched[i] != 0 ? 1U << i : 0U;
  }
  return some;
}

template <class View, class F>
FASTRT_INLINE std::uint32_t touch_groups(const View& view, const Rectangles<F>& r, std::uint32_t lanes,
                                         std::uint32_t groups, std::uint32_t* touched) {
  return touch_groups<View::begins_apart>(view.groups, r, lanes, groups, touched);
}

// The rays of group g in the rectangle. Groups' rectangles lie around their rays as these points, so what
// holds for a group holds for each ray. (Pencils' rays stray from their points; groups' rectangles are larger
// by that.)
template <class View>
FASTRT_INLINE std::uint32_t rays_in_rectangle(const View& /*view*/, const TilePoints& points,
                                              const LoneRectangle& r, int g) {
  if (View::strays) return (1U << group_size) - 1U;
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) {
    const PacketF x = PacketF::load_aligned(points.x + g * group_size + k),
                  y = PacketF::load_aligned(points.y + g * group_size + k);
    bits |= to_bits((x >= PacketF(r.x0)) & (x <= PacketF(r.x1)) & (y >= PacketF(r.y0)) & (y <= PacketF(r.y1)))
            << k;
  }
  return bits;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
