// SPDX-License-Identifier: Apache-2.0
// Ray against triangle, by edge normals through the ray's origin (docs/numerics.md, "Triangle"). The lanes
// may be rays, triangles or both: whatever is the same in all lanes comes broadcast.
#pragma once

#include "src/kernels/vec3.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

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

template <class F>
struct TriangleLanes {
  MaskOf<F> inside;
  F t; // meaningful where `inside`
};

// Where the line through the origin along `dir` passes inside the triangle, and at which t. The caller checks
// the range of t; NaN fails every comparison. The division waits until some lane needs it.
template <class F>
FASTRT_INLINE TriangleLanes<F> intersect_triangle(const TriangleSetup<F>& s, const V3<F>& dir) {
  const F u = dot(dir, s.edge_a);
  const F v = dot(dir, s.edge_b);
  const F w = dot(dir, s.edge_c);
  const F sum = (u + v) + w;
  const MaskOf<F> inside = min(u, min(v, w)) >= negate(F(0x1p-23F) * abs(sum));
  if (to_bits(inside) == 0) return {inside, F(0.0F)};
  return {inside, s.offset / dot(dir, s.normal)};
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
  const F inverse = F(1.0F) / ((u + v) + w);
  return {v * inverse, w * inverse};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
