// SPDX-License-Identifier: Apache-2.0
// Rays that ask for any hit and need no triangle's own test: a triangle whose edges they pass well inside of
// is clearly in their way or clearly out of it (docs/numerics.md, "Certain answers").
#pragma once

#include "src/kernels/tile_hits.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// What the planes of a run's triangles make of a ray at (x, y) of the tile's plane: m = a*x + b*y + c. Of a
// ray from the common origin that is D by unit of depth, and T is `height`. Of parallel rays T is
// m + height * depth, turned by the sign of D. The one or the other is wrong by no more than `doubt`.
struct PlaneLines {
  alignas(64) float a[widest], b[widest], c[widest], height[widest], doubt[widest];
};

// What D by unit of depth can be wrong by, as a share of the normal's largest component.
inline constexpr float plane_doubt = 0x1p-14F;
// The same for T of parallel rays, in paddings.
inline constexpr float plane_paddings = 8.0F;

FASTRT_INLINE void planes_from_setup(const TileFrame& f, const TriangleSetup<PacketF>& s,
                                     PlaneLines& planes) {
  cull_dot(s.normal, broadcast3<PacketF>(f.u)).store_aligned(planes.a);
  cull_dot(s.normal, broadcast3<PacketF>(f.v)).store_aligned(planes.b);
  cull_dot(s.normal, broadcast3<PacketF>(f.w)).store_aligned(planes.c);
  s.offset.store_aligned(planes.height);
  cull_mul_add(largest(s.normal), PacketF(plane_doubt), PacketF(least_certain)).store_aligned(planes.doubt);
}

// a, b, c: vertices. length: of the rays' directions. Nothing is certain of planes that lie along these, or
// almost.
FASTRT_INLINE void planes_from_corners(const TileFrame& f, float length, const V3<PacketF>& a,
                                       const V3<PacketF>& b, const V3<PacketF>& c, PlaneLines& planes) {
  const V3<PacketF> normal = cross(b - a, c - a);
  const PacketF size = largest(normal), along = cull_dot(normal, broadcast3<PacketF>(f.w));
  const PacketF sign = sign_bit(along), everywhere(__builtin_inff());
  cull_dot(flip(normal, negate(sign)), broadcast3<PacketF>(f.u)).store_aligned(planes.a);
  cull_dot(flip(normal, negate(sign)), broadcast3<PacketF>(f.v)).store_aligned(planes.b);
  flip(dot(a, normal), sign).store_aligned(planes.c);
  negate(abs(along)).store_aligned(planes.height);
  const bool measured = f.padding > least_certain * length && f.padding < 0x1p60F * length;
  const float share = measured ? plane_paddings * f.padding : __builtin_inff();
  const PacketF doubt = cull_mul_add(size, PacketF(share), PacketF(least_certain));
  select(abs(along) > size * PacketF(plane_doubt), doubt, everywhere).store_aligned(planes.doubt);
}

// Rays that a triangle is certainly in the way of, and those that it certainly isn't.
struct CertainLanes {
  PacketM met, missed;
};

// Rays i .. of the batch and triangle k of a run, whose plane makes m of them.
FASTRT_INLINE CertainLanes certain_lanes(const TileView& view, const RayBatch& rays, int i,
                                         const PlaneLines& planes, int k, const PacketF& m) {
  const PacketF depth = cull_dot(load_dir(rays, i), broadcast3<PacketF>(view.frame.w));
  const PacketF t_max = PacketF::load_aligned(rays.t_max + i), largest_t(1.0F / least_certain);
  const PacketF height(planes.height[k]), doubt(planes.doubt[k]), least = m - doubt, most = m + doubt;
  const PacketM ahead = most * (depth * PacketF(least_certain)) < height;
  return {ahead & (least * (depth * min(t_max, largest_t)) > height), most * (depth * t_max) < height};
}
FASTRT_INLINE CertainLanes certain_lanes(const ParallelView& view, const RayBatch& rays, int i,
                                         const PlaneLines& planes, int k, const PacketF& m) {
  const PacketF depth = cull_dot(load_origin(rays, i), broadcast3<PacketF>(view.frame.w));
  const PacketF height = cull_mul_add(PacketF(planes.height[k]), depth, m), doubt(planes.doubt[k]);
  const PacketM endless = PacketF::load_aligned(rays.t_max + i) == PacketF(__builtin_inff());
  return {endless & (height > doubt), height < negate(doubt)};
}

// Keeps what is certain of the rays of group g in `rays` and triangle k of a run. Returns those that the
// triangle's own test must tell.
template <class View>
FASTRT_INLINE std::uint32_t keep_certain(TileTraversal<true, View>& tile, const TriangleRun& run,
                                         const EdgeLines& lines, const PlaneLines& planes, int k, int g,
                                         std::uint32_t rays) {
  std::uint32_t met = 0, missed = 0;
  for (int i = g * group_size; i < (g + 1) * group_size; i += widest) {
    const PacketF x = PacketF::load_aligned(tile.points.x + i), y = PacketF::load_aligned(tile.points.y + i);
    const auto at = [&](const float* a, const float* b, const float* c) {
      return cull_mul_add(PacketF(a[k]), x, cull_mul_add(PacketF(b[k]), y, PacketF(c[k])));
    };
    const auto edge = [&](int e) { return at(lines.a[e], lines.b[e], lines.c[e]); };
    const CertainLanes lanes =
        certain_lanes(tile.view, tile.rays, i, planes, k, at(planes.a, planes.b, planes.c));
    const PacketM inside = (min(edge(0), min(edge(1), edge(2))) >= PacketF(lines.certain[k])) &
                           (PacketF::load_aligned(tile.rays.t_min + i) == PacketF(0.0F));
    const std::uint32_t hit = to_bits(inside & lanes.met) & (rays >> (i % group_size) & register_bits);
    met |= hit << (i % group_size);
    missed |= to_bits(inside & lanes.missed) << (i % group_size);
    if (hit == 0) continue;
    std::int32_t* const primitive = tile.hits.primitive + i;
    select_ints<PacketF>(from_bits<widest>(hit), PacketI(run.primitive(k)), PacketI::load_aligned(primitive))
        .store_aligned(primitive);
  }
  if (met != 0) shorten_group(tile, g, met);
  return rays & ~(met | missed);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
