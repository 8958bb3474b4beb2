// SPDX-License-Identifier: Apache-2.0
// Up to 64 neighbouring rays with origins and directions of their own (mirrored or refracted ones), seen
// along the axis of space that they follow most: a ray is a point of the plane (x, y) that moves with depth,
// x = x0 + depth * slope, and a group of 16 lies between such lines. So a box of the tree is compared with
// groups and rays as it is. All of it only culls, with margins for rounding.
//
// Interval bounds of packets: Boulos, Wald & Shirley, "Geometric and Arithmetic Culling Methods for Entire
// Ray Packets", 2006.
#pragma once

#include "src/kernels/tile_traversal.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

inline constexpr int beam_groups = 4;
inline constexpr int beam_size = beam_groups * group_size;
// Origins so far away that the scene's size is lost in their rounding are no business of beams.
inline constexpr float far_origin = 64.0F; // scenes

// The rays as lines of the plane: where they are at depth 0 and how they move. Rays that take no part are
// NaN.
struct alignas(64) BeamRays {
  float x[beam_size], y[beam_size], slope_x[beam_size], slope_y[beam_size];
  float begin[beam_size], scale[beam_size]; // depth of the origin; depth per t
  float far[beam_size];                     // the depth beyond which nothing matters to a ray
};

// The lines between which each group's rays lie.
struct alignas(16) BeamGroups {
  float x0[beam_groups], x1[beam_groups], y0[beam_groups], y1[beam_groups];
  float slope_x0[beam_groups], slope_x1[beam_groups], slope_y0[beam_groups], slope_y1[beam_groups];
};
using GroupF = Floats<beam_groups>;

struct Beam {
  int x, y, z;        // axes of space: across, across, along
  bool backwards;     // depth grows against the axis
  float depth;        // depth 0 is here, where the first ray begins
  float padding;      // boxes are met as if larger by this
  std::uint64_t live; // bit i: ray i of the beam
  BeamRays rays;
  BeamGroups groups;
};

FASTRT_INLINE std::uint32_t rays_of_group(std::uint64_t rays, int g) {
  return static_cast<std::uint32_t>(rays >> (g * group_size)) & 0xFFFFU;
}

// All rays of the groups in `lanes`, and the groups that have any of `rays` (bits).
FASTRT_INLINE std::uint64_t rays_of_groups(const Mask<beam_groups>& lanes) {
  const __m128i words = select_ints<GroupF>(lanes, Ints<beam_groups>(-1), Ints<beam_groups>(0)).data;
  return static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_packs_epi32(words, words)));
}
FASTRT_INLINE std::uint32_t groups_with(std::uint64_t rays) {
  const __m128i none = _mm_cmpeq_epi16(_mm_cvtsi64_si128(static_cast<long long>(rays)), _mm_setzero_si128());
  return ~static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(none, none))) & 15U;
}

// The sum of the directions of rays first .., each by its size, and which rays take part. Nothing if some ray
// looks behind its origin: beams don't.
FASTRT_INLINE V3<float> sum_directions(const RayBatch& rays, int first, int count, std::uint64_t& live) {
  live = 0;
  V3<PacketF> sum{PacketF(0.0F), PacketF(0.0F), PacketF(0.0F)};
  const PacketF zero(0.0F);
  for (int k = 0; k < count; k += widest) {
    const int i = first + k;
    const V3<PacketF> origin = load3<PacketF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    const V3<PacketF> dir = load3<PacketF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    const PacketF begin = load<PacketF>(rays.t_min + i);
    const PacketM alive = are_traceable(origin, dir) & (begin < load<PacketF>(rays.t_max + i));
    const std::uint32_t bits = to_bits(alive) & lanes_in(count - k);
    if ((to_bits(begin < zero) & bits) != 0) return {0.0F, 0.0F, 0.0F};
    live |= static_cast<std::uint64_t>(bits) << k;
    const V3<PacketF> unit_dir = dir * (PacketF(1.0F) / sum_of_sizes(dir));
    const PacketM mask = from_bits<widest>(bits);
    sum = sum + select(mask, unit_dir, V3<PacketF>{zero, zero, zero});
  }
  return {simd::hadd(sum.x), simd::hadd(sum.y), simd::hadd(sum.z)};
}

struct RayColumns {
  const float* origin[3];
  const float* dir[3];
};

// Lines of rays k .., depth counted from the origin of space. Returns those of `bits` that do not look too
// far aside; the others take no part.
FASTRT_INLINE std::uint32_t place_rays(const RayColumns& rays, int first, int k, std::uint32_t bits,
                                       Beam& beam, PacketF& largest_origin) {
  const int i = first + k;
  BeamRays& out = beam.rays;
  const PacketF sign(beam.backwards ? -0.0F : 0.0F);
  const PacketF origin_x = load<PacketF>(rays.origin[beam.x] + i),
                origin_y = load<PacketF>(rays.origin[beam.y] + i),
                origin_z = flip(load<PacketF>(rays.origin[beam.z] + i), sign);
  const PacketF dir_x = load<PacketF>(rays.dir[beam.x] + i), dir_y = load<PacketF>(rays.dir[beam.y] + i);
  const PacketF scale = flip(load<PacketF>(rays.dir[beam.z] + i), sign), inverse = PacketF(1.0F) / scale;
  const PacketM forward = (PacketF(2.0F) * scale > max(abs(dir_x), abs(dir_y))) &
                          (scale > PacketF(1.0F / length_limit)) & (scale < PacketF(length_limit));
  bits &= to_bits(forward);
  const PacketM mask = from_bits<widest>(bits);
  const PacketF none(__builtin_nanf(""));
  select(mask, origin_x, none).store_aligned(out.x + k);
  select(mask, origin_y, none).store_aligned(out.y + k);
  select(mask, dir_x * inverse, none).store_aligned(out.slope_x + k);
  select(mask, dir_y * inverse, none).store_aligned(out.slope_y + k);
  select(mask, origin_z, none).store_aligned(out.begin + k);
  scale.store_aligned(out.scale + k);
  largest_origin =
      max(select(mask, largest(V3<PacketF>{origin_x, origin_y, origin_z}), PacketF(0.0F)), largest_origin);
  return bits;
}

// Least and most of a group's 16 values; NaN counts for nothing.
FASTRT_INLINE float least_of_group(const float* values) {
  PacketF least(__builtin_inff());
  for (int k = 0; k < group_size; k += widest) least = min(PacketF::load_aligned(values + k), least);
  return reduce_min(least);
}
FASTRT_INLINE float most_of_group(const float* values) {
  PacketF most(-__builtin_inff());
  for (int k = 0; k < group_size; k += widest) most = max(PacketF::load_aligned(values + k), most);
  return reduce_max(most);
}

// How far the rays of group g look that have hit what is in `hits`.
FASTRT_INLINE void find_far(Beam& beam, const HitBatch& hits, int first, int g) {
  for (int i = g * group_size; i < (g + 1) * group_size; i += widest) {
    const PacketF begin = PacketF::load_aligned(beam.rays.begin + i);
    const PacketF way = load<PacketF>(hits.t + first + i) * PacketF::load_aligned(beam.rays.scale + i);
    ((begin + way) + way * PacketF(depth_slack)).store_aligned(beam.rays.far + i);
  }
}

FASTRT_INLINE void bound_group(Beam& beam, int g) {
  const int i = g * group_size;
  BeamGroups& groups = beam.groups;
  groups.x0[g] = least_of_group(beam.rays.x + i) - beam.padding;
  groups.x1[g] = most_of_group(beam.rays.x + i) + beam.padding;
  groups.y0[g] = least_of_group(beam.rays.y + i) - beam.padding;
  groups.y1[g] = most_of_group(beam.rays.y + i) + beam.padding;
  groups.slope_x0[g] = least_of_group(beam.rays.slope_x + i);
  groups.slope_x1[g] = most_of_group(beam.rays.slope_x + i);
  groups.slope_y0[g] = least_of_group(beam.rays.slope_y + i);
  groups.slope_y1[g] = most_of_group(beam.rays.slope_y + i);
}

// A group that has no rays.
FASTRT_INLINE void leave_out_group(Beam& beam, int g) {
  BeamGroups& groups = beam.groups;
  groups.x0[g] = groups.y0[g] = groups.slope_x0[g] = groups.slope_y0[g] = __builtin_inff();
  groups.x1[g] = groups.y1[g] = groups.slope_x1[g] = groups.slope_y1[g] = -__builtin_inff();
  for (int i = g * group_size; i < (g + 1) * group_size; i += widest)
    PacketF(-__builtin_inff()).store_aligned(beam.rays.far + i);
}

// Moves depth 0 to where the first ray begins, and the lines with it.
FASTRT_INLINE void set_depth(Beam& beam, int count, float depth) {
  for (int k = 0; k < count; k += widest) {
    BeamRays& r = beam.rays;
    const PacketF begin = PacketF::load_aligned(r.begin + k) - PacketF(depth);
    begin.store_aligned(r.begin + k);
    (PacketF::load_aligned(r.x + k) - begin * PacketF::load_aligned(r.slope_x + k)).store_aligned(r.x + k);
    (PacketF::load_aligned(r.y + k) - begin * PacketF::load_aligned(r.slope_y + k)).store_aligned(r.y + k);
  }
}

// Where leaves hold triangles alone, rays that point aside are left to others: a beam is made of this many
// rays or more, and of this share of those that could be part of it.
inline constexpr int least_beam = 8;
inline constexpr float least_beam_share = 0.5F;
// And a group that looks at more triangles than about this / 4 pi is no beam: its rays would have little but
// the top of the tree in common. (Slopes' range, as an area, times the scene's triangles.)
inline constexpr float most_in_view = 1e5F;

// Rays that are not traced with a beam: those that others might take, and those that are best off alone.
struct BeamRest {
  std::uint64_t apart, alone;
};

FASTRT_INLINE bool takes_beam(const GeometryView& scene, std::uint64_t all, std::uint64_t live) {
  if (scene.only_triangles == 0) return live == all;
  const int count = __builtin_popcountll(live);
  return count >= least_beam &&
         static_cast<float>(count) >= least_beam_share * static_cast<float>(__builtin_popcountll(all));
}

FASTRT_INLINE bool sees_too_much(const GeometryView& scene, const Beam& beam) {
  const GroupF width =
                   GroupF::load_aligned(beam.groups.slope_x1) - GroupF::load_aligned(beam.groups.slope_x0),
               height =
                   GroupF::load_aligned(beam.groups.slope_y1) - GroupF::load_aligned(beam.groups.slope_y0);
  const Mask<beam_groups> used = width >= GroupF(0.0F);
  const float area = simd::hadd(select(used, width * height, GroupF(0.0F)));
  return area * static_cast<float>(scene.primitive_count) >
         most_in_view * static_cast<float>(__builtin_popcount(to_bits(used)));
}

// Prepares rays first .. first + count - 1 (count a multiple of the group's size; what lies beyond the batch
// takes no part). beam.live is 0, and all rays are left, where they are not worth a beam.
FASTRT_INLINE BeamRest make_beam(const GeometryView& scene, const RayBatch& rays, int first, int count,
                                 Beam& beam) {
  const V3<float> sum =
      sum_directions(rays, first, rays.count - first < count ? rays.count - first : count, beam.live);
  const std::uint64_t all = beam.live;
  beam.live = 0;
  if (!(dot(sum, sum) > 0.0F)) return {~std::uint64_t{0}, 0};
  const float along[3] = {magnitude(sum.x), magnitude(sum.y), magnitude(sum.z)};
  beam.z = along[1] > along[0] ? 1 : 0;
  if (along[2] > along[beam.z]) beam.z = 2;
  beam.x = beam.z == 2 ? 0 : beam.z + 1;
  beam.y = beam.z == 0 ? 2 : beam.z - 1;
  beam.backwards = (beam.z == 0 ? sum.x : beam.z == 1 ? sum.y : sum.z) < 0.0F;
  const RayColumns columns{{rays.origin_x, rays.origin_y, rays.origin_z},
                           {rays.dir_x, rays.dir_y, rays.dir_z}};
  PacketF largest_origin(0.0F);
  std::uint64_t live = 0;
  for (int k = 0; k < count; k += widest)
    live |= std::uint64_t{place_rays(columns, first, k, static_cast<std::uint32_t>(all >> k) & register_bits,
                                     beam, largest_origin)}
            << k;
  if (!takes_beam(scene, all, live)) return {all, 0};
  float depth = __builtin_inff();
  for (int g = 0; g < count / group_size; ++g) {
    const float least = least_of_group(beam.rays.begin + g * group_size);
    depth = least < depth ? least : depth;
  }
  const float size = reduce_max(largest_origin);
  if (!(size <= far_origin * scene.largest_coordinate && is_usual_length(scene.largest_coordinate)))
    return {all, 0};
  beam.padding = 4.0F * box_padding * (size > scene.largest_coordinate ? size : scene.largest_coordinate);
  set_depth(beam, count, depth);
  for (int g = 0; g < count / group_size; ++g) bound_group(beam, g);
  for (int g = count / group_size; g < beam_groups; ++g) leave_out_group(beam, g);
  if (scene.only_triangles != 0 && sees_too_much(scene, beam)) return {all & ~live, live};
  beam.depth = depth;
  beam.live = live;
  return {all & ~live, 0};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
