// SPDX-License-Identifier: Apache-2.0
// Ray against triangle, by edge normals through the ray's origin (docs/numerics.md, "Triangle"). The lanes
// may be rays, triangles or both: whatever is the same in all lanes comes broadcast.
#pragma once

#include "src/kernels/vec3.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// How far outside an edge still counts, as a share of the edge's normal and of the direction.
inline constexpr float edge_slack = 0x1p-22F;

// What depends on the origin alone, turned so that `offset` is not negative.
template <class F>
struct TriangleSetup {
  V3<F> edge_a, edge_b, edge_c; // normals of the planes through the origin and an edge
  V3<F> normal;
  F offset; // T: the normal's component of the vector to the triangle
};

// a, b, c: vertices relative to the ray's origin.
template <class F>
FASTRT_INLINE TriangleSetup<F> set_up_triangle(const V3<F>& a, const V3<F>& b, const V3<F>& c) {
  TriangleSetup<F> s{cross(b - c, b + c), cross(c - a, c + a), cross(a - b, a + b), cross(b - a, c - a),
                     F(0.0F)};
  s.offset = dot(a, s.normal);
  const F sign = sign_bit(s.offset);
  s.edge_a = flip(s.edge_a, sign);
  s.edge_b = flip(s.edge_b, sign);
  s.edge_c = flip(s.edge_c, sign);
  s.normal = flip(s.normal, sign);
  s.offset = flip(s.offset, sign);
  return s;
}

// The triangle's own box relative to the ray's origin, with a margin for the rounding of the coordinates.
template <class F>
struct TriangleReach {
  V3<F> low, high;
};

inline constexpr float reach_margin = 0x1p-21F;

// largest_origin: the largest |coordinate| of the ray's origin.
template <class F>
FASTRT_INLINE TriangleReach<F> reach_of(const V3<F>& a, const V3<F>& b, const V3<F>& c,
                                        const F& largest_origin) {
  const V3<F> low{min(a.x, min(b.x, c.x)), min(a.y, min(b.y, c.y)), min(a.z, min(b.z, c.z))};
  const V3<F> high{max(a.x, max(b.x, c.x)), max(a.y, max(b.y, c.y)), max(a.z, max(b.z, c.z))};
  const F share(reach_margin);
  const F margin = max(largest(low), largest(high)) * share + largest_origin * share;
  const V3<F> m{margin, margin, margin};
  return {low - m, high + m};
}

template <class F>
struct TriangleLanes {
  MaskOf<F> inside;
  F t; // meaningful where `inside`
};

// t of a ray almost in the triangle's plane is a quotient of rounding errors and may lie anywhere: it is
// moved back into the reach, and what the ray itself does not reach is a miss. So every hit lies in the box
// that a tree knows of.
template <class F>
FASTRT_INLINE TriangleLanes<F> move_into_reach(const TriangleLanes<F>& lanes, const TriangleReach<F>& r,
                                               const V3<F>& dir) {
  const F zero(0.0F), one(1.0F);
  const F ix = one / dir.x, iy = one / dir.y, iz = one / dir.z;
  const MaskOf<F> bx = ix < zero, by = iy < zero, bz = iz < zero;
  const F near = max(select(bx, r.high.x, r.low.x) * ix,
                     max(select(by, r.high.y, r.low.y) * iy, max(select(bz, r.high.z, r.low.z) * iz, zero)));
  const F far = min(
      select(bx, r.low.x, r.high.x) * ix,
      min(select(by, r.low.y, r.high.y) * iy, min(select(bz, r.low.z, r.high.z) * iz, F(__builtin_inff()))));
  F t = select(lanes.t < near, near, lanes.t);
  t = select(t > far, far, t);
  return {lanes.inside & (near <= far) & (abs(lanes.t) < F(__builtin_inff())), t};
}

// The lanes in `inside` at t, held to the reach that `reach()` gives: it is made only where some lane needs
// it.
template <class F, class Reach>
FASTRT_INLINE TriangleLanes<F> held_to_reach(const TriangleLanes<F>& lanes, const V3<F>& dir,
                                             const Reach& reach) {
  const TriangleReach<F> r = reach();
  const V3<F> q = dir * lanes.t;
  const MaskOf<F> reached = (q.x >= r.low.x) & (q.x <= r.high.x) & (q.y >= r.low.y) & (q.y <= r.high.y) &
                            (q.z >= r.low.z) & (q.z <= r.high.z);
  if ((to_bits(lanes.inside) & ~to_bits(reached)) == 0) return lanes;
  const TriangleLanes<F> moved = move_into_reach(lanes, r, dir);
  return {lanes.inside & (reached | moved.inside), select(reached, lanes.t, moved.t)};
}

// How far along an edge's normal the direction goes: where inside the edge, 0 or more. Turned by the sign of
// T.
template <class F>
struct EdgeSides {
  F u, v, w;
};

// Inside all three edges. What an edge lets through beyond itself is computed only if one of the lanes in
// `asked` (bits) lies beyond one.
template <class F>
FASTRT_INLINE MaskOf<F> inside_edges(const EdgeSides<F>& at, const V3<F>& edge_a, const V3<F>& edge_b,
                                     const V3<F>& edge_c, const V3<F>& dir, std::uint32_t asked) {
  const F zero(0.0F);
  const MaskOf<F> inside = (at.u >= zero) & (at.v >= zero) & (at.w >= zero);
  if ((asked & ~to_bits(inside)) == 0) return inside;
  const F share(edge_slack), size = largest(dir);
  return (at.u >= negate((share * largest(edge_a)) * size)) &
         (at.v >= negate((share * largest(edge_b)) * size)) &
         (at.w >= negate((share * largest(edge_c)) * size));
}

// Where the line through the origin along `dir` passes inside the triangle, and at which t. The caller checks
// the range of t; NaN fails every comparison. The division waits until some lane needs it. Lanes that are not
// asked may come out as misses.
template <class F, class Reach>
FASTRT_INLINE TriangleLanes<F> intersect_triangle(const TriangleSetup<F>& s, const V3<F>& dir,
                                                  std::uint32_t asked, const Reach& reach) {
  const EdgeSides<F> at{dot(dir, s.edge_a), dot(dir, s.edge_b), dot(dir, s.edge_c)};
  const MaskOf<F> inside = inside_edges(at, s.edge_a, s.edge_b, s.edge_c, dir, asked);
  if ((asked & to_bits(inside)) == 0) return {inside, F(0.0F)};
  return held_to_reach(TriangleLanes<F>{inside, s.offset / dot(dir, s.normal)}, dir, reach);
}

// The same for rays that share no set-up: U, V and W are turned instead of what they are made from.
// a, b, c: vertices relative to the rays' origins.
template <class F>
FASTRT_INLINE TriangleLanes<F> intersect_triangle(const V3<F>& a, const V3<F>& b, const V3<F>& c,
                                                  const V3<F>& dir, const F& largest_origin,
                                                  std::uint32_t asked) {
  const V3<F> edge_a = cross(b - c, b + c), edge_b = cross(c - a, c + a), edge_c = cross(a - b, a + b),
              normal = cross(b - a, c - a);
  const F offset = dot(a, normal), sign = sign_bit(offset);
  const EdgeSides<F> at{flip(dot(dir, edge_a), sign), flip(dot(dir, edge_b), sign),
                        flip(dot(dir, edge_c), sign)};
  const MaskOf<F> inside = inside_edges(at, edge_a, edge_b, edge_c, dir, asked);
  if ((asked & to_bits(inside)) == 0) return {inside, F(0.0F)};
  return held_to_reach(TriangleLanes<F>{inside, offset / dot(dir, normal)}, dir,
                       [&] { return reach_of(a, b, c, largest_origin); });
}

// Weights of the second and third vertex at the point where the line meets the plane.
template <class F>
struct Barycentric {
  F u, v;
};
template <class F>
FASTRT_INLINE Barycentric<F> triangle_weights(const TriangleSetup<F>& s, const V3<F>& dir) {
  const F u = dot(dir, s.edge_a);
  const F v = dot(dir, s.edge_b);
  const F w = dot(dir, s.edge_c);
  const F sum = (u + v) + w;
  const F inverse = select(sum == F(0.0F), F(0.0F), F(1.0F) / sum);
  return {v * inverse, w * inverse};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
