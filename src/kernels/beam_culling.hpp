// SPDX-License-Identifier: Apache-2.0
// What of a beam can reach boxes and triangles: groups against eight boxes at once, rays against one box, and
// rays against a triangle as seen along them.
#pragma once

#include "src/kernels/beam_setup.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Boxes (or triangles), one per lane, by their extents across the beam and in depth.
template <class F>
struct Extents {
  Extent<F> u, v, w;
};

// Lower and upper planes of a node's boxes along an axis, padded.
template <class F>
FASTRT_INLINE Extent<F> axis_extent(const float* columns, int axis, const F& padding) {
  const float* const lower = columns + 2 * axis * wide_children;
  return {load<F>(lower) - padding, load<F>(lower + wide_children) + padding};
}

template <class F>
FASTRT_INLINE Extent<F> in_depth(const Beam& beam, const Extent<F>& along) {
  const F depth(beam.depth);
  if (beam.backwards) return {negate(along.high) - depth, negate(along.low) - depth};
  return {along.low - depth, along.high - depth};
}

FASTRT_INLINE Extent<LeafF> padded(const Extent<LeafF>& e, const LeafF& padding) {
  return {e.low - padding, e.high + padding};
}

// Whether a group can touch the boxes, and whether the boxes are small beside it: bits, a lane each.
struct TouchedLanes {
  std::uint32_t touched, small;
};

template <class F>
FASTRT_INLINE TouchedLanes touch_beam(const BeamGroup& g, const Extents<F>& e) {
  const F zero(0.0F);
  const F begin = max(e.w.low, zero), end = e.w.high;
  const auto low = [&](float x, float slope) {
    return cull_mul_add(F(slope), slope < 0.0F ? end : begin, F(x));
  };
  const auto high = [&](float x, float slope) {
    return cull_mul_add(F(slope), slope < 0.0F ? begin : end, F(x));
  };
  const F x0 = low(g.x0, g.slope_x0), x1 = high(g.x1, g.slope_x1), y0 = low(g.y0, g.slope_y0),
          y1 = high(g.y1, g.slope_y1);
  const MaskOf<F> met = (x0 <= e.u.high) & (x1 >= e.u.low) & (y0 <= e.v.high) & (y1 >= e.v.low) &
                        (end >= zero) & (e.w.low <= F(g.far));
  const MaskOf<F> small = ((x1 - x0) * (y1 - y0)) > F(2.0F) * ((e.u.high - e.u.low) * (e.v.high - e.v.low));
  const std::uint32_t touched = to_bits(met);
  return {touched, to_bits(small) & touched};
}

// One box's extents, for looking at single rays.
struct LoneExtents {
  float u0, u1, v0, v1, w0, w1;
};

// The rays of group g that can touch a box.
FASTRT_INLINE std::uint32_t touch_rays(const BeamRays& rays, const LoneExtents& e, int g) {
  const PacketF begin(e.w0 > 0.0F ? e.w0 : 0.0F), end(e.w1);
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) {
    const int i = g * group_size + k;
    const PacketF x = PacketF::load_aligned(rays.x + i), y = PacketF::load_aligned(rays.y + i);
    const PacketF sx = PacketF::load_aligned(rays.slope_x + i), sy = PacketF::load_aligned(rays.slope_y + i);
    const PacketF xb = cull_mul_add(sx, begin, x), xe = cull_mul_add(sx, end, x);
    const PacketF yb = cull_mul_add(sy, begin, y), ye = cull_mul_add(sy, end, y);
    const PacketM met = (min(xb, xe) <= PacketF(e.u1)) & (max(xb, xe) >= PacketF(e.u0)) &
                        (min(yb, ye) <= PacketF(e.v1)) & (max(yb, ye) >= PacketF(e.v0));
    bits |= to_bits(met) << k;
  }
  return bits;
}

// Children of a node that some ray may reach, and which rays.
struct BeamChildren {
  alignas(32) float extent[6][wide_children]; // u low, u high, v low ..
  std::uint64_t rays[wide_children];
  std::uint32_t bits;
};

FASTRT_INLINE LoneExtents extents_of(const float (&e)[6][wide_children], int i) {
  return {e[0][i], e[1][i], e[2][i], e[3][i], e[4][i], e[5][i]};
}

template <class F>
FASTRT_INLINE void store_extents(const Extents<F>& e, float (&out)[6][wide_children], int at) {
  e.u.low.store_aligned(out[0] + at);
  e.u.high.store_aligned(out[1] + at);
  e.v.low.store_aligned(out[2] + at);
  e.v.high.store_aligned(out[3] + at);
  e.w.low.store_aligned(out[4] + at);
  e.w.high.store_aligned(out[5] + at);
}

FASTRT_INLINE void touch_children(const Beam& beam, const WideNode& node, std::uint64_t rays,
                                  BeamChildren& out) {
  using N = Floats<node_lanes>;
  const N padding(beam.padding);
  std::uint32_t touched[beam_groups] = {}, small[beam_groups] = {};
  out.bits = 0;
  for (int half = 0; half < wide_children; half += node_lanes) {
    const float* const columns = node.lower_x + half;
    const Extents<N> e{axis_extent(columns, beam.x, padding), axis_extent(columns, beam.y, padding),
                       in_depth(beam, axis_extent(columns, beam.z, padding))};
    store_extents(e, out.extent, half);
    for (int g = 0; g < beam_groups; ++g) {
      if (rays_of_group(rays, g) == 0) continue;
      const TouchedLanes lanes = touch_beam(beam.groups[g], e);
      touched[g] |= lanes.touched << half;
      small[g] |= lanes.small << half;
      out.bits |= lanes.touched << half;
    }
  }
  for (std::uint32_t bits = out.bits; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctz(bits);
    std::uint64_t reached = 0;
    for (int g = 0; g < beam_groups; ++g) {
      if ((touched[g] >> i & 1U) == 0) continue;
      const std::uint32_t candidates = ((small[g] >> i & 1U) != 0 || is_leaf(node.child[i]))
                                           ? touch_rays(beam.rays, extents_of(out.extent, i), g)
                                           : 0xFFFFU;
      reached |= static_cast<std::uint64_t>(candidates) << (g * group_size);
    }
    out.rays[i] = reached & rays;
    if (out.rays[i] == 0) out.bits &= ~(1U << i);
  }
}

// Triangles of a run in the frame, as columns.
struct FrameTriangles {
  alignas(32) float u[3][leaf_lanes], v[3][leaf_lanes], w[3][leaf_lanes], margin[leaf_lanes];
};

// Coordinates of a run's corners along an axis, where `sign` is set negated and less `offset`; and their
// extent.
FASTRT_INLINE Extent<LeafF> place_corners(const BlockRun<TriangleBlock>& run, int axis, const LeafF& sign,
                                          const LeafF& offset, float (&out)[3][leaf_lanes]) {
  constexpr int column = 3 * block_size;
  LeafF corner[3];
  for (int v = 0; v < 3; ++v) {
    const int at = axis * column + v * block_size;
    corner[v] = flip(load_two<LeafF>(run.low->x[0] + at, run.high->x[0] + at), sign) - offset;
    corner[v].store_aligned(out[v]);
  }
  return {min(corner[0], min(corner[1], corner[2])), max(corner[0], max(corner[1], corner[2]))};
}

// The rays of group g that triangle i lies around: seen along each ray, its corners turn one way.
FASTRT_INLINE std::uint32_t rays_inside(const BeamRays& rays, const FrameTriangles& f, int i, int g) {
  std::uint32_t bits = 0;
  const PacketF margin(f.margin[i]);
  for (int k = 0; k < group_size; k += widest) {
    const int r = g * group_size + k;
    const PacketF rx = PacketF::load_aligned(rays.x + r), ry = PacketF::load_aligned(rays.y + r);
    const PacketF sx = PacketF::load_aligned(rays.slope_x + r), sy = PacketF::load_aligned(rays.slope_y + r);
    PacketF x[3], y[3];
    for (int c = 0; c < 3; ++c) {
      const PacketF w(f.w[c][i]);
      x[c] = cull_less(sx, w, PacketF(f.u[c][i]) - rx);
      y[c] = cull_less(sy, w, PacketF(f.v[c][i]) - ry);
    }
    const PacketF p = cull_mul_sub(x[1], y[2], y[1] * x[2]), q = cull_mul_sub(x[2], y[0], y[2] * x[0]),
                  s = cull_mul_sub(x[0], y[1], y[0] * x[1]);
    bits |= to_bits((min(p, min(q, s)) >= negate(margin)) | (max(p, max(q, s)) <= margin)) << k;
  }
  return bits;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
