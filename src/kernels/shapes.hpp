// SPDX-License-Identifier: Apache-2.0
// Rays against one cone, disk, polygon or plane (docs/numerics.md). One function per register width: these
// are met far more rarely than triangles.
#pragma once

#include "src/kernels/triangle.hpp"
#include "src/trace/scene_view.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

template <class F>
struct ShapeLanes {
  MaskOf<F> hit;
  F t; // meaningful where `hit`; > t_min there
};

// What a shape is asked for: hits at t_min < t, of the lanes in `bits`. Hits beyond `limit`, and of other
// lanes, may be reported or not.
template <class F>
struct ShapeQuestion {
  F t_min, limit;
  std::uint32_t bits;
};

// Whether the point at t is in the shape's own box, a little larger for the rounding: then it is in every box
// that a tree knows of.
template <class F>
FASTRT_INLINE MaskOf<F> is_within_reach(const float* low, const float* high, const V3<F>& origin,
                                        const V3<F>& dir, const F& t) {
  const V3<F> from = broadcast3<F>(low) - origin, to = broadcast3<F>(high) - origin;
  const F share(reach_margin);
  const F margin = max(largest(from), largest(to)) * share + largest(origin) * share;
  const V3<F> q = dir * t;
  return (q.x >= from.x - margin) & (q.y >= from.y - margin) & (q.z >= from.z - margin) &
         (q.x <= to.x + margin) & (q.y <= to.y + margin) & (q.z <= to.z + margin);
}

// From where to where a line is inside something.
template <class F>
struct Inside {
  F from, to;
};

// The line along `dir` from a point `m` above the middle of a slab, at a slope of n.
template <class F>
FASTRT_INLINE Inside<F> inside_slab(const F& half_height, const F& m, const F& n) {
  const F inverse = F(1.0F) / n;
  const F a = (negate(half_height) - m) * inverse, b = (half_height - m) * inverse;
  const MaskOf<F> level = n == F(0.0F);
  const MaskOf<F> within = abs(m) <= half_height;
  const F none(__builtin_inff()), all(-__builtin_inff());
  return {select(level, select(within, all, none), min(a, b)),
          select(level, select(within, none, all), max(a, b))};
}

// How much farther than its radius a line must pass from a cylinder's axis, so that the test lets it through
// for certain not: as shares of the radius' square, and of that of the numbers that the test is made of
// (docs/numerics.md, "Cone, disk, polygon, plane").
inline constexpr float cylinder_share = 1.0F + 0x1p-6F, cylinder_rounding = 0x1p-28F;

// The lines that pass a cylinder by for certain, without a division; f: origin - center.
template <class F>
FASTRT_INLINE MaskOf<F> passes_by(const ConeRow& cone, const V3<F>& axis, const V3<F>& f, const V3<F>& dir) {
  const F radius2(cone.radius * cone.radius);
  const V3<F> across{cull_mul_sub(dir.y, axis.z, dir.z * axis.y), cull_mul_sub(dir.z, axis.x, dir.x * axis.z),
                     cull_mul_sub(dir.x, axis.y, dir.y * axis.x)};
  const auto square = [](const V3<F>& v) {
    return cull_mul_add(v.z, v.z, cull_mul_add(v.y, v.y, v.x * v.x));
  };
  const F apart = cull_mul_add(f.z, across.z, cull_mul_add(f.y, across.y, f.x * across.x));
  const F rounding = cull_mul_add(square(dir) * (square(f) + radius2), F(cylinder_rounding), F(1e-30F));
  const F apart2 = apart * apart;
  return (apart2 > cull_mul_add(square(across), radius2 * F(cylinder_share), rounding)) &
         (apart2 < F(__builtin_inff()));
}

template <class F>
FASTRT_INLINE ShapeLanes<F> intersect_cone(const ConeRow& cone, const V3<F>& origin, const V3<F>& dir,
                                           const ShapeQuestion<F>& asked) {
  const F zero(0.0F), forever(__builtin_inff()), ever(-__builtin_inff());
  const V3<F> axis = broadcast3<F>(cone.axis);
  const V3<F> f = origin - broadcast3<F>(cone.center);
  if (cone.slope == 0.0F && (~to_bits(passes_by(cone, axis, f, dir)) & asked.bits) == 0)
    return {from_bits<width_of<F>>(0), zero};
  const F shift = negate(dot(f, dir)) / dot(dir, dir);
  const V3<F> l = f + dir * shift;
  const F m = dot(l, axis), n = dot(dir, axis);
  const V3<F> g = l - axis * m, e = dir - axis * n;
  const F k = F(cone.radius) + F(cone.slope) * m, grow = F(cone.slope) * n;
  const F twist = dot(axis, cross(g, e));
  const V3<F> w = e * k - g * grow;
  const F discriminant = dot(w, w) - twist * twist;
  const F a = dot(e, e) - grow * grow;
  const MaskOf<F> steep = a < zero;
  MaskOf<F> meets = (discriminant >= zero) | steep;
  if ((to_bits(meets) & asked.bits) == 0) return {from_bits<width_of<F>>(0), zero};
  const F b = k * grow - dot(g, e);
  const F c = dot(g, g) - k * k;
  const F q = b + flip(sqrt(max(discriminant, zero)), sign_bit(b));
  const F t0 = q / a, t1 = c / q;
  const F low = min(t1, t0), high = max(t1, t0);
  const MaskOf<F> opens = grow > zero, along = (a == zero) & (q == zero);
  F from = select(steep, select(opens, high, ever), low);
  F to = select(steep, select(opens, forever, low), high);
  from = select(along, ever, from);
  to = select(along, forever, to);
  meets = meets & ((c <= zero) | !along);
  const Inside<F> slab = inside_slab(F(cone.half_height), m, n);
  MaskOf<F> enters, leaves;
  if (cone.capped != 0) {
    from = max(from, slab.from);
    to = min(to, slab.to);
    enters = leaves = from <= to;
  } else {
    enters = (slab.from <= from) & (from <= slab.to);
    leaves = (slab.from <= to) & (to <= slab.to);
  }
  const F t_from = shift + from, t_to = shift + to;
  const MaskOf<F> first = enters & (t_from > asked.t_min);
  const MaskOf<F> hit = meets & (first | (leaves & (t_to > asked.t_min)));
  if ((to_bits(hit) & asked.bits) == 0) return {from_bits<width_of<F>>(0), zero};
  const F t = select(first, t_from, t_to);
  return {hit & is_within_reach(cone.low, cone.high, origin, dir, t), t};
}

template <class F>
FASTRT_INLINE ShapeLanes<F> intersect_disk(const DiskRow& disk, const V3<F>& origin, const V3<F>& dir,
                                           const ShapeQuestion<F>& asked) {
  const V3<F> normal = broadcast3<F>(disk.normal);
  const V3<F> f = broadcast3<F>(disk.center) - origin;
  const F t = dot(f, normal) / dot(dir, normal);
  const V3<F> q = dir * t - f;
  const F radius(disk.radius);
  const MaskOf<F> hit = (dot(q, q) <= radius * radius) & (t > asked.t_min);
  if ((to_bits(hit) & asked.bits) == 0) return {from_bits<width_of<F>>(0), t};
  return {hit & is_within_reach(disk.low, disk.high, origin, dir, t), t};
}

template <class F>
FASTRT_INLINE F axis_of(const V3<F>& v, std::uint32_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// The Jordan curve: how many edges lie beyond the point, one bit a lane.
template <class F>
FASTRT_INLINE std::uint32_t odd_crossings(const EdgeRow* edge, const EdgeRow* end, const F& x, const F& y) {
  std::uint32_t odd = 0;
  for (; edge != end; ++edge) {
    const F low(edge->low);
    odd ^= to_bits((low <= y) & (y < F(edge->high)) & (x < F(edge->x) + (y - low) * F(edge->slope)));
  }
  return odd;
}

// The same for a polygon in bands: each band's edges by the lanes whose points lie in it. Lanes in `bits`.
template <class F>
FASTRT_INLINE std::uint32_t odd_band_crossings(const ShapeView& shapes, const PolygonRow& polygon,
                                               std::uint32_t bits, const F& x, const F& y) {
  const F most(static_cast<float>(polygon.band_count - 1)), zero(0.0F);
  const F place = max(min((y - F(polygon.band_low)) * F(polygon.band_scale), most), zero);
  const F band = simd::to_float(simd::to_int(place));
  alignas(64) float bands[width_of<F>];
  band.store_aligned(bands);
  std::uint32_t odd = 0;
  for (std::uint32_t here = 0; bits != 0; bits &= ~here) {
    const float b = bands[__builtin_ctz(bits)];
    here = to_bits(band == F(b)) & bits;
    const BandRow& row = shapes.bands[polygon.first_band + static_cast<std::uint32_t>(b)];
    const EdgeRow* const edges = shapes.edges + row.first_edge;
    odd |= odd_crossings(edges, edges + row.edge_count, x, y) & here;
  }
  return odd;
}

template <class F>
FASTRT_INLINE ShapeLanes<F> intersect_polygon(const ShapeView& shapes, const PolygonRow& polygon,
                                              const V3<F>& origin, const V3<F>& dir,
                                              const ShapeQuestion<F>& asked) {
  const V3<F> normal = broadcast3<F>(polygon.normal);
  const F t = dot(broadcast3<F>(polygon.point) - origin, normal) / dot(dir, normal);
  MaskOf<F> hit = (t > asked.t_min) & (t <= asked.limit) & from_bits<width_of<F>>(asked.bits);
  if (to_bits(hit) != 0) hit = hit & is_within_reach(polygon.low, polygon.high, origin, dir, t);
  if (to_bits(hit) == 0) return {hit, t};
  const F x = axis_of(origin, polygon.axis_x) + t * axis_of(dir, polygon.axis_x);
  const F y = axis_of(origin, polygon.axis_y) + t * axis_of(dir, polygon.axis_y);
  if (polygon.band_count != 0)
    return {from_bits<width_of<F>>(odd_band_crossings(shapes, polygon, to_bits(hit), x, y)), t};
  const EdgeRow* const first = shapes.edges + polygon.first_edge;
  return {hit & from_bits<width_of<F>>(odd_crossings(first, first + polygon.edge_count, x, y)), t};
}

template <class F>
FASTRT_INLINE ShapeLanes<F> intersect_plane(const PlaneRow& plane, const V3<F>& origin, const V3<F>& dir,
                                            const F& t_min) {
  const V3<F> normal = broadcast3<F>(plane.normal);
  const F t = dot(broadcast3<F>(plane.point) - origin, normal) / dot(dir, normal);
  return {t > t_min, t};
}

// A cone, disk or polygon by its id. The caller checks t < t_max.
template <class F>
[[gnu::noinline]] static ShapeLanes<F> intersect_shape(const ShapeView& shapes, std::int32_t id,
                                                       const V3<F>& origin, const V3<F>& dir,
                                                       const ShapeQuestion<F>& asked) noexcept {
  if (id < shapes.first_disk) return intersect_cone(shapes.cones[id - shapes.first_cone], origin, dir, asked);
  if (id < shapes.first_polygon)
    return intersect_disk(shapes.disks[id - shapes.first_disk], origin, dir, asked);
  return intersect_polygon(shapes, shapes.polygons[id - shapes.first_polygon], origin, dir, asked);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
