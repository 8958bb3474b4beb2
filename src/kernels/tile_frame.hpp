// SPDX-License-Identifier: Apache-2.0
// A batch of rays with one origin (or one direction), seen along its middle: rays become points (x, y) of a
// plane, and boxes and triangles become rectangles there. Groups of 16 rays get a rectangle each, so that one
// comparison tells which groups a box can touch. All of it only culls, with margins for rounding; the
// primitives' own tests decide.
//
// Frusta around packets: Reshetov, Soupikov & Hurley 2005; large packets over wide trees: Fuetterling et al.,
// JCGT 4(4), 2015. Here the frustum is a rectangle in the batch's own projection instead of planes in space.
#pragma once

#include "src/kernels/packet_traversal.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Margin of the rectangles, as a share of their size and of 1.
inline constexpr float rectangle_margin = 0x1p-20F;

// Directions u, v, w of space as the batch sees it: w away from the viewer, u and v across.
struct TileFrame {
  V3<float> u, v, w;
  V3<float> origin; // of all rays; 0 for parallel rays
  float padding;    // boxes are met as if larger by this
  float near;       // what lies before this depth matters to no ray
  bool perspective; // rays from one origin; else parallel ones
};

// Per group: rectangle and the depths between which it looks; an empty rectangle where there is nothing left
// to do.
struct alignas(64) TileGroups {
  float x0[batch_groups], x1[batch_groups], y0[batch_groups], y1[batch_groups];
  float far[batch_groups];
  float begin[batch_groups];        // of views whose begins_apart is true
  float depth_scale[batch_groups];  // largest d.w of the group: t * depth_scale bounds a depth
  float depth_offset[batch_groups]; // largest origin.w of the group, for parallel rays
};

FASTRT_INLINE float dot(const V3<float>& a, const V3<float>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

FASTRT_INLINE V3<float> unit(const V3<float>& a) {
  const float inverse = 1.0F / __builtin_sqrtf(dot(a, a));
  return {a.x * inverse, a.y * inverse, a.z * inverse};
}

template <class F>
FASTRT_INLINE V3<F> broadcast3(const V3<float>& v) {
  return {F(v.x), F(v.y), F(v.z)};
}

// For culling alone.
template <class F>
FASTRT_INLINE F cull_dot(const V3<F>& a, const V3<F>& b) {
  return cull_mul_add(a.z, b.z, cull_mul_add(a.y, b.y, a.x * b.x));
}

FASTRT_INLINE bool has_one_origin(BatchShape shape) {
  return shape == BatchShape::common_origin || shape == BatchShape::scattered_origin;
}
FASTRT_INLINE bool is_parallel(BatchShape shape) {
  return shape == BatchShape::parallel || shape == BatchShape::scattered_parallel;
}

FASTRT_INLINE V3<float> ray_dir(const RayBatch& rays, int i) {
  return {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]};
}
FASTRT_INLINE V3<float> ray_origin(const RayBatch& rays, int i) {
  return {rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]};
}

// What is left of a without its part along the unit vector w.
FASTRT_INLINE V3<float> part_across(const V3<float>& a, const V3<float>& w) {
  const float along = dot(a, w);
  return {a.x - along * w.x, a.y - along * w.y, a.z - along * w.z};
}

// A direction across w, along `hint` if that says anything. Twice over where the hint runs along w: the first
// time leaves an error then that far rays would see.
FASTRT_INLINE V3<float> direction_across(const V3<float>& w, const V3<float>& hint) {
  const V3<float> across = part_across(hint, w);
  const float length2 = dot(across, across), hint2 = dot(hint, hint);
  if (length2 > 0.25F * hint2 && length2 > 1e-30F) return unit(across);
  if (length2 > 1e-6F * hint2 && length2 > 1e-30F) return unit(part_across(unit(across), w));
  const float ax = __builtin_fabsf(w.x), ay = __builtin_fabsf(w.y), az = __builtin_fabsf(w.z);
  if (ax <= ay && ax <= az) return unit({0.0F, w.z, -w.y});
  if (ay <= az) return unit({-w.z, 0.0F, w.x});
  return unit({w.y, -w.x, 0.0F});
}

// Lanes of a and b in turn, of the first or of the second two lanes of each four; and pairs of lanes
// likewise.
template <class F>
FASTRT_INLINE F interleave_low(const F& a, const F& b) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) return F(_mm512_unpacklo_ps(a.data, b.data));
#endif
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8) return F(_mm256_unpacklo_ps(a.data, b.data));
#endif
  if constexpr (width_of<F> == 4) return F(_mm_unpacklo_ps(a.data, b.data));
}
template <class F>
FASTRT_INLINE F interleave_high(const F& a, const F& b) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) return F(_mm512_unpackhi_ps(a.data, b.data));
#endif
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8) return F(_mm256_unpackhi_ps(a.data, b.data));
#endif
  if constexpr (width_of<F> == 4) return F(_mm_unpackhi_ps(a.data, b.data));
}
template <class F>
FASTRT_INLINE F low_pairs(const F& a, const F& b) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) return F(_mm512_shuffle_ps(a.data, b.data, 0x44));
#endif
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8) return F(_mm256_shuffle_ps(a.data, b.data, 0x44));
#endif
  if constexpr (width_of<F> == 4) return F(_mm_shuffle_ps(a.data, b.data, 0x44));
}
template <class F>
FASTRT_INLINE F high_pairs(const F& a, const F& b) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) return F(_mm512_shuffle_ps(a.data, b.data, 0xEE));
#endif
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8) return F(_mm256_shuffle_ps(a.data, b.data, 0xEE));
#endif
  if constexpr (width_of<F> == 4) return F(_mm_shuffle_ps(a.data, b.data, 0xEE));
}
template <class F>
FASTRT_INLINE Floats<4> fold_min(const F& a) {
  if constexpr (width_of<F> == 4) return a;
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8)
    return _mm_min_ps(_mm256_castps256_ps128(a.data), _mm256_extractf128_ps(a.data, 1));
#endif
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16)
    return fold_min(
        Floats<8>(_mm256_min_ps(_mm512_castps512_ps256(a.data), _mm512_extractf32x8_ps(a.data, 1))));
#endif
}
// The smallest lane of each of four registers.
template <class F>
FASTRT_INLINE Floats<4> min_of_rows(const F& a, const F& b, const F& c, const F& d) {
  const F ab = min(interleave_low(a, b), interleave_high(a, b));
  const F cd = min(interleave_low(c, d), interleave_high(c, d));
  return fold_min(F(min(low_pairs(ab, cd), high_pairs(ab, cd))));
}

// A group's lanes folded to one register.
FASTRT_INLINE PacketF least_lanes(const float* values) {
  PacketF least = PacketF::load_aligned(values);
  for (int k = widest; k < group_size; k += widest) least = min(least, PacketF::load_aligned(values + k));
  return least;
}
// out[g] = the least of values[16 g .. 16 g + 15].
FASTRT_INLINE void min_of_groups(const float* values, float* out) {
  for (int g = 0; g < batch_groups; g += 4)
    min_of_rows(least_lanes(values + g * group_size), least_lanes(values + (g + 1) * group_size),
                least_lanes(values + (g + 2) * group_size), least_lanes(values + (g + 3) * group_size))
        .store_aligned(out + g);
}
FASTRT_INLINE void max_of_groups(const float* negated_values, float* out) {
  min_of_groups(negated_values, out);
  for (int g = 0; g < batch_groups; g += widest)
    negate(PacketF::load_aligned(out + g)).store_aligned(out + g);
}

FASTRT_INLINE PacketF least_lanes_of(const float* groups) {
  PacketF least = PacketF::load_aligned(groups);
  for (int g = widest; g < batch_groups; g += widest) least = min(least, PacketF::load_aligned(groups + g));
  return least;
}
FASTRT_INLINE PacketF most_lanes_of(const float* groups) {
  PacketF most = PacketF::load_aligned(groups);
  for (int g = widest; g < batch_groups; g += widest) most = max(most, PacketF::load_aligned(groups + g));
  return most;
}
FASTRT_INLINE float least_of(const float* groups) { return reduce_min(least_lanes_of(groups)); }
FASTRT_INLINE float most_of(const float* groups) { return reduce_max(most_lanes_of(groups)); }

// Around all groups' rectangles.
struct GroupBounds {
  float x0, x1, y0, y1;
};

FASTRT_INLINE GroupBounds bounds_of(const TileGroups& groups) {
  alignas(16) float ends[4];
  min_of_rows(least_lanes_of(groups.x0), negate(most_lanes_of(groups.x1)), least_lanes_of(groups.y0),
              negate(most_lanes_of(groups.y1)))
      .store_aligned(ends);
  return {ends[0], -ends[1], ends[2], -ends[3]};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
