// SPDX-License-Identifier: Apache-2.0
// Triangles as rectangles of a batch's projection: around all places where their own test may let rays hit.
#pragma once

#include "src/kernels/tile_culling.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Corners of triangles in the plane.
struct ProjectedCorners {
  PacketF ax, ay, bx, by, cx, cy;
};

// The triangles of a run of blocks in the plane.
struct ProjectedTriangles {
  Rectangles<PacketF> bounds;
  ProjectedCorners corners;
};

// What the coordinates of corners add to their depths, axis by axis.
struct DepthParts {
  V3<PacketF> a, b, c;
};

FASTRT_INLINE PacketF depth_of(const V3<PacketF>& parts) { return (parts.x + parts.y) + parts.z; }

// The depths between which rays may hit triangles: those of their boxes. (A ray in a triangle's plane may hit
// it anywhere in its box, before its nearest corner as well.)
FASTRT_INLINE Extent<PacketF> depths_of(const DepthParts& p, const PacketF& padding) {
  const auto least = [&](const PacketF& a, const PacketF& b, const PacketF& c) { return min(a, min(b, c)); };
  const auto most = [&](const PacketF& a, const PacketF& b, const PacketF& c) { return max(a, max(b, c)); };
  const V3<PacketF> low{least(p.a.x, p.b.x, p.c.x), least(p.a.y, p.b.y, p.c.y), least(p.a.z, p.b.z, p.c.z)};
  const V3<PacketF> high{most(p.a.x, p.b.x, p.c.x), most(p.a.y, p.b.y, p.c.y), most(p.a.z, p.b.z, p.c.z)};
  return {depth_of(low) - padding, depth_of(high) + padding};
}

// The rectangles around corners.
FASTRT_INLINE Rectangles<PacketF> bound_corners(const ProjectedCorners& p, const Extent<PacketF>& depths) {
  return {min(p.ax, min(p.bx, p.cx)),
          max(p.ax, max(p.bx, p.cx)),
          min(p.ay, min(p.by, p.cy)),
          max(p.ay, max(p.by, p.cy)),
          depths.low,
          depths.high};
}

FASTRT_INLINE Rectangles<PacketF> widened(const Rectangles<PacketF>& r, const PacketF& mx,
                                          const PacketF& my) {
  return {r.x0 - mx, r.x1 + mx, r.y0 - my, r.y1 + my, r.near, r.end};
}

// What edges let through together, with rounding: at a distance of 1, and of parallel rays in paddings.
inline constexpr float edge_share = 0x1p-17F, edge_paddings = 3.0F;

// How far outside a triangle's rectangle its test may still let a ray hit it: side * share over the
// triangle's area in the plane (docs/numerics.md, "Triangle"). That has no bound where the triangle is seen
// edge-on: all rays in its plane hit it that its box lets through.
FASTRT_INLINE PacketF beyond_edges(const ProjectedCorners& p, const PacketF& side, const PacketF& share) {
  const PacketF area = abs(cull_mul_sub(p.bx - p.ax, p.cy - p.ay, (p.by - p.ay) * (p.cx - p.ax)));
  // Of triangles that are a point of the plane nothing is known.
  return cull_mul_add(side, share, PacketF(1e-30F)) * cull_inverse(area);
}

// The rectangles in which parallel rays may hit triangles. deep: the difference of their corners' depths.
FASTRT_INLINE Rectangles<PacketF> bound_parallel(const ProjectedCorners& p, const Extent<PacketF>& depths,
                                                 const PacketF& deep, const PacketF& padding) {
  const Rectangles<PacketF> r = bound_corners(p, depths);
  const PacketF width = r.x1 - r.x0, height = r.y1 - r.y0;
  const PacketF share = ((width + height) + deep) * (PacketF(edge_paddings) * padding);
  const PacketF margin = padding + beyond_edges(p, max(width, height), share);
  return widened(r, margin, margin);
}

// The same for rays of one origin; the farther out the larger. far: the corners' largest depth; scale: one
// over the least.
FASTRT_INLINE Rectangles<PacketF> bound_perspective(const ProjectedCorners& p, const Extent<PacketF>& depths,
                                                    const PacketF& far, const PacketF& scale,
                                                    const PacketF& padding) {
  const Rectangles<PacketF> r = bound_corners(p, depths);
  const PacketF one(1.0F), x = (abs(r.x0) + abs(r.x1)) + one, y = abs(r.y0) + abs(r.y1), out = x + y;
  const PacketF width = r.x1 - r.x0, height = r.y1 - r.y0, extent = width + height;
  // (By rounding a triangle that is tiny as seen from here may end before it begins.)
  const PacketF deep = max(cull_mul_sub(far, scale, one), PacketF(0.0F));
  const PacketF share = cull_mul_add(extent + out, deep, extent);
  // A hit may lie outside its triangle by rounding: by a share of the plane, and by the padding in space.
  const PacketF margin = cull_mul_add(padding, scale, PacketF(rectangle_margin)) +
                         beyond_edges(p, max(width, height) * (out * PacketF(edge_share)), share);
  return widened(r, x * margin, (y + one) * margin);
}

// Of triangles that reach behind the origin, those that may have points inside all four sides of the batch. A
// hit may lie outside its triangle by what an edge lets through, here as a share of six times the volume
// between triangle and origin. Seldom asked, and kept out of the way of what is.
[[gnu::noinline]] static std::uint32_t within_sides(const TileView& view, const V3<PacketF>& a,
                                                    const V3<PacketF>& b, const V3<PacketF>& c) noexcept {
  const PacketF padding(view.frame.padding), everywhere(__builtin_inff());
  const V3<PacketF> ab = b - a, ac = c - a;
  const PacketF edge = max(largest(ab), largest(ac)) * padding, volume = abs(dot(a, cross(ab, ac)));
  const PacketF beyond =
      select(volume > PacketF(0.0F), (PacketF(0x1p22F) * edge / volume) * edge, everywhere);
  const PacketF tolerance = negate(PacketF(4.0F) * padding + beyond);
  std::uint32_t within = ~0U;
  for (const ExtentAxis& side : view.sides) {
    const V3<PacketF> normal = broadcast3<PacketF>(side.axis);
    within &= to_bits(max(cull_dot(a, normal), max(cull_dot(b, normal), cull_dot(c, normal))) >= tolerance);
  }
  return within;
}

// Vertices relative to the origin.
FASTRT_INLINE ProjectedTriangles project_triangles(const TileView& view, const V3<PacketF>& a,
                                                   const V3<PacketF>& b, const V3<PacketF>& c) {
  const V3<PacketF> u = broadcast3<PacketF>(view.frame.u), v = broadcast3<PacketF>(view.frame.v),
                    w = broadcast3<PacketF>(view.frame.w);
  const DepthParts parts{a * w, b * w, c * w};
  const PacketF aw = depth_of(parts.a), bw = depth_of(parts.b), cw = depth_of(parts.c);
  const PacketF padding(view.frame.padding), one(1.0F);
  const PacketF near = min(aw, min(bw, cw)) - padding, far = max(aw, max(bw, cw));
  ProjectedCorners p{cull_dot(a, u), cull_dot(a, v), cull_dot(b, u),
                     cull_dot(b, v), cull_dot(c, u), cull_dot(c, v)};
  const Extent<PacketF> depths = depths_of(parts, padding);
  if (!view.frame.perspective) return {bound_parallel(p, depths, far - near, padding), p};
  const PacketF ai = one / aw, bi = one / bw, ci = one / cw, scale = max(ai, max(bi, ci));
  p = {p.ax * ai, p.ay * ai, p.bx * bi, p.by * bi, p.cx * ci, p.cy * ci};
  const Rectangles<PacketF> r = bound_perspective(p, depths, far, scale, padding);
  const MaskOf<PacketF> around = near <= PacketF(0.0F);
  // Lane by lane: a copy of the whole would be read from memory before its parts are there.
  PacketF x0 = r.x0, x1 = r.x1, y0 = r.y0, y1 = r.y1;
  if (to_bits(around) != 0) {
    const PacketF everywhere(__builtin_inff()), nowhere = negate(everywhere);
    const MaskOf<PacketF> within = from_bits<widest>(within_sides(view, a, b, c));
    x0 = select(around, select(within, nowhere, everywhere), x0);
    x1 = select(around, everywhere, x1);
    y0 = select(around, nowhere, y0);
    y1 = select(around, everywhere, y1);
  }
  return {{x0, x1, y0, y1, depths.low, depths.high}, p};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
