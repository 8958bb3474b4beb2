// SPDX-License-Identifier: Apache-2.0
// Makes the projection of a batch and the rectangles of its groups.
#pragma once

#include "src/kernels/tile_frame.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Lengths beyond this, or below its inverse, are no business of tiles, pencils and beams: products of three
// must neither overflow nor vanish.
inline constexpr float length_limit = 1e12F;
FASTRT_INLINE bool is_usual_length(float length) {
  return length < length_limit && length > 1.0F / length_limit;
}

// Which rays of a batch take part: bit l of word g is ray 16 g + l.
struct LiveRays {
  std::uint32_t bits[batch_groups];
  int first, last; // a live ray and another one far from it; -1: none
  bool backwards;  // some ray begins before its origin
  bool extreme;    // some ray begins too far out, or has a direction of no usual length
};

FASTRT_INLINE LiveRays find_live_rays(const RayBatch& rays) {
  LiveRays live{};
  live.first = live.last = -1;
  live.backwards = live.extreme = false;
  // Sums of three parts, of which the largest is to be usual.
  const PacketF zero(0.0F), most(length_limit), least(4.0F / length_limit);
  const bool one_origin = has_one_origin(rays.shape);
  for (int i = 0; i < rays.count; i += widest) {
    const V3<PacketF> dir = load3<PacketF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    const PacketF length = sum_of_sizes(dir);
    PacketM alive = have_direction(dir) & (load<PacketF>(rays.t_min + i) < load<PacketF>(rays.t_max + i));
    PacketM usual = (length < most) & (length > least);
    if (!one_origin) {
      const V3<PacketF> origin = load3<PacketF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
      alive = alive & are_finite(origin);
      usual = usual & (sum_of_sizes(origin) < most);
    }
    const std::uint32_t bits = to_bits(alive) & lanes_in(rays.count - i);
    live.bits[i / group_size] |= bits << (i % group_size);
    if (bits == 0) continue;
    if (live.first < 0) live.first = i + __builtin_ctz(bits);
    live.last = i + 31 - __builtin_clz(bits);
    live.backwards = live.backwards || (to_bits(load<PacketF>(rays.t_min + i) < zero) & bits) != 0;
    live.extreme = live.extreme || (bits & ~to_bits(usual)) != 0;
  }
  if (one_origin && live.first >= 0) {
    const V3<float> origin = ray_origin(rays, live.first);
    const float size = __builtin_fabsf(origin.x) + __builtin_fabsf(origin.y) + __builtin_fabsf(origin.z);
    if (!(size < __builtin_inff())) return LiveRays{{}, -1, -1, false, false};
    live.extreme = live.extreme || !(size < length_limit);
  }
  return live;
}

FASTRT_INLINE PacketM live_lanes(const LiveRays& live, int i) {
  return from_bits<widest>(live.bits[i / group_size] >> (i % group_size) & register_bits);
}

// About the middle of the live rays' directions: that of rays at the ends of the batch and between.
FASTRT_INLINE V3<float> middle_direction(const RayBatch& rays, const LiveRays& live) {
  const V3<float> first = ray_dir(rays, live.first), last = ray_dir(rays, live.last);
  V3<float> sum{first.x + last.x, first.y + last.y, first.z + last.z};
  for (int g = batch_groups / 3; g < batch_groups - 1; g += batch_groups / 3) {
    if (live.bits[g] == 0) continue;
    const V3<float> between = ray_dir(rays, g * group_size + __builtin_ctz(live.bits[g]));
    sum = {sum.x + between.x, sum.y + between.y, sum.z + between.z};
  }
  return unit(sum);
}

FASTRT_INLINE V3<float> minus(const V3<float>& a, const V3<float>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

FASTRT_INLINE TileFrame make_tile_frame(const RayBatch& rays, const LiveRays& live) {
  TileFrame f{};
  f.perspective = has_one_origin(rays.shape);
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
FASTRT_INLINE void bound_frame(const GeometryView& scene, float least_offset, const GroupBounds& bounds,
                               float largest_offset, TileFrame& f) {
  float size = larger(magnitude(f.origin.x), larger(magnitude(f.origin.y), magnitude(f.origin.z)));
  if (!f.perspective) {
    size = larger(size, larger(magnitude(bounds.x0), magnitude(bounds.x1)));
    size = larger(size, larger(magnitude(bounds.y0), magnitude(bounds.y1)));
    size = larger(size, larger(magnitude(least_offset), magnitude(largest_offset)));
  }
  f.padding = 2.0F * box_padding * larger(size, scene.largest_coordinate);
  f.near = least_offset - f.padding;
}

// Where groups begin, given the least depths of their origins.
template <class Frame>
FASTRT_INLINE void set_begins(const Frame& f, const float* least, TileGroups& groups) {
  for (int g = 0; g < batch_groups; g += widest)
    (PacketF::load_aligned(least + g) - PacketF(f.padding)).store_aligned(groups.begin + g);
}

// The rays as points of the plane. Those of rays that take no part mean nothing.
struct alignas(64) TilePoints {
  float x[batch_size], y[batch_size];
};

// What bounds a group, by lanes: the ends of its rectangle, the upper ones negated, and the ends of d.w or,
// of parallel rays, of origin.w.
struct GroupLanes {
  PacketF x0, minus_x1, y0, minus_y1, depth, minus_depth;
};

// Projects the rays of a group; false if some don't look forward well enough.
FASTRT_INLINE bool project_group(const TileFrame& f, const RayBatch& rays, const LiveRays& live, int g,
                                 TilePoints& points, GroupLanes& out) {
  const PacketF nothing(__builtin_inff());
  const V3<PacketF> u = broadcast3<PacketF>(f.u), v = broadcast3<PacketF>(f.v), w = broadcast3<PacketF>(f.w);
  out = {nothing, nothing, nothing, nothing, nothing, nothing};
  std::uint32_t ahead = 0;
  for (int k = 0; k < group_size; k += widest) {
    const int i = g * group_size + k;
    const V3<PacketF> dir = load3<PacketF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    const PacketF scale = cull_dot(dir, w);
    PacketF x, y, depth = scale;
    if (f.perspective) {
      const PacketF inverse = PacketF(1.0F) / scale;
      x = cull_dot(dir, u) * inverse;
      y = cull_dot(dir, v) * inverse;
    } else {
      const V3<PacketF> origin = load3<PacketF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
      x = cull_dot(origin, u);
      y = cull_dot(origin, v);
      depth = cull_dot(origin, w);
    }
    x.store_aligned(points.x + i);
    y.store_aligned(points.y + i);
    const PacketM mask = live_lanes(live, i);
    const auto include = [&](PacketF& least, const PacketF& value) {
      least = min(least, select(mask, value, nothing));
    };
    include(out.x0, x);
    include(out.minus_x1, negate(x));
    include(out.y0, y);
    include(out.minus_y1, negate(y));
    if (!f.perspective) include(out.depth, depth);
    include(out.minus_depth, negate(depth));
    ahead |= to_bits((scale * scale > PacketF(0.25F) * dot(dir, dir)) & (scale > PacketF(0.0F))) << k;
  }
  return (live.bits[g] & ~ahead) == 0;
}

// The share of a batch's rectangle that a group of several samples of a pixel or four stays below.
inline constexpr float large_group = 0.2F;

// Whether the groups' rectangles lie side by side, more or less, or over each other but none of them is
// large. Scattered rays share few nodes: traced as one, each would be shown what all the others need.
FASTRT_INLINE bool groups_are_compact(const TileGroups& groups, const GroupBounds& bounds) {
  const PacketF zero(0.0F);
  PacketF sum = zero, most = zero;
  for (int g = 0; g < batch_groups; g += widest) {
    const PacketF x0 = PacketF::load_aligned(groups.x0 + g), x1 = PacketF::load_aligned(groups.x1 + g);
    const PacketF height = PacketF::load_aligned(groups.y1 + g) - PacketF::load_aligned(groups.y0 + g);
    const PacketF area = select(x0 <= x1, (x1 - x0) * height, zero);
    sum = sum + area;
    most = max(most, area);
  }
  const float whole = (bounds.x1 - bounds.x0) * (bounds.y1 - bounds.y0);
  return simd::hadd(sum) <= 1.2F * whole || reduce_max(most) <= large_group * whole;
}

// What became of rays that were to be projected: too wide, they can't be seen from one plane; scattered, they
// lie in it without order.
enum class Projection { done, too_wide, scattered };

FASTRT_INLINE Projection project_batch(const GeometryView& scene, const RayBatch& rays, const LiveRays& live,
                                       TileFrame& f, TilePoints& points, TileGroups& groups) {
  alignas(64) float depth[batch_groups], minus_depth[batch_groups];
  for (int g = 0; g < batch_groups; g += 4) {
    GroupLanes p[4];
    bool ahead = true;
    for (int k = 0; k < 4; ++k) ahead = project_group(f, rays, live, g + k, points, p[k]) && ahead;
    if (!ahead) return Projection::too_wide;
    const auto store = [&](PacketF GroupLanes::*part, float* to) {
      min_of_rows(p[0].*part, p[1].*part, p[2].*part, p[3].*part).store_aligned(to + g);
    };
    const auto store_negated = [&](PacketF GroupLanes::*part, float* to) {
      negate(min_of_rows(p[0].*part, p[1].*part, p[2].*part, p[3].*part)).store_aligned(to + g);
    };
    store(&GroupLanes::x0, groups.x0);
    store_negated(&GroupLanes::minus_x1, groups.x1);
    store(&GroupLanes::y0, groups.y0);
    store_negated(&GroupLanes::minus_y1, groups.y1);
    if (!f.perspective) store(&GroupLanes::depth, depth);
    store_negated(&GroupLanes::minus_depth, minus_depth);
  }
  const GroupBounds bounds = bounds_of(groups);
  if (!groups_are_compact(groups, bounds)) return Projection::scattered;
  const PacketF zero(0.0F), scale(f.perspective ? 0.0F : dot(ray_dir(rays, live.first), f.w));
  for (int g = 0; g < batch_groups; g += widest) {
    const PacketF most = PacketF::load_aligned(minus_depth + g);
    (f.perspective ? most : scale).store_aligned(groups.depth_scale + g);
    (f.perspective ? zero : most).store_aligned(groups.depth_offset + g);
  }
  bound_frame(scene, f.perspective ? 0.0F : least_of(depth), bounds, most_of(groups.depth_offset), f);
  if (!f.perspective) set_begins(f, depth, groups);
  return Projection::done;
}

// The depth, with slack, at which a way ends that begins at depth `begin`; size: |begin|.
template <class F>
FASTRT_INLINE F end_of_way(const F& begin, const F& size, const F& way) {
  return (begin + way) + (size + way) * F(depth_slack);
}

// The farthest depth at which a hit of group g still matters. open: its rays that look for one.
FASTRT_INLINE float group_far(const HitBatch& hits, const TileGroups& groups, std::uint32_t open, int g) {
  if (open == 0) return -__builtin_inff();
  PacketF most(0.0F);
  for (int k = 0; k < group_size; k += widest) {
    const PacketF t = PacketF::load_aligned(hits.t + g * group_size + k);
    most = max(most, select(from_bits<widest>(open >> k & register_bits), t, PacketF(0.0F)));
  }
  const float begin = groups.depth_offset[g], way = reduce_max(most) * groups.depth_scale[g];
  return end_of_way(begin, magnitude(begin), way);
}

// The same of all groups at once. open: a word for each.
FASTRT_INLINE void find_far(const HitBatch& hits, const std::uint32_t* open, TileGroups& groups) {
  const PacketF zero(0.0F), nowhere(-__builtin_inff());
  const auto minus_most = [&](int g) {
    PacketF least = zero;
    for (int k = 0; k < group_size; k += widest) {
      const PacketF t = PacketF::load_aligned(hits.t + g * group_size + k);
      least = min(least, select(from_bits<widest>(open[g] >> k & register_bits), negate(t), zero));
    }
    return least;
  };
  alignas(64) float most[batch_groups];
  std::uint32_t used = 0;
  for (int g = 0; g < batch_groups; g += 4) {
    negate(min_of_rows(minus_most(g), minus_most(g + 1), minus_most(g + 2), minus_most(g + 3)))
        .store_aligned(most + g);
    for (int k = g; k < g + 4; ++k) used |= static_cast<std::uint32_t>(open[k] != 0) << k;
  }
  for (int g = 0; g < batch_groups; g += widest) {
    const PacketF begin = PacketF::load_aligned(groups.depth_offset + g),
                  way = PacketF::load_aligned(most + g) * PacketF::load_aligned(groups.depth_scale + g);
    const PacketF far = end_of_way(begin, abs(begin), way);
    select(from_bits<widest>(used >> g & register_bits), far, nowhere).store_aligned(groups.far + g);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
