// SPDX-License-Identifier: Apache-2.0
// The rays of a batch that a pencil fits, and the rectangles of their groups.
#pragma once

#include "src/kernels/pencil_fit.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The rays as points of the plane, and what else bounds their groups; negated where the largest is sought.
// Rays that take no part are infinite.
struct alignas(64) PencilPoints : TilePoints {
  float minus_x[batch_size], minus_y[batch_size];
  float begin_x[batch_size], begin_y[batch_size],
      begin[batch_size]; // of where the rays begin: u, v and depth
  float minus_begin[batch_size], minus_scale[batch_size];
};

struct PencilView {
  using Points = PencilPoints;
  static constexpr bool begins_apart = true, strays = true;
  PencilFrame frame;
  ExtentAxis u, v, w;
  TileGroups groups;
  float x0, x1, y0, y1, far; // around all groups
  float most_x, most_y;      // |x|, |y| of any ray
};

// How far rays stray from their places in the plane, and their slopes from those of the pencil there.
struct PencilErrors {
  PacketF x, y, slope;
  PacketF away; // of the rays' origins, see PencilRays
};

// Rays i .. of the batch as points of the plane; returns those of `live` (bits) that the pencil fits. A ray's
// place changes with depth one way only: it lies between where the ray begins and where it leaves the scene.
FASTRT_INLINE std::uint32_t place_rays(const PencilFrame& f, const RayBatch& rays, int i, std::uint32_t live,
                                       PencilPoints& points, PencilErrors& errors) {
  const PencilRays r = see_rays(f, rays, i);
  const V3<PacketF> dir = load_dir(rays, i);
  const PacketF one(1.0F), half(0.5F), zero(0.0F), nothing(__builtin_inff());
  const PacketF spread_u(f.spread_u), spread_v(f.spread_v), way = PacketF(f.end) - r.begin;
  const PacketF width = cull_mul_add(spread_u, r.begin, one), height = cull_mul_add(spread_v, r.begin, one);
  const PacketF x0 = r.begin_x / width,
                x1 = cull_mul_add(r.slope_x, way, r.begin_x) * PacketF(1.0F / (1.0F + f.spread_u * f.end)),
                y0 = r.begin_y / height,
                y1 = cull_mul_add(r.slope_y, way, r.begin_y) * PacketF(1.0F / (1.0F + f.spread_v * f.end));
  const PacketF x = (x0 + x1) * half, y = (y0 + y1) * half, stray_x = abs(x1 - x0) * half,
                stray_y = abs(y1 - y0) * half;
  const PacketM fits = (stray_x <= PacketF(f.stray_x)) & (stray_y <= PacketF(f.stray_y)) &
                       (min(width, height) > PacketF(least_width)) &
                       (r.scale * r.scale > PacketF(0.25F) * dot(dir, dir)) & (r.scale > zero);
  const std::uint32_t bits = to_bits(fits) & live;
  const PacketM mask = from_bits<widest>(bits);
  const PacketF slope = cull_mul_add(abs(spread_u), stray_x, abs(cull_less(spread_u, x, r.slope_x))) +
                        cull_mul_add(abs(spread_v), stray_y, abs(cull_less(spread_v, y, r.slope_y)));
  errors.x = max(select(mask, stray_x, zero), errors.x);
  errors.y = max(select(mask, stray_y, zero), errors.y);
  errors.away = max(select(mask, r.away, zero), errors.away);
  errors.slope = max(select(mask, slope, zero), errors.slope);
  select(mask, x, nothing).store_aligned(points.x + i);
  select(mask, y, nothing).store_aligned(points.y + i);
  select(mask, negate(x), nothing).store_aligned(points.minus_x + i);
  select(mask, negate(y), nothing).store_aligned(points.minus_y + i);
  r.begin_x.store_aligned(points.begin_x + i);
  r.begin_y.store_aligned(points.begin_y + i);
  select(mask, r.begin, nothing).store_aligned(points.begin + i);
  select(mask, negate(r.begin), nothing).store_aligned(points.minus_begin + i);
  select(mask, negate(r.scale), nothing).store_aligned(points.minus_scale + i);
  return bits;
}

// Rectangles, larger by what rays stray and by what rounding may have moved rays and boxes.
FASTRT_INLINE void widen_groups(const PencilFrame& f, float* low, float* high, float spread, float stray) {
  const PacketF share(0x1p-18F + 8.0F * f.padding * magnitude(spread)), margin(stray + f.padding);
  for (int g = 0; g < batch_groups; g += widest) {
    // What is infinite, of empty groups, stays so.
    const PacketF l = PacketF::load_aligned(low + g), h = PacketF::load_aligned(high + g), most(1e30F);
    (l - min(cull_mul_add(abs(l), share, margin), most)).store_aligned(low + g);
    (h + min(cull_mul_add(abs(h), share, margin), most)).store_aligned(high + g);
  }
}

FASTRT_INLINE void bound_groups(const PencilPoints& points, const PencilErrors& errors, PencilView& view) {
  TileGroups& groups = view.groups;
  PencilFrame& f = view.frame;
  f.stray_x = reduce_max(errors.x);
  f.stray_y = reduce_max(errors.y);
  f.largest_begin = reduce_max(errors.away);
  f.stray_slope = reduce_max(errors.slope);
  min_of_groups(points.x, groups.x0);
  max_of_groups(points.minus_x, groups.x1);
  min_of_groups(points.y, groups.y0);
  max_of_groups(points.minus_y, groups.y1);
  max_of_groups(points.minus_scale, groups.depth_scale);
  max_of_groups(points.minus_begin, groups.depth_offset);
  widen_groups(f, groups.x0, groups.x1, f.spread_u, f.stray_x);
  widen_groups(f, groups.y0, groups.y1, f.spread_v, f.stray_y);
  alignas(64) float begin[batch_groups];
  min_of_groups(points.begin, begin);
  f.near = least_of(begin) - f.padding;
  set_begins(f, begin, groups);
}

FASTRT_INLINE void aim_view(PencilView& view) {
  bound_view(view);
  view.most_x = larger(magnitude(view.x0), magnitude(view.x1));
  view.most_y = larger(magnitude(view.y0), magnitude(view.y1));
  view.u = extent_axis(view.frame, view.frame.u);
  view.v = extent_axis(view.frame, view.frame.v);
  view.w = extent_axis(view.frame, view.frame.w);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
