// SPDX-License-Identifier: Apache-2.0
// The finer sieve between a triangle's rectangle and its test against 16 rays: its edges as lines of the
// plane, held against the corners of groups and then against the rays themselves, as points.
#pragma once

#include "src/kernels/tile_projection.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The edges of a run's triangles as lines a*x + b*y + c >= 0 of the plane, positive inside, with a margin in
// c. Rays for which no line gives less than `certain` are inside by the triangle's own test as well.
struct EdgeLines {
  alignas(64) float a[3][widest], b[3][widest], c[3][widest], certain[widest];
};

// Where rounding is no longer a share of what is computed, nothing is certain.
inline constexpr float least_certain = 0x1p-100F;

FASTRT_INLINE void store_certain(EdgeLines& lines, const PacketF& margin) {
  cull_mul_add(margin, PacketF(4.0F), PacketF(least_certain)).store_aligned(lines.certain);
}

FASTRT_INLINE void store_line(EdgeLines& lines, int e, const PacketF& a, const PacketF& b, const PacketF& c) {
  a.store_aligned(lines.a[e]);
  b.store_aligned(lines.b[e]);
  c.store_aligned(lines.c[e]);
}

// What an edge's line can be wrong by, and the tolerance of the triangle's test: a share of the triangle's
// size times its distance. (Of the products that make the normals, not of the normals: those of an edge that
// is seen end-on are small, their errors are not.)
inline constexpr float line_margin = 0x1p-17F;

FASTRT_INLINE PacketF largest_side(const TriangleReach<PacketF>& reach) {
  return largest(reach.high - reach.low);
}

// Rays of one origin: an edge's plane through the origin is a line of the plane. low, high: the box of the
// triangle relative to the origin.
FASTRT_INLINE void lines_from_setup(const TileFrame& f, const TriangleSetup<PacketF>& s,
                                    const TriangleReach<PacketF>& reach, EdgeLines& lines) {
  const V3<PacketF> u = broadcast3<PacketF>(f.u), v = broadcast3<PacketF>(f.v), w = broadcast3<PacketF>(f.w);
  const V3<PacketF>* const edges[3] = {&s.edge_a, &s.edge_b, &s.edge_c};
  const PacketF margin =
      (largest_side(reach) * max(largest(reach.low), largest(reach.high))) * PacketF(line_margin);
  store_certain(lines, margin);
  for (int e = 0; e < 3; ++e)
    store_line(lines, e, cull_dot(*edges[e], u), cull_dot(*edges[e], v), cull_dot(*edges[e], w) + margin);
}

// Parallel rays: the edges between the projected corners.
FASTRT_INLINE void lines_from_corners(const TileFrame& f, const ProjectedCorners& t,
                                      const TriangleReach<PacketF>& reach, EdgeLines& lines) {
  const PacketF x[4] = {t.ax, t.bx, t.cx, t.ax}, y[4] = {t.ay, t.by, t.cy, t.ay};
  const PacketF area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  const PacketF sign = sign_bit(area);
  const PacketF margin = largest_side(reach) * PacketF(4.0F * f.padding);
  store_certain(lines, margin);
  for (int e = 0; e < 3; ++e) {
    const PacketF a = flip(y[e] - y[e + 1], sign), b = flip(x[e + 1] - x[e], sign);
    store_line(lines, e, a, b, margin - (a * x[e] + b * y[e]));
  }
}

// Of the groups in `bits`, those whose rectangle reaches inside all three edges of triangle i.
FASTRT_INLINE std::uint32_t groups_inside_edges(const TileGroups& groups, const EdgeLines& lines, int i,
                                                std::uint32_t bits) {
  for (int e = 0; e < 3; ++e) {
    const PacketF a(lines.a[e][i]), b(lines.b[e][i]), c(lines.c[e][i]);
    // The corner of each rectangle that lies farthest inside.
    const float* const x = lines.a[e][i] > 0.0F ? groups.x1 : groups.x0;
    const float* const y = lines.b[e][i] > 0.0F ? groups.y1 : groups.y0;
    std::uint32_t inside = 0;
    for (int g = 0; g < batch_groups; g += widest) {
      const PacketF at =
          cull_mul_add(a, PacketF::load_aligned(x + g), cull_mul_add(b, PacketF::load_aligned(y + g), c));
      inside |= to_bits(at >= PacketF(0.0F)) << g;
    }
    bits &= inside;
  }
  return bits;
}

// The triangles whose three edges group g's rectangle reaches inside of.
FASTRT_INLINE PacketM triangles_around(const EdgeLines& lines, const TileGroups& groups, int g) {
  const PacketF zero(0.0F), x0(groups.x0[g]), x1(groups.x1[g]), y0(groups.y0[g]), y1(groups.y1[g]);
  const auto inside = [&](int e) {
    const PacketF a = PacketF::load_aligned(lines.a[e]), b = PacketF::load_aligned(lines.b[e]);
    return cull_mul_add(a, select(a > zero, x1, x0),
                        cull_mul_add(b, select(b > zero, y1, y0), PacketF::load_aligned(lines.c[e]))) >= zero;
  };
  return inside(0) & inside(1) & inside(2);
}

// The rays of group g inside all three edges of triangle i.
FASTRT_INLINE std::uint32_t rays_inside_edges(const TilePoints& points, const EdgeLines& lines, int i,
                                              int g) {
  const PacketF zero(0.0F);
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) {
    const PacketF x = in_register(PacketF::load_aligned(points.x + g * group_size + k)),
                  y = in_register(PacketF::load_aligned(points.y + g * group_size + k));
    const auto inside = [&](int e) {
      return cull_mul_add(PacketF(lines.a[e][i]), x,
                          cull_mul_add(PacketF(lines.b[e][i]), y, PacketF(lines.c[e][i]))) >= zero;
    };
    bits |= to_bits(inside(0) & inside(1) & inside(2)) << k;
  }
  return bits;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
