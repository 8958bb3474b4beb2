// SPDX-License-Identifier: Apache-2.0
// Surfaces of cones, disks, polygons and planes (docs/numerics.md, "The surface at a hit").
#pragma once

#include "src/trace/surface_lanes.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Rows of one kind, one for each of the lanes in `bits`.
template <class Row>
struct RowLanes {
  const Row* rows;
  PathI places; // in words
  std::uint32_t bits;
};

template <class Row>
FASTRT_INLINE RowLanes<Row> lanes_of(const Row* rows, std::int32_t first, const PathI& ids,
                                     std::uint32_t bits) {
  return {rows, (ids - PathI(first)) * PathI(static_cast<std::int32_t>(sizeof(Row) / sizeof(float))), bits};
}

// One of their numbers, or vectors.
template <class Row, class Number>
FASTRT_INLINE auto get(const RowLanes<Row>& lanes, Number Row::*member) {
  return gather(&(lanes.rows->*member), lanes.places, lanes.bits);
}
template <class Row>
FASTRT_INLINE PathV get(const RowLanes<Row>& lanes, float (Row::*member)[3]) {
  const float* const first = lanes.rows->*member;
  return gather3(first, first + 1, first + 2, lanes.places, lanes.bits);
}

// The size of the numbers of their boxes.
template <class Row>
FASTRT_INLINE PathF largest_of_box(const RowLanes<Row>& lanes) {
  return max(largest(get(lanes, &Row::low)), largest(get(lanes, &Row::high)));
}

// The point is put onto the mantle, or onto the disc at an end where that is closer.
FASTRT_INLINE Surface cone_surface(const RowLanes<ConeRow>& cones, const PathV& origin, const PathV& dir,
                                   const PathF& t) {
  const PathV center = get(cones, &ConeRow::center), u = get(cones, &ConeRow::axis);
  const PathF half_height = get(cones, &ConeRow::half_height), slope = get(cones, &ConeRow::slope);
  const PathM capped = simd::bool_cast(get(cones, &ConeRow::capped) != PathI(0));
  const PathF zero(0.0F), one(1.0F);
  const PathV q = (origin - center) + dir * t;
  const PathF z = dot(q, u);
  const PathV g = q - u * z;
  const PathF distance = sqrt(dot(g, g));
  const PathF height = min(max(z, negate(half_height)), half_height);
  const PathF radius = get(cones, &ConeRow::radius) + slope * height;
  const PathM on_cap = capped & (abs(half_height - abs(z)) < abs(distance - radius));
  const PathV outward = g * simd::select(distance > zero, one / distance, zero);
  const PathV end = u * flip(half_height, sign_bit(z)) + g;
  Surface s;
  s.geometric = select(on_cap, u, normalize(outward - u * slope));
  s.point = center + select(on_cap, end, u * height + outward * radius);
  s.shading = s.geometric;
  s.magnitude = largest_of_box(cones);
  return s;
}

// Disks, polygons and planes; magnitude: of all but planes.
struct FlatLanes {
  PathV point, normal;
  PathF magnitude;
  std::uint32_t planes;
};

FASTRT_INLINE FlatLanes flat_lanes(const ShapeView& shapes, const PathI& ids, std::uint32_t disks,
                                   std::uint32_t polygons, std::uint32_t planes) {
  const PathV none = broadcast3<PathF>(0.0F, 0.0F, 0.0F);
  FlatLanes flat{none, none, PathF(0.0F), planes};
  const auto add = [&](const auto& lanes, const PathV& point, const PathV& normal, const PathF& magnitude) {
    const PathM mask = from_bits<widest>(lanes.bits);
    flat.point = select(mask, point, flat.point);
    flat.normal = select(mask, normal, flat.normal);
    flat.magnitude = simd::select(mask, magnitude, flat.magnitude);
  };
  if (disks != 0) {
    const auto lanes = lanes_of(shapes.disks, shapes.first_disk, ids, disks);
    add(lanes, get(lanes, &DiskRow::center), get(lanes, &DiskRow::normal), largest_of_box(lanes));
  }
  if (polygons != 0) {
    const auto lanes = lanes_of(shapes.polygons, shapes.first_polygon, ids, polygons);
    add(lanes, get(lanes, &PolygonRow::point), get(lanes, &PolygonRow::normal), largest_of_box(lanes));
  }
  if (planes != 0) {
    const auto lanes = lanes_of(shapes.planes, shapes.first_plane, ids, planes);
    add(lanes, get(lanes, &PlaneRow::point), get(lanes, &PlaneRow::normal), PathF(0.0F));
  }
  return flat;
}

// The point is put into the plane.
FASTRT_INLINE Surface flat_surface(const FlatLanes& flat, const PathV& origin, const PathV& dir,
                                   const PathF& t) {
  const PathV q = origin + dir * t;
  Surface s;
  s.point = q - flat.normal * dot(q - flat.point, flat.normal);
  s.geometric = flat.normal;
  s.shading = flat.normal;
  s.magnitude = simd::select(from_bits<widest>(flat.planes), max(largest(flat.point), largest(s.point)),
                             flat.magnitude);
  return s;
}

// The surfaces of the lanes in `bits`, which hit shapes.
[[gnu::noinline]] static Surface shape_surface(const ShapeView& shapes, const PathI& ids, std::uint32_t bits,
                                               const PathV& origin, const PathV& dir,
                                               const PathF& t) noexcept {
  const auto before = [&](std::int32_t end) { return to_bits(simd::bool_cast(ids < PathI(end))) & bits; };
  const std::uint32_t cones = before(shapes.first_disk), disks = before(shapes.first_polygon) & ~cones,
                      planes = bits & ~before(shapes.first_plane);
  const auto cone_lanes = lanes_of(shapes.cones, shapes.first_cone, ids, cones);
  if (cones == bits) return cone_surface(cone_lanes, origin, dir, t);
  const FlatLanes flat = flat_lanes(shapes, ids, disks, bits & ~(cones | disks | planes), planes);
  const Surface on_flat = flat_surface(flat, origin, dir, t);
  if (cones == 0) return on_flat;
  return select(from_bits<widest>(cones), cone_surface(cone_lanes, origin, dir, t), on_flat);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
