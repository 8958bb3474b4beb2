// SPDX-License-Identifier: Apache-2.0
// Where a ray meets one primitive: docs/numerics.md, "Triangle" and "Sphere", operation by operation. The
// other kinds are in intersect_shapes.hpp.
#pragma once

#include "src/reference/intersect_shapes.hpp"

#include <fastrt/scene.hpp>

namespace fastrt::reference {

struct TriangleVertices {
  Vec3 a, b, c;
};

inline TriangleVertices triangle_vertices(const Scene& scene, std::uint32_t triangle) {
  const TriangleColumns& triangles = scene.triangles();
  const Columns3& positions = scene.positions();
  return {positions[triangles.v0[triangle]], positions[triangles.v1[triangle]],
          positions[triangles.v2[triangle]]};
}

struct SphereShape {
  Vec3 center;
  float radius;
};

inline SphereShape sphere_shape(const Scene& scene, std::uint32_t sphere) {
  const SphereColumns& spheres = scene.spheres();
  return {{spheres.x[sphere], spheres.y[sphere], spheres.z[sphere]}, spheres.radius[sphere]};
}

// What the ray must reach of a triangle: its box seen from the origin, a little larger for the rounding.
struct Reach {
  Vec3 low, high;
};

inline Reach reach_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& origin) {
  Reach reach;
  for (int axis = 0; axis < 3; ++axis) {
    reach.low[axis] = min(a[axis], min(b[axis], c[axis]));
    reach.high[axis] = max(a[axis], max(b[axis], c[axis]));
  }
  const float size = max(largest_magnitude(reach.low), largest_magnitude(reach.high));
  const float margin = size * 0x1p-21F + largest_magnitude(origin) * 0x1p-21F;
  reach.low = reach.low - Vec3(margin);
  reach.high = reach.high + Vec3(margin);
  return reach;
}

inline bool contains(const Reach& reach, const Vec3& q) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(q[axis] >= reach.low[axis] && q[axis] <= reach.high[axis])) return false;
  return true;
}

// Where a ray almost in the triangle's plane meets it is a quotient of rounding errors. Moves such a t to the
// part of the ray that is within reach; false if there is none.
inline bool move_into_reach(const Reach& reach, const Vec3& d, float& t) {
  if (!(std::fabs(t) < infinity)) return false;
  float near = 0.0F;
  float far = infinity;
  for (int axis = 2; axis >= 0; --axis) {
    const float inverse = 1.0F / d[axis];
    const bool backwards = inverse < 0.0F;
    near = max((backwards ? reach.high[axis] : reach.low[axis]) * inverse, near);
    far = min((backwards ? reach.low[axis] : reach.high[axis]) * inverse, far);
  }
  if (t < near) t = near;
  if (t > far) t = far;
  return near <= far;
}

// Lecture notes, 11.3.1, in the form with edge normals seen from the origin: an edge that two triangles share
// gives exactly opposite numbers for them, so no ray slips through between.
inline Intersection intersect_triangle(const Ray& ray, const TriangleVertices& triangle) {
  const Vec3& d = ray.direction;
  const Vec3 a = triangle.a - ray.origin;
  const Vec3 b = triangle.b - ray.origin;
  const Vec3 c = triangle.c - ray.origin;

  const Vec3 normal = glm::cross(b - a, c - a);
  float plane = glm::dot(a, normal);
  const Vec3 edge_a = glm::cross(b - c, b + c);
  const Vec3 edge_b = glm::cross(c - a, c + a);
  const Vec3 edge_c = glm::cross(a - b, a + b);
  float weight_a = glm::dot(d, edge_a);
  float weight_b = glm::dot(d, edge_b);
  float weight_c = glm::dot(d, edge_c);
  float slope = glm::dot(d, normal);
  // Seen from the back, everything changes its sign.
  if (std::signbit(plane)) {
    plane = -plane;
    weight_a = -weight_a;
    weight_b = -weight_b;
    weight_c = -weight_c;
    slope = -slope;
  }

  const float sum = (weight_a + weight_b) + weight_c;
  // Rounding may put a ray that is aimed at a vertex outside of all triangles around it by this much.
  const float size = largest_magnitude(d);
  const bool inside = weight_a >= -((0x1p-22F * largest_magnitude(edge_a)) * size) &&
                      weight_b >= -((0x1p-22F * largest_magnitude(edge_b)) * size) &&
                      weight_c >= -((0x1p-22F * largest_magnitude(edge_c)) * size);
  if (!inside) return {false, ray.t_max, 0, 0};
  float t = plane / slope;
  const Reach reach = reach_of(a, b, c, ray.origin);
  const bool reached = contains(reach, t * d) || move_into_reach(reach, d, t);
  const float scale = sum == 0.0F ? 0.0F : 1.0F / sum;
  return {reached && ray.t_min < t && t < ray.t_max, t, weight_b * scale, weight_c * scale};
}

// Around the y axis from x on, as from the outside to the right; and from the lowest point up. n: from the
// centre to the point.
inline Vec2 coordinates_on_sphere(const Vec3& n) {
  const float latitude = baseline::shared_turn<baseline::ScalarOps>(n.y, std::sqrt(n.x * n.x + n.z * n.z));
  return {turn_of(-n.z, n.x), 0.5F + 2.0F * latitude};
}

// Lecture notes, 11.3.3, in the stable form of Haines, Guenther & Akenine-Moeller (Ray Tracing Gems, ch. 7,
// 2019): the discriminant from the point of the line that is closest to the centre.
inline Intersection intersect_sphere(const Ray& ray, const SphereShape& sphere) {
  const Vec3& d = ray.direction;
  const Vec3 f = ray.origin - sphere.center;
  const float a = glm::dot(d, d);
  const float b = -glm::dot(f, d);
  const Vec3 closest = f + (b / a) * d;
  const float discriminant = sphere.radius * sphere.radius - glm::dot(closest, closest);
  if (!(discriminant >= 0.0F)) return {false, ray.t_max, 0, 0};

  const float c = glm::dot(f, f) - sphere.radius * sphere.radius;
  const float q = b + std::copysign(std::sqrt(a) * std::sqrt(discriminant), b);
  const float t0 = c / q;
  const float t1 = q / a;
  const float near = min(t0, t1);
  const float far = max(t0, t1);
  const float t = near > ray.t_min ? near : far;
  const bool hit = ray.t_min < t && t < ray.t_max;
  if (!hit) return {false, t, 0, 0};
  const Vec2 uv = coordinates_on_sphere(f + t * d);
  return {true, t, uv.x, uv.y};
}

inline Intersection intersect(const Ray& ray, const Scene& scene, std::uint32_t primitive) {
  const PrimitiveKind kind = scene.kind(primitive);
  const std::uint32_t row = primitive - scene.first_of(kind);
  const SceneShapes& shapes = scene.shapes();
  switch (kind) {
  case PrimitiveKind::triangle:
    return intersect_triangle(ray, triangle_vertices(scene, row));
  case PrimitiveKind::sphere:
    return intersect_sphere(ray, sphere_shape(scene, row));
  case PrimitiveKind::cone:
    return intersect_cone(ray, shapes.cones[row]);
  case PrimitiveKind::disk:
    return intersect_disk(ray, shapes.disks[row]);
  case PrimitiveKind::polygon:
    return intersect_polygon(ray, shapes.polygons[row], shapes.edges.data());
  case PrimitiveKind::plane:
    break;
  }
  return intersect_plane(ray, shapes.planes[row]);
}

// Keeps the closer of two hits; at equal t the one with the smaller id, so that the order in which primitives
// are met does not matter. What an instance shows comes after all that is there by itself.
inline void keep_closest(Hit& best, const Intersection& found, std::uint32_t primitive) {
  if (!found.hit) return;
  const auto id = static_cast<std::int32_t>(primitive);
  const bool earlier = best.instance != no_instance || id < best.primitive;
  if (found.t < best.t || (found.t == best.t && best.found() && earlier))
    best = {found.t, found.u, found.v, id};
}

} // namespace fastrt::reference
