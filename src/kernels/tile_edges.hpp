// SPDX-License-Identifier: Apache-2.0
// Finer sieves between a triangle's rectangle and its test against 16 rays: a triangle that covers many
// groups by its rectangle is held against their corners by its edges; one that covers few is held against
// their rays as points.
#pragma once

#include "src/kernels/tile_culling.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The edges of a run's triangles as lines a*x + b*y + c >= -margin of the plane, positive inside.
struct EdgeLines {
  alignas(32) float a[3][leaf_lanes], b[3][leaf_lanes], c[3][leaf_lanes], margin[leaf_lanes];
};

FASTRT_INLINE LeafF store_line(EdgeLines& lines, int e, const LeafF& a, const LeafF& b, const LeafF& c) {
  a.store_aligned(lines.a[e]);
  b.store_aligned(lines.b[e]);
  c.store_aligned(lines.c[e]);
  return abs(a) + abs(b);
}

// Rays of one origin: an edge's plane through the origin is a line of the plane. The margin covers the
// rounding of the normals, and the tolerance of the test itself.
FASTRT_INLINE void lines_from_setup(const TileFrame& f, const TriangleSetup<LeafF>& s, EdgeLines& lines) {
  const V3<LeafF> u = broadcast3<LeafF>(f.u), v = broadcast3<LeafF>(f.v), w = broadcast3<LeafF>(f.w);
  const V3<LeafF>* const edges[3] = {&s.edge_a, &s.edge_b, &s.edge_c};
  LeafF size(0.0F);
  for (int e = 0; e < 3; ++e) {
    const LeafF c = dot(*edges[e], w);
    size = size + (store_line(lines, e, dot(*edges[e], u), dot(*edges[e], v), c) + abs(c));
  }
  (size * LeafF(0x1p-18F)).store_aligned(lines.margin);
}

// Parallel rays: the edges between the projected corners.
FASTRT_INLINE void lines_from_corners(const TileFrame& f, const ProjectedTriangles& t, EdgeLines& lines) {
  const LeafF x[4] = {t.ax, t.bx, t.cx, t.ax}, y[4] = {t.ay, t.by, t.cy, t.ay};
  const LeafF area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
  const LeafF sign = sign_bit(area);
  LeafF size(0.0F);
  for (int e = 0; e < 3; ++e) {
    const LeafF a = flip(y[e] - y[e + 1], sign), b = flip(x[e + 1] - x[e], sign);
    size = size + store_line(lines, e, a, b, negate(a * x[e] + b * y[e]));
  }
  (size * LeafF(2.0F * f.padding)).store_aligned(lines.margin);
}

// Of the groups in `groups`, those whose rectangle reaches inside all three edges of triangle i.
FASTRT_INLINE std::uint32_t groups_inside_edges(const TileGroups& groups, const EdgeLines& lines, int i,
                                                std::uint32_t bits) {
  for (int e = 0; e < 3; ++e) {
    const PacketF a(lines.a[e][i]), b(lines.b[e][i]), c(lines.c[e][i] + lines.margin[i]);
    // The corner of each rectangle that lies farthest inside.
    const float* const x = lines.a[e][i] > 0.0F ? groups.x1 : groups.x0;
    const float* const y = lines.b[e][i] > 0.0F ? groups.y1 : groups.y0;
    std::uint32_t inside = 0;
    for (int g = 0; g < batch_groups; g += widest)
      inside |=
          to_bits((a * PacketF::load_aligned(x + g) + b * PacketF::load_aligned(y + g)) + c >= PacketF(0.0F))
          << g;
    bits &= inside;
  }
  return bits;
}

// Of the groups in `bits`, those with a ray in the rectangle.
FASTRT_INLINE std::uint32_t groups_with_rays(const TilePoints& points, float x0, float x1, float y0, float y1,
                                             std::uint32_t bits) {
  std::uint32_t kept = 0;
  for (std::uint32_t left = bits; left != 0; left &= left - 1) {
    const int g = __builtin_ctz(left);
    std::uint32_t rays = 0;
    for (int i = g * group_size; i < (g + 1) * group_size; i += widest) {
      const PacketF x = PacketF::load_aligned(points.x + i), y = PacketF::load_aligned(points.y + i);
      rays |= to_bits((x >= PacketF(x0)) & (x <= PacketF(x1)) & (y >= PacketF(y0)) & (y <= PacketF(y1)));
    }
    if (rays != 0) kept |= 1U << g;
  }
  return kept;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
