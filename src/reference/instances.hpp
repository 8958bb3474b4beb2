// SPDX-License-Identifier: Apache-2.0
// What instances make of rays, points and normals: docs/numerics.md, "Instances", operation by operation.
#pragma once

#include "src/reference/intersect.hpp"

#include <fastrt/scene.hpp>

namespace fastrt::reference {

inline Vec3 map_vector(const Affine& map, const Vec3& v) { return (map.x * v.x + map.y * v.y) + map.z * v.z; }
inline Vec3 map_point(const Affine& map, const Vec3& p) { return map_vector(map, p) + map.origin; }

// Normals go the other way, by the transpose of the inverse. Divided by the largest part first, so that the
// square neither overflows nor vanishes.
inline Vec3 map_normal(const Affine& inverse, const Vec3& n) {
  const Vec3 mapped{glm::dot(inverse.x, n), glm::dot(inverse.y, n), glm::dot(inverse.z, n)};
  return glm::normalize(mapped / largest_magnitude(mapped));
}

// The largest number that a point with no coordinate over `magnitude` is mapped by.
inline float map_magnitude(const Affine& map, float magnitude) {
  const Vec3 sum = (magnitudes(map.x) + magnitudes(map.y)) + magnitudes(map.z);
  return largest(sum * magnitude + magnitudes(map.origin));
}

// From where to where a ray is in an instance's box, a little larger for the rounding, and within its own
// interval.
inline Inside inside_box(const Ray& ray, const Aabb& box) {
  Vec3 low = box.lower - ray.origin;
  Vec3 high = box.upper - ray.origin;
  const float size = max(largest_magnitude(low), largest_magnitude(high));
  const float margin = size * 0x1p-21F + largest_magnitude(ray.origin) * 0x1p-21F;
  low = low - Vec3(margin);
  high = high + Vec3(margin);
  Inside inside{ray.t_min, ray.t_max};
  for (int axis = 2; axis >= 0; --axis) {
    const float inverse = 1.0F / ray.direction[axis];
    const bool backwards = inverse < 0.0F;
    inside.from = max((backwards ? high[axis] : low[axis]) * inverse, inside.from);
    inside.to = min((backwards ? low[axis] : high[axis]) * inverse, inside.to);
  }
  return inside;
}

// The ray in the instance's object space: t is the same there. What it excludes is then a primitive.
inline Ray object_ray(const Scene& scene, const Ray& ray, std::uint32_t instance) {
  const Affine& inverse = scene.shapes().instances[instance].to_object;
  Ray inner = ray;
  inner.origin = map_point(inverse, ray.origin);
  inner.direction = map_vector(inverse, ray.direction);
  if (ray.excluded_instance != static_cast<std::int32_t>(instance)) inner.excluded = no_primitive;
  inner.excluded_instance = no_instance;
  return inner;
}

inline Ray object_ray(const Scene& scene, const Ray& ray, const Hit& hit) {
  return hit.instance == no_instance ? ray : object_ray(scene, ray, static_cast<std::uint32_t>(hit.instance));
}

// Whether numbers of a ray make sense: a map may send them to infinity.
inline bool is_traceable(const Ray& ray) {
  const Vec3 o = magnitudes(ray.origin);
  const Vec3 d = magnitudes(ray.direction);
  const float size = (d.x + d.y) + d.z;
  return ((o.x + o.y) + o.z) * 0.0F == 0.0F && size > 0.0F && size < infinity;
}

// The coordinates of the point at t. A triangle's are the ray's own, wherever on it the point is taken to be.
inline Vec2 coordinates_at(const Scene& scene, const Ray& ray, const Hit& hit) {
  const auto id = static_cast<std::uint32_t>(hit.primitive);
  const PrimitiveKind kind = scene.kind(id);
  const std::uint32_t row = id - scene.first_of(kind);
  const SceneShapes& shapes = scene.shapes();
  const auto from = [&](const Vec3& point) { return (ray.origin - point) + hit.t * ray.direction; };
  switch (kind) {
  case PrimitiveKind::sphere:
    return coordinates_on_sphere(from(sphere_shape(scene, row).center));
  case PrimitiveKind::cone:
    return coordinates_on(shapes.cones[row], from(shapes.cones[row].center));
  case PrimitiveKind::disk:
    return coordinates_on(shapes.disks[row], from(shapes.disks[row].center));
  case PrimitiveKind::polygon:
    return coordinates_on(shapes.polygons[row], from(shapes.polygons[row].point));
  default:
    return {hit.u, hit.v};
  }
}

// Keeps the hit of an instance if it is closer than the best so far; at equal t ids decide, and those of
// instances come after those of primitives. closest: the best hit of the prototype's primitives for a ray in
// object space.
template <class Closest>
void meet_instance(const Scene& scene, const Ray& ray, std::uint32_t instance, Hit& best,
                   const Closest& closest) {
  const InstanceShape& shape = scene.shapes().instances[instance];
  if (shape.box.empty()) return;
  const Inside inside = inside_box(ray, shape.box);
  if (!(inside.from < inside.to)) return;
  const Ray inner = object_ray(scene, ray, instance);
  if (!is_traceable(inner)) return;
  Hit hit = closest(inner);
  if (!hit.found()) return;
  // Rounding may have moved the hit out of the box.
  if (hit.t < inside.from) hit.t = inside.from;
  if (hit.t > inside.to) hit.t = inside.to;
  const Vec2 uv = coordinates_at(scene, inner, hit);
  hit.u = uv.x;
  hit.v = uv.y;
  hit.instance = static_cast<std::int32_t>(instance);
  if (hit.t < best.t || (hit.t == best.t && hit.instance < best.instance)) best = hit;
}

} // namespace fastrt::reference
