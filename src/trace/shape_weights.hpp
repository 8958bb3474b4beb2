// SPDX-License-Identifier: Apache-2.0
// (u, v) of hits of spheres and shapes, one by one (docs/numerics.md).
#pragma once

#include "src/simd/shared_turn.hpp"
#include "src/trace/surface.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

struct ShapeWeights {
  float u, v;
};

FASTRT_INLINE V3<float> vector_of(const float* v) { return {v[0], v[1], v[2]}; }

FASTRT_INLINE float turn_of(float y, float x) {
  const float turn = shared_turn<ScalarOps>(y, x);
  return turn < 0.0F ? turn + 1.0F : turn;
}

// q: the point relative to what (u, v) are counted from.
FASTRT_INLINE ShapeWeights sphere_weights(const V3<float>& q) {
  const float latitude = shared_turn<ScalarOps>(q.y, __builtin_sqrtf(q.x * q.x + q.z * q.z));
  return {turn_of(-q.z, q.x), 0.5F + 2.0F * latitude};
}

FASTRT_INLINE ShapeWeights cone_weights(const ConeRow& cone, const V3<float>& q) {
  const V3<float> axis = vector_of(cone.axis), side = vector_of(cone.side);
  const float z = dot(q, axis);
  const V3<float> g = q - axis * z;
  return {turn_of(dot(g, cross(axis, side)), dot(g, side)), 0.5F + 0.5F * (z / cone.half_height)};
}

FASTRT_INLINE ShapeWeights disk_weights(const DiskRow& disk, const V3<float>& q) {
  const V3<float> normal = vector_of(disk.normal), side = vector_of(disk.side);
  return {turn_of(dot(q, cross(normal, side)), dot(q, side)), __builtin_sqrtf(dot(q, q)) / disk.radius};
}

template <class Row>
FASTRT_INLINE ShapeWeights flat_weights(const Row& row, const V3<float>& q) {
  const V3<float> side = vector_of(row.side);
  return {dot(q, side), dot(q, cross(vector_of(row.normal), side))};
}

// Of anything but a triangle, hit at t.
[[gnu::noinline]] static ShapeWeights shape_weights(const ShadingView& scene, std::int32_t id,
                                                    const V3<float>& origin, const V3<float>& dir,
                                                    float t) noexcept {
  const ShapeView& shapes = scene.shapes;
  const auto from = [&](const float* point) { return (origin - vector_of(point)) + dir * t; };
  if (id < shapes.first_cone) {
    const std::uint32_t sphere = static_cast<std::uint32_t>(id) - scene.triangle_count;
    const float center[3] = {scene.sphere_x[sphere], scene.sphere_y[sphere], scene.sphere_z[sphere]};
    return sphere_weights(from(center));
  }
  if (id < shapes.first_disk) {
    const ConeRow& cone = shapes.cones[id - shapes.first_cone];
    return cone_weights(cone, from(cone.center));
  }
  if (id < shapes.first_polygon) {
    const DiskRow& disk = shapes.disks[id - shapes.first_disk];
    return disk_weights(disk, from(disk.center));
  }
  if (id < shapes.first_plane) {
    const PolygonRow& polygon = shapes.polygons[id - shapes.first_polygon];
    return flat_weights(polygon, from(polygon.point));
  }
  const PlaneRow& plane = shapes.planes[id - shapes.first_plane];
  return flat_weights(plane, from(plane.point));
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
