// SPDX-License-Identifier: Apache-2.0
// Boxes as a pencil sees them, and triangles as its rays do.
#pragma once

#include "src/kernels/pencil_setup.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The part of the plane that a box covers between the pencil's ends, given its extent along u, v, w. (Where a
// box begins before the rays do, its part there does not matter.)
template <class F>
FASTRT_INLINE Rectangles<F> project_extent(const PencilFrame& f, const F& u0, const F& u1, const F& v0,
                                           const F& v1, const F& w0, const F& w1) {
  const F one(1.0F), begin = max(w0, F(f.near)), spread_u(f.spread_u), spread_v(f.spread_v);
  const F wide0 = one / cull_mul_add(spread_u, begin, one), wide1 = one / cull_mul_add(spread_u, w1, one);
  const F high0 = one / cull_mul_add(spread_v, begin, one), high1 = one / cull_mul_add(spread_v, w1, one);
  return {min(u0 * wide0, u0 * wide1),
          max(u1 * wide0, u1 * wide1),
          min(v0 * high0, v0 * high1),
          max(v1 * high0, v1 * high1),
          w0,
          w1};
}

// The rectangles of a run's spheres. (Axes that lean are longer than 1, and spheres reach farther along
// them.)
FASTRT_INLINE Rectangles<LeafF> project_spheres(const PencilFrame& f, const BlockRun<SphereBlock>& run) {
  const V3<LeafF> center = load_centers(run) - broadcast3<LeafF>(f.origin);
  const LeafF radius = load_two<LeafF>(run.low->radius, run.high->radius), padding(f.padding);
  const LeafF u = cull_dot(center, broadcast3<LeafF>(f.u)), v = cull_dot(center, broadcast3<LeafF>(f.v)),
              w = cull_dot(center, broadcast3<LeafF>(f.w));
  const LeafF ru = cull_mul_add(radius, LeafF(f.length_u), padding),
              rv = cull_mul_add(radius, LeafF(f.length_v), padding), rw = radius + padding;
  return project_extent(f, u - ru, u + ru, v - rv, v + rv, w - rw, w + rw);
}

// A pencil's boxes begin where its rays do, at the earliest, so their rectangles say it all.
FASTRT_INLINE std::uint32_t boxes_ahead(const PencilView& /*view*/, const float* /*columns*/,
                                        const Floats<node_lanes>& /*low*/, std::uint32_t bits) {
  return bits;
}

// The edges of triangles as the pencil sees them: a * x + b * y + c (and d * x * y, which goes to the
// margin), positive inside.
struct PencilEdge {
  PacketF a, b, c, d;
  PacketF normal_u, normal_v; // of the plane through the edge and the origin
};

// From corner p to corner q: which way the pencil's ray at (x, y) turns around the edge. The ray passes
// through (x, y, 0) along (spread_u * x, spread_v * y, 1).
FASTRT_INLINE PencilEdge edge_between(const PencilFrame& f, const V3<PacketF>& p, const V3<PacketF>& q) {
  // Not p x q: its rounding would follow the square of the distance instead of the edge's length.
  const V3<PacketF> e = q - p;
  const PacketF nx = cull_mul_sub(p.y, e.z, p.z * e.y), ny = cull_mul_sub(p.z, e.x, p.x * e.z),
                nz = cull_mul_sub(p.x, e.y, p.y * e.x);
  return {cull_mul_sub(PacketF(f.spread_u), nx, e.y),
          cull_mul_add(PacketF(f.spread_v), ny, e.x),
          nz,
          PacketF(f.spread_v - f.spread_u) * e.z,
          nx,
          ny};
}

// What an edge's line can be wrong by, and the tolerance of the triangle's test: a share of the triangle's
// size times its distance.
inline constexpr float pencil_line_margin = 0x1p-16F;

// The edges of a run's triangles. Those that some ray may see edge-on are `unsure`: they turn either way, and
// their margin lies apart.
struct PencilEdges {
  EdgeLines lines;
  alignas(64) float margin[widest];
  std::uint32_t unsure;
  // Of the planes: a ray that begins at o has a triangle ahead where normal . o <= offset.
  alignas(64) float normal_u[widest], normal_v[widest], normal_w[widest], offset[widest];
};

// Corners relative to the frame's origin. A ray that hits a triangle passes its box at a point P, and the
// pencil's ray through P differs from it by its slope alone; so its edges may be missed by what the slopes'
// difference makes of the triangle, and by what the test lets through.
FASTRT_INLINE void lines_in_pencil(const PencilView& view, const V3<PacketF>& a, const V3<PacketF>& b,
                                   const V3<PacketF>& c, const PacketF& side, PencilEdges& out) {
  const PencilFrame& f = view.frame;
  const auto seen = [&](const V3<PacketF>& p) {
    return V3<PacketF>{cull_dot(p, broadcast3<PacketF>(f.u)), cull_dot(p, broadcast3<PacketF>(f.v)),
                       cull_dot(p, broadcast3<PacketF>(f.w))};
  };
  const V3<PacketF> p = seen(a), q = seen(b), r = seen(c);
  const PencilEdge edges[3] = {edge_between(f, p, q), edge_between(f, q, r), edge_between(f, r, p)};
  const PacketF most_x(view.most_x), most_y(view.most_y), most_xy(view.most_x * view.most_y);
  const PacketF away = max(largest(p), max(largest(q), largest(r))) + PacketF(f.largest_begin);
  const PacketF lets = side * (away * PacketF(pencil_line_margin)), slope(f.stray_slope);
  const PacketF normal_u = (edges[0].normal_u + edges[1].normal_u) + edges[2].normal_u,
                normal_v = (edges[0].normal_v + edges[1].normal_v) + edges[2].normal_v;
  const PacketF normal = max(abs(normal_u), abs(normal_v));
  const PacketF turns_off = slope * normal, turn = (edges[0].c + edges[1].c) + edges[2].c;
  const PacketF turns_by = cull_mul_add(abs((edges[0].a + edges[1].a) + edges[2].a), most_x,
                                        cull_mul_add(abs((edges[0].b + edges[1].b) + edges[2].b), most_y,
                                                     cull_mul_add(PacketF(16.0F), lets, turns_off)));
  const MaskOf<PacketF> sure = abs(turn) > turns_by;
  out.unsure = ~to_bits(sure);
  const PacketF zero(0.0F), sign = select(sure, sign_bit(turn), zero), square = side * side;
  const PacketF margin = cull_mul_add(PacketF(2.0F), turns_off, cull_mul_add(slope, square, lets));
  const PacketF offset = cull_mul_add(normal_u, p.x, cull_mul_add(normal_v, p.y, turn * p.z));
  flip(normal_u, sign).store_aligned(out.normal_u);
  flip(normal_v, sign).store_aligned(out.normal_v);
  flip(turn, sign).store_aligned(out.normal_w);
  select(sure, cull_mul_add(lets, away, flip(offset, sign)), PacketF(__builtin_inff()))
      .store_aligned(out.offset);
  PacketF most = zero;
  for (int e = 0; e < 3; ++e) {
    const PencilEdge& line = edges[e];
    const PacketF strays = cull_mul_add(abs(line.a), PacketF(f.stray_x),
                                        cull_mul_add(abs(line.b), PacketF(f.stray_y), abs(line.d) * most_xy));
    most = max(most, strays);
    store_line(out.lines, e, flip(line.a, sign), flip(line.b, sign),
               flip(line.c, sign) + select(sure, strays + margin, zero));
  }
  (most + cull_mul_add(slope * square, PacketF(5.0F), lets)).store_aligned(out.margin);
}

// The rays of group g that have triangle i ahead of them; all, if it is unsure.
FASTRT_INLINE std::uint32_t rays_towards(const PencilPoints& points, const PencilEdges& edges, int i, int g) {
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) {
    const int r = g * group_size + k;
    const PacketF at =
        cull_mul_add(PacketF(edges.normal_u[i]), PacketF::load_aligned(points.begin_x + r),
                     cull_mul_add(PacketF(edges.normal_v[i]), PacketF::load_aligned(points.begin_y + r),
                                  PacketF(edges.normal_w[i]) * PacketF::load_aligned(points.begin + r)));
    bits |= to_bits(at <= PacketF(edges.offset[i])) << k;
  }
  return bits;
}

// Of the groups in `bits`, those whose rectangle reaches inside all edges of triangle i; all, if it is
// unsure.
FASTRT_INLINE std::uint32_t groups_inside_edges(const TileGroups& groups, const PencilEdges& edges, int i,
                                                std::uint32_t bits) {
  if ((edges.unsure >> i & 1U) != 0) return bits;
  return groups_inside_edges(groups, edges.lines, i, bits);
}

// The triangles that reach inside group g's rectangle by their edges; and all that are unsure.
FASTRT_INLINE PacketM triangles_around(const PencilEdges& edges, const TileGroups& groups, int g) {
  return triangles_around(edges.lines, groups, g) | from_bits<widest>(edges.unsure & register_bits);
}

// The rays of group g that triangle i may lie around. As seen along each of them, the corners of an unsure
// one turn one way.
FASTRT_INLINE std::uint32_t rays_inside_edges(const TilePoints& points, const PencilEdges& edges, int i,
                                              int g) {
  if ((edges.unsure >> i & 1U) == 0) return rays_inside_edges(points, edges.lines, i, g);
  const PacketF margin(edges.margin[i]);
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) {
    const PacketF x = PacketF::load_aligned(points.x + g * group_size + k),
                  y = PacketF::load_aligned(points.y + g * group_size + k);
    const auto at = [&](int e) {
      return cull_mul_add(PacketF(edges.lines.a[e][i]), x,
                          cull_mul_add(PacketF(edges.lines.b[e][i]), y, PacketF(edges.lines.c[e][i])));
    };
    const PacketF p = at(0), q = at(1), r = at(2);
    bits |= to_bits((min(p, min(q, r)) >= negate(margin)) | (max(p, max(q, r)) <= margin)) << k;
  }
  return bits;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
