// SPDX-License-Identifier: Apache-2.0
// Where a ray meets one cone, disk, polygon or plane: docs/numerics.md, operation by operation.
#pragma once

#include "src/reference/arithmetic.hpp"
#include "src/reference/ray.hpp"
#include "src/scene/shapes.hpp"
#include "src/simd/shared_turn.hpp"

#include <fastrt/scene.hpp>

namespace fastrt::reference {

// Where a ray meets a primitive alone. t is meaningless when hit is false.
struct Intersection {
  bool hit;
  float t;
  float u;
  float v;
};

// Whether the point at t is in the shape's own box, a little larger for the rounding. A t that rounding has
// sent elsewhere is no hit, so a box around the shape never hides one.
inline bool is_within_reach(const Aabb& box, const Ray& ray, float t) {
  const Vec3 low = box.lower - ray.origin;
  const Vec3 high = box.upper - ray.origin;
  const float size = max(largest_magnitude(low), largest_magnitude(high));
  const float margin = size * 0x1p-21F + largest_magnitude(ray.origin) * 0x1p-21F;
  const Vec3 q = t * ray.direction;
  for (int axis = 0; axis < 3; ++axis)
    if (!(q[axis] >= low[axis] - margin && q[axis] <= high[axis] + margin)) return false;
  return true;
}

// atan2(y, x) as a share of a full turn, from 0 to 1.
inline float turn_of(float y, float x) {
  const float turn = baseline::shared_turn<baseline::ScalarOps>(y, x);
  return turn < 0.0F ? turn + 1.0F : turn;
}

// (u, v) of a point q of the mantle, relative to the cone's middle: around the axis, and up along it.
inline Vec2 coordinates_on(const ConeShape& cone, const Vec3& q) {
  const float z = glm::dot(q, cone.axis);
  const Vec3 g = q - z * cone.axis;
  const float turn = turn_of(glm::dot(g, glm::cross(cone.axis, cone.side)), glm::dot(g, cone.side));
  return {turn, 0.5F + 0.5F * (z / cone.half_height)};
}

// Around the middle, and out from it.
inline Vec2 coordinates_on(const DiskShape& disk, const Vec3& q) {
  const float turn = turn_of(glm::dot(q, glm::cross(disk.normal, disk.side)), glm::dot(q, disk.side));
  return {turn, std::sqrt(glm::dot(q, q)) / disk.radius};
}

// Lengths in the plane of a polygon or plane.
template <class Flat>
Vec2 coordinates_on(const Flat& flat, const Vec3& q) {
  return {glm::dot(q, flat.side), glm::dot(q, glm::cross(flat.normal, flat.side))};
}

// A hit at t, or none. origin: the ray's, relative to the point of the shape that (u, v) are counted from.
template <class Shape>
Intersection intersection(bool hit, float t, const Shape& shape, const Vec3& origin, const Vec3& direction) {
  const Vec2 uv = hit ? coordinates_on(shape, origin + t * direction) : Vec2(0.0F);
  return {hit, t, uv.x, uv.y};
}

// From where to where a line is inside something.
struct Inside {
  float from, to;
};

// The heights between -half_height and half_height, for a line at height m that climbs by n.
inline Inside inside_slab(float half_height, float m, float n) {
  if (n == 0.0F) {
    if (std::fabs(m) <= half_height) return {-infinity, infinity};
    return {infinity, -infinity};
  }
  const float inverse = 1.0F / n;
  const float a = (-half_height - m) * inverse;
  const float b = (half_height - m) * inverse;
  return {min(a, b), max(a, b)};
}

// The lecture's quadric for a cone that need not end in a point, with the ray moved to its point closest to
// the middle, so that far away nothing cancels.
inline Intersection intersect_cone(const Ray& ray, const ConeShape& cone) {
  const Intersection miss{false, ray.t_max, 0, 0};
  const Vec3& d = ray.direction;
  const Vec3& u = cone.axis;
  const Vec3 f = ray.origin - cone.center;
  const float shift = -glm::dot(f, d) / glm::dot(d, d);
  const Vec3 l = f + shift * d;
  // Along the axis, and across.
  const float m = glm::dot(l, u);
  const float n = glm::dot(d, u);
  const Vec3 g = l - m * u;
  const Vec3 e = d - n * u;
  // The radius at height m, and how it grows along the ray.
  const float k = cone.radius + cone.slope * m;
  const float grow = cone.slope * n;
  // a*t^2 - 2*b*t + c = |g + t*e|^2 - (k + t*grow)^2, and b^2 - a*c as a difference of two squares.
  const float twist = glm::dot(u, glm::cross(g, e));
  const Vec3 w = k * e - grow * g;
  const float discriminant = glm::dot(w, w) - twist * twist;
  const float a = glm::dot(e, e) - grow * grow;
  const bool steep = a < 0.0F; // the ray climbs faster than the mantle, and meets both halves of the cone
  if (!(discriminant >= 0.0F || steep)) return miss;
  const float b = k * grow - glm::dot(g, e);
  const float c = glm::dot(g, g) - k * k;
  const float q = b + std::copysign(std::sqrt(max(discriminant, 0.0F)), b);
  const float t0 = q / a;
  const float t1 = c / q;
  const float low = min(t1, t0);
  const float high = max(t1, t0);

  Inside inside{low, high};
  if (steep) inside = grow > 0.0F ? Inside{high, infinity} : Inside{-infinity, low};
  if (a == 0.0F && q == 0.0F) { // along the axis of a cylinder
    if (!(c <= 0.0F)) return miss;
    inside = {-infinity, infinity};
  }
  const Inside slab = inside_slab(cone.half_height, m, n);
  bool enters = slab.from <= inside.from && inside.from <= slab.to;
  bool leaves = slab.from <= inside.to && inside.to <= slab.to;
  if (cone.capped) {
    inside = {max(inside.from, slab.from), min(inside.to, slab.to)};
    enters = leaves = inside.from <= inside.to;
  }
  const float t_from = shift + inside.from;
  const float t_to = shift + inside.to;
  const bool first = enters && t_from > ray.t_min;
  if (!first && !(leaves && t_to > ray.t_min)) return miss;
  const float t = first ? t_from : t_to;
  return intersection(t < ray.t_max && is_within_reach(cone.box, ray, t), t, cone, f, d);
}

inline Intersection intersect_disk(const Ray& ray, const DiskShape& disk) {
  const Vec3& d = ray.direction;
  const Vec3 f = disk.center - ray.origin;
  const float t = glm::dot(f, disk.normal) / glm::dot(d, disk.normal);
  const Vec3 q = t * d - f;
  const bool inside = glm::dot(q, q) <= disk.radius * disk.radius;
  const bool hit = inside && ray.t_min < t && t < ray.t_max && is_within_reach(disk.box, ray, t);
  return intersection(hit, t, disk, ray.origin - disk.center, d);
}

// The lecture's Jordan curve: a point is inside when a half line from it, here along x, crosses an odd number
// of edges.
inline bool is_inside_edges(const PolygonEdge* edges, std::uint32_t count, float x, float y) {
  bool inside = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const PolygonEdge& edge = edges[i];
    if (edge.low <= y && y < edge.high && x < edge.x + (y - edge.low) * edge.slope) inside = !inside;
  }
  return inside;
}

inline Intersection intersect_polygon(const Ray& ray, const PolygonShape& polygon, const PolygonEdge* edges) {
  const Vec3& o = ray.origin;
  const Vec3& d = ray.direction;
  const float t = glm::dot(polygon.point - o, polygon.normal) / glm::dot(d, polygon.normal);
  const auto axis_x = static_cast<int>(polygon.axis_x);
  const auto axis_y = static_cast<int>(polygon.axis_y);
  const bool hit = ray.t_min < t && t < ray.t_max && is_within_reach(polygon.box, ray, t) &&
                   is_inside_edges(edges + polygon.first_edge, polygon.edge_count, o[axis_x] + t * d[axis_x],
                                   o[axis_y] + t * d[axis_y]);
  return intersection(hit, t, polygon, o - polygon.point, d);
}

inline Intersection intersect_plane(const Ray& ray, const PlaneShape& plane) {
  const float t = glm::dot(plane.point - ray.origin, plane.normal) / glm::dot(ray.direction, plane.normal);
  return intersection(ray.t_min < t && t < ray.t_max, t, plane, ray.origin - plane.point, ray.direction);
}

} // namespace fastrt::reference
