// SPDX-License-Identifier: Apache-2.0
// Which triangles of a run lie around which rays of a beam, as seen along the rays: one ray at a time, or two
// where a register holds sixteen lanes.
#pragma once

#include "src/kernels/beam_culling.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Triangles of a run in the frame: corners, and what their edges let through.
template <class F>
struct FrameTriangles {
  F u[3], v[3], w[3], margin;
};

// Coordinates of a run's corners along an axis, where `sign` is set negated and less `offset`; returns how
// far they lie apart.
FASTRT_INLINE LeafF place_corners(const BlockRun<TriangleBlock>& run, int axis, const LeafF& sign,
                                  const LeafF& offset, LeafF (&corner)[3]) {
  constexpr int column = 3 * block_size;
  for (int v = 0; v < 3; ++v) {
    const int at = axis * column + v * block_size;
    corner[v] = flip(load_two<LeafF>(run.low->x[0] + at, run.high->x[0] + at), sign) - offset;
  }
  return max(corner[0], max(corner[1], corner[2])) - min(corner[0], min(corner[1], corner[2]));
}

FASTRT_INLINE FrameTriangles<LeafF> place_triangles(const Beam& beam, const BlockRun<TriangleBlock>& run) {
  FrameTriangles<LeafF> f;
  const LeafF zero(0.0F), sign(beam.backwards ? -0.0F : 0.0F);
  const LeafF wide = place_corners(run, beam.x, zero, zero, f.u),
              high = place_corners(run, beam.y, zero, zero, f.v),
              deep = place_corners(run, beam.z, sign, LeafF(beam.depth), f.w);
  f.margin = (max(wide, max(high, deep)) + LeafF(2.0F * beam.padding)) * LeafF(4.0F * beam.padding);
  return f;
}

// Rays, one in each lane.
struct LaneRays {
  PacketF x, y, slope_x, slope_y;
};

// The lanes whose triangle lies around the ray: seen along it, its corners turn one way.
FASTRT_INLINE std::uint32_t lies_around(const LaneRays& r, const FrameTriangles<PacketF>& f) {
  PacketF x[3], y[3];
  for (int c = 0; c < 3; ++c) {
    x[c] = cull_less(r.slope_x, f.w[c], f.u[c] - r.x);
    y[c] = cull_less(r.slope_y, f.w[c], f.v[c] - r.y);
  }
  const PacketF p = cull_mul_sub(x[1], y[2], y[1] * x[2]), q = cull_mul_sub(x[2], y[0], y[2] * x[0]),
                s = cull_mul_sub(x[0], y[1], y[0] * x[1]);
  return to_bits((min(p, min(q, s)) >= negate(f.margin)) | (max(p, max(q, s)) <= f.margin));
}

// Rays that are held against all triangles of a run at a time, each in as many lanes as there are triangles.
inline constexpr int rays_at_once = widest / leaf_lanes;

// What there is of each triangle, for each of these rays.
FASTRT_INLINE PacketF for_rays(const LeafF& triangles) {
#if defined(__AVX512DQ__)
  return PacketF(_mm512_broadcast_f32x8(triangles.data));
#else
  return triangles;
#endif
}

FASTRT_INLINE FrameTriangles<PacketF> for_rays(const FrameTriangles<LeafF>& f) {
  FrameTriangles<PacketF> out;
  for (int c = 0; c < 3; ++c) {
    out.u[c] = for_rays(f.u[c]);
    out.v[c] = for_rays(f.v[c]);
    out.w[c] = for_rays(f.w[c]);
  }
  out.margin = for_rays(f.margin);
  return out;
}

// What a column holds for ray i, and for ray j where there are two.
FASTRT_INLINE PacketF of_rays(const float* column, int i, [[maybe_unused]] int j) {
#if defined(__AVX512DQ__)
  return PacketF(_mm512_mask_broadcastss_ps(_mm512_set1_ps(column[i]), 0xFF00, _mm_load_ss(column + j)));
#else
  return PacketF(column[i]);
#endif
}
FASTRT_INLINE PacketI of_rays(const std::int32_t* column, int i, int j) {
  return as_ints(of_rays(reinterpret_cast<const float*>(column), i, j));
}

// The triangles that lie around rays i and j, as bits of lanes.
FASTRT_INLINE std::uint32_t triangles_around(const BeamRays& rays, const FrameTriangles<PacketF>& f, int i,
                                             int j) {
  return lies_around({of_rays(rays.x, i, j), of_rays(rays.y, i, j), of_rays(rays.slope_x, i, j),
                      of_rays(rays.slope_y, i, j)},
                     f);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
