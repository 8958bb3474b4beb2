// SPDX-License-Identifier: Apache-2.0
// Makes the projection of a batch and the rectangles of its groups.
#pragma once

#include "src/kernels/tile_frame.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Which rays of a batch take part: bit l of word g is ray 16 g + l.
struct LiveRays {
  std::uint32_t bits[batch_groups];
  int first, last; // a live ray and another one far from it; -1: none
  bool backwards;  // some ray begins before its origin
};

FASTRT_INLINE LiveRays find_live_rays(const RayBatch& rays) {
  LiveRays live{};
  live.first = live.last = -1;
  live.backwards = false;
  const PacketF zero(0.0F), most(__builtin_inff());
  for (int i = 0; i < rays.count; i += widest) {
    const V3<PacketF> origin = load3<PacketF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    const V3<PacketF> dir = load3<PacketF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    const PacketF finite = ((abs(origin.x) + abs(origin.y)) + abs(origin.z)) * zero;
    const PacketF size = (abs(dir.x) + abs(dir.y)) + abs(dir.z);
    const PacketM alive = (finite == zero) & (size > zero) & (size < most) &
                          (load<PacketF>(rays.t_min + i) < load<PacketF>(rays.t_max + i));
    const int left = rays.count - i;
    const std::uint32_t bits = to_bits(alive) & (left >= widest ? ~0U : (1U << left) - 1U);
    live.bits[i / group_size] |= bits << (i % group_size);
    if (bits == 0) continue;
    if (live.first < 0) live.first = i + __builtin_ctz(bits);
    live.last = i + 31 - __builtin_clz(bits);
    live.backwards = live.backwards || (to_bits(load<PacketF>(rays.t_min + i) < zero) & bits) != 0;
  }
  return live;
}

// The middle of the live rays' directions.
FASTRT_INLINE V3<float> middle_direction(const RayBatch& rays, const LiveRays& live) {
  V3<float> sum{0.0F, 0.0F, 0.0F};
  for (int g = 0; g < batch_groups; ++g) {
    if (live.bits[g] == 0) continue;
    const V3<float> a = ray_dir(rays, g * group_size + __builtin_ctz(live.bits[g]));
    const V3<float> b = ray_dir(rays, g * group_size + 31 - __builtin_clz(live.bits[g]));
    sum = {sum.x + (a.x + b.x), sum.y + (a.y + b.y), sum.z + (a.z + b.z)};
  }
  return unit(sum);
}

FASTRT_INLINE V3<float> minus(const V3<float>& a, const V3<float>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

FASTRT_INLINE TileFrame make_tile_frame(const RayBatch& rays, const LiveRays& live) {
  TileFrame f{};
  f.perspective = rays.shape == BatchShape::common_origin;
  f.w = f.perspective ? middle_direction(rays, live) : unit(ray_dir(rays, live.first));
  // Along the tile's first row where that exists: then a tile of camera rays has rectangles without waste.
  const int row_end = 3 * group_size + 5;
  const int from = (live.bits[0] & 1U) != 0 ? 0 : live.first;
  const int to = (live.bits[3] & 32U) != 0 ? row_end : live.last;
  const V3<float> row = f.perspective ? minus(ray_dir(rays, to), ray_dir(rays, from))
                                      : minus(ray_origin(rays, to), ray_origin(rays, from));
  f.u = direction_across(f.w, row);
  f.v = {f.w.y * f.u.z - f.w.z * f.u.y, f.w.z * f.u.x - f.w.x * f.u.z, f.w.x * f.u.y - f.w.y * f.u.x};
  f.origin = f.perspective ? ray_origin(rays, live.first) : V3<float>{0.0F, 0.0F, 0.0F};
  return f;
}

FASTRT_INLINE float larger(float a, float b) { return a > b ? a : b; }
FASTRT_INLINE float magnitude(float a) { return __builtin_fabsf(a); }

// The frame's margin and near end, once the rays' places are known.
FASTRT_INLINE void bound_frame(const GeometryView& scene, float least_offset, const TileGroups& groups,
                               TileFrame& f) {
  float size = larger(magnitude(f.origin.x), larger(magnitude(f.origin.y), magnitude(f.origin.z)));
  if (!f.perspective) {
    size = larger(size, larger(magnitude(least_of(groups.x0)), magnitude(most_of(groups.x1))));
    size = larger(size, larger(magnitude(least_of(groups.y0)), magnitude(most_of(groups.y1))));
    size = larger(size, larger(magnitude(least_offset), magnitude(most_of(groups.depth_offset))));
  }
  f.padding = 2.0F * box_padding * larger(size, scene.largest_coordinate);
  f.near = least_offset - f.padding;
}

// The rays as points of the plane, negated where the largest is sought; rays that take no part count as
// +infinity.
struct alignas(64) TilePoints {
  float x[batch_size], y[batch_size], minus_x[batch_size], minus_y[batch_size];
  float minus_scale[batch_size], minus_offset[batch_size], offset[batch_size];
};

// Points of rays i ..; returns the lanes that look forward well enough to be projected.
FASTRT_INLINE PacketM project_rays(const TileFrame& f, const RayBatch& rays, std::uint32_t live, int i,
                                   TilePoints& points) {
  const PacketF nothing(__builtin_inff());
  const V3<PacketF> u = broadcast3<PacketF>(f.u), v = broadcast3<PacketF>(f.v), w = broadcast3<PacketF>(f.w);
  const V3<PacketF> dir = load3<PacketF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  const PacketF scale = cull_dot(dir, w);
  PacketF x, y, offset(0.0F);
  if (f.perspective) {
    const PacketF inverse = PacketF(1.0F) / scale;
    x = cull_dot(dir, u) * inverse;
    y = cull_dot(dir, v) * inverse;
  } else {
    const V3<PacketF> origin = load3<PacketF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    x = cull_dot(origin, u);
    y = cull_dot(origin, v);
    offset = cull_dot(origin, w);
  }
  const PacketM mask = from_bits<widest>(live);
  select(mask, x, nothing).store_aligned(points.x + i);
  select(mask, y, nothing).store_aligned(points.y + i);
  select(mask, negate(x), nothing).store_aligned(points.minus_x + i);
  select(mask, negate(y), nothing).store_aligned(points.minus_y + i);
  select(mask, negate(scale), nothing).store_aligned(points.minus_scale + i);
  select(mask, negate(offset), nothing).store_aligned(points.minus_offset + i);
  select(mask, offset, nothing).store_aligned(points.offset + i);
  return (scale * scale > PacketF(0.25F) * dot(dir, dir)) & (scale > PacketF(0.0F));
}

// Whether the groups' rectangles lie side by side, more or less. Scattered rays share few nodes: traced as
// one, each would be shown what all the others need.
FASTRT_INLINE bool groups_are_compact(const TileGroups& groups) {
  float sum = 0.0F;
  for (int g = 0; g < batch_groups; ++g)
    if (groups.x0[g] <= groups.x1[g]) sum += (groups.x1[g] - groups.x0[g]) * (groups.y1[g] - groups.y0[g]);
  const float width = most_of(groups.x1) - least_of(groups.x0);
  const float height = most_of(groups.y1) - least_of(groups.y0);
  return sum <= 1.2F * width * height;
}

// What became of rays that were to be projected: too wide, they can't be seen from one plane; scattered, they
// lie in it without order.
enum class Projection { done, too_wide, scattered };

FASTRT_INLINE Projection project_batch(const GeometryView& scene, const RayBatch& rays, const LiveRays& live,
                                       TileFrame& f, TilePoints& points, TileGroups& groups) {
  for (int i = 0; i < batch_size; i += widest) {
    const std::uint32_t bits =
        (live.bits[i / group_size] >> (i % group_size)) & ((1U << (widest - 1)) * 2U - 1U);
    if ((to_bits(project_rays(f, rays, bits, i, points)) & bits) != bits) return Projection::too_wide;
  }
  min_of_groups(points.x, groups.x0);
  min_of_groups(points.y, groups.y0);
  max_of_groups(points.minus_x, groups.x1);
  max_of_groups(points.minus_y, groups.y1);
  if (!groups_are_compact(groups)) return Projection::scattered;
  max_of_groups(points.minus_scale, groups.depth_scale);
  max_of_groups(points.minus_offset, groups.depth_offset);
  alignas(64) float least_offset[batch_groups];
  min_of_groups(points.offset, least_offset);
  bound_frame(scene, least_of(least_offset), groups, f);
  return Projection::done;
}

// The farthest depth at which a hit of group g still matters.
FASTRT_INLINE float group_far(const HitBatch& hits, const TileGroups& groups, std::uint32_t live, int g) {
  const int first = g * group_size;
  PacketF most(0.0F);
  for (int k = 0; k < group_size; k += widest) {
    const PacketM mask = from_bits<widest>((live >> k) & ((1U << (widest - 1)) * 2U - 1U));
    most = max(most, select(mask, PacketF::load_aligned(hits.t + first + k), PacketF(0.0F)));
  }
  const float begin = groups.depth_offset[g], way = reduce_max(most) * groups.depth_scale[g];
  return (begin + way) + (magnitude(begin) + way) * depth_slack;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
