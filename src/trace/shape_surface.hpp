// SPDX-License-Identifier: Apache-2.0
// Surfaces of cones, disks, polygons and planes (docs/numerics.md, "The surface at a hit").
#pragma once

#include "src/trace/surface_lanes.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// A shape per lane, gathered from its row: for flat ones a point and the normal.
struct ShapeLanesRows {
  alignas(64) float point[3][widest], axis[3][widest];
  alignas(64) float half_height[widest], radius[widest], slope[widest], magnitude[widest];
  std::uint32_t cones, capped, planes; // lanes
};

FASTRT_INLINE float largest_of_box(const float* low, const float* high) {
  float most = 0.0F;
  for (int c = 0; c < 3; ++c) {
    most = most > __builtin_fabsf(low[c]) ? most : __builtin_fabsf(low[c]);
    most = most > __builtin_fabsf(high[c]) ? most : __builtin_fabsf(high[c]);
  }
  return most;
}

FASTRT_INLINE void gather_vectors(const float* point, const float* axis, int lane, ShapeLanesRows& rows) {
  for (int c = 0; c < 3; ++c) {
    rows.point[c][lane] = point[c];
    rows.axis[c][lane] = axis[c];
  }
}

FASTRT_INLINE void gather_shape(const ShapeView& shapes, std::int32_t id, int lane, ShapeLanesRows& rows) {
  if (id < shapes.first_disk) {
    const ConeRow& cone = shapes.cones[id - shapes.first_cone];
    gather_vectors(cone.center, cone.axis, lane, rows);
    rows.half_height[lane] = cone.half_height;
    rows.radius[lane] = cone.radius;
    rows.slope[lane] = cone.slope;
    rows.magnitude[lane] = largest_of_box(cone.low, cone.high);
    rows.cones |= 1U << lane;
    rows.capped |= cone.capped << lane;
  } else if (id < shapes.first_polygon) {
    const DiskRow& disk = shapes.disks[id - shapes.first_disk];
    gather_vectors(disk.center, disk.normal, lane, rows);
    rows.magnitude[lane] = largest_of_box(disk.low, disk.high);
  } else if (id < shapes.first_plane) {
    const PolygonRow& polygon = shapes.polygons[id - shapes.first_polygon];
    gather_vectors(polygon.point, polygon.normal, lane, rows);
    rows.magnitude[lane] = largest_of_box(polygon.low, polygon.high);
  } else {
    const PlaneRow& plane = shapes.planes[id - shapes.first_plane];
    gather_vectors(plane.point, plane.normal, lane, rows);
    rows.planes |= 1U << lane;
  }
}

FASTRT_INLINE PathV load_rows(const float (*rows)[widest]) {
  return {PathF::load_aligned(rows[0]), PathF::load_aligned(rows[1]), PathF::load_aligned(rows[2])};
}

// The point is put onto the mantle, or onto the disc at an end where that is closer.
FASTRT_INLINE Surface cone_surface(const ShapeLanesRows& rows, const PathV& origin, const PathV& dir,
                                   const PathF& t) {
  const PathV center = load_rows(rows.point), u = load_rows(rows.axis);
  const PathF half_height = PathF::load_aligned(rows.half_height), slope = PathF::load_aligned(rows.slope);
  const PathF zero(0.0F), one(1.0F);
  const PathV q = (origin - center) + dir * t;
  const PathF z = dot(q, u);
  const PathV g = q - u * z;
  const PathF distance = sqrt(dot(g, g));
  const PathF height = min(max(z, negate(half_height)), half_height);
  const PathF radius = PathF::load_aligned(rows.radius) + slope * height;
  const PathM on_cap = from_bits<widest>(rows.capped) & (abs(half_height - abs(z)) < abs(distance - radius));
  const PathV outward = g * simd::select(distance > zero, one / distance, zero);
  const PathV end = u * flip(half_height, sign_bit(z)) + g;
  Surface s;
  s.geometric = select(on_cap, u, normalize(outward - u * slope));
  s.point = center + select(on_cap, end, u * height + outward * radius);
  s.shading = s.geometric;
  s.magnitude = PathF::load_aligned(rows.magnitude);
  return s;
}

// The point is put into the plane.
FASTRT_INLINE Surface flat_surface(const ShapeLanesRows& rows, const PathV& origin, const PathV& dir,
                                   const PathF& t) {
  const PathV point = load_rows(rows.point), normal = load_rows(rows.axis);
  const PathV q = origin + dir * t;
  Surface s;
  s.point = q - normal * dot(q - point, normal);
  s.geometric = normal;
  s.shading = normal;
  s.magnitude = simd::select(from_bits<widest>(rows.planes), max(largest(point), largest(s.point)),
                             PathF::load_aligned(rows.magnitude));
  return s;
}

// The surfaces of the lanes in `bits`, which hit shapes.
[[gnu::noinline]] static Surface shape_surface(const ShapeView& shapes, const std::int32_t* primitives,
                                               std::uint32_t bits, const PathV& origin, const PathV& dir,
                                               const PathF& t) noexcept {
  ShapeLanesRows rows{};
  for (std::uint32_t left = bits; left != 0; left &= left - 1)
    gather_shape(shapes, primitives[__builtin_ctz(left)], __builtin_ctz(left), rows);
  if (rows.cones == bits) return cone_surface(rows, origin, dir, t);
  const Surface flat = flat_surface(rows, origin, dir, t);
  if (rows.cones == 0) return flat;
  return select(from_bits<widest>(rows.cones), cone_surface(rows, origin, dir, t), flat);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
