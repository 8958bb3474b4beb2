// SPDX-License-Identifier: Apache-2.0
// Single rays at a scene, chosen to be difficult.
#pragma once

#include "src/reference/instances.hpp"
#include "tests/equivalence/pairs.hpp"

#include <fastrt/scene.hpp>

namespace fastrt::test {

using reference::Ray;

// The scene's middle and half its diagonal; something sensible for an empty one.
struct Extent {
  Vec3 center{0.0F};
  float radius = 1;
};
inline Extent extent_of(const Scene& scene) {
  if (scene.bounds().empty()) return {};
  return {scene.bounds().center(), 0.5F * glm::length(scene.bounds().extent())};
}

// Square to `axis`, of length 1.
inline Vec3 across(const Vec3& axis, Random& random) {
  return glm::normalize(glm::cross(axis, random.direction()));
}

// A point of the mantle, a rim, an end's disc or the axis.
inline Vec3 target_on_cone(const ConeShape& cone, Random& random) {
  float height = random.uniform(-1, 1) * cone.half_height;
  if (random.below(3) == 0) height = random.below(2) == 0 ? cone.half_height : -cone.half_height;
  float distance = cone.radius + cone.slope * height;
  if (random.below(4) == 0) distance *= random.uniform();
  if (random.below(8) == 0) distance = 0;
  return cone.center + height * cone.axis + distance * across(cone.axis, random);
}

// A vertex, or a point between two or three of them, inside or not.
inline Vec3 target_on_polygon(const Scene& scene, std::uint32_t row, Random& random) {
  const PolygonColumns& polygons = scene.desc().polygons;
  const std::size_t first = contour_begin(polygons, contours_of(polygons, row).first);
  const std::size_t end = polygons.vertex_end[contours_of(polygons, row).end - 1];
  const auto vertex = [&] {
    const auto i = first + random.below(static_cast<std::uint32_t>(end - first));
    return scene.positions()[polygons.vertex[i]];
  };
  const Vec3 a = vertex();
  const std::uint32_t choice = random.below(3);
  if (choice == 0) return a;
  const Vec3 b = vertex();
  const Vec3 between = a + random.uniform() * (b - a);
  return choice == 1 ? between : between + random.uniform() * (vertex() - between);
}

inline Vec3 target_on_shape(const Scene& scene, std::uint32_t primitive, Random& random) {
  const PrimitiveKind kind = scene.kind(primitive);
  const std::uint32_t row = primitive - scene.first_of(kind);
  if (kind == PrimitiveKind::cone) return target_on_cone(scene.shapes().cones[row], random);
  if (kind == PrimitiveKind::polygon) return target_on_polygon(scene, row, random);
  if (kind == PrimitiveKind::disk) {
    const DiskShape& disk = scene.shapes().disks[row];
    const float share = random.below(2) == 0 ? 1.0F : random.uniform();
    return disk.center + share * disk.radius * across(disk.normal, random);
  }
  const PlaneShape& plane = scene.shapes().planes[row];
  return plane.point + any_size(random, -3, 5) * across(plane.normal, random);
}

// A corner, a point of an edge or any point of a triangle; a point of a sphere's surface or its middle; and
// the like of the other kinds.
inline Vec3 target_on(const Scene& scene, std::uint32_t primitive, Random& random) {
  if (scene.kind(primitive) > PrimitiveKind::sphere) return target_on_shape(scene, primitive, random);
  if (scene.kind(primitive) == PrimitiveKind::sphere) {
    const auto [center, radius] = reference::sphere_shape(scene, primitive - scene.triangle_count());
    return random.below(8) == 0 ? center : center + radius * random.direction();
  }
  const auto [a, b, c] = reference::triangle_vertices(scene, primitive);
  const Vec3 corners[3] = {a, b, c};
  const std::uint32_t first = random.below(3);
  const Vec3 from = corners[first];
  const Vec3 along = corners[(first + 1) % 3] - from;
  const Vec3 across = corners[(first + 2) % 3] - from;
  switch (random.below(3)) {
  case 0:
    return from;
  case 1:
    return from + random.uniform() * along;
  default:
    const float u = random.uniform();
    return from + u * along + (1 - u) * random.uniform() * across;
  }
}
// Any primitive of a prototype that has some.
inline std::uint32_t primitive_of(const Scene& scene, const Prototype& prototype, Random& random) {
  for (;;) {
    const std::uint32_t kind = random.below(5);
    const std::uint32_t count = prototype.end[kind] - prototype.begin[kind];
    if (count != 0)
      return scene.first_of(static_cast<PrimitiveKind>(kind)) + prototype.begin[kind] + random.below(count);
  }
}
inline const Prototype& prototype_of(const Scene& scene, std::uint32_t instance) {
  return scene.desc().prototypes[scene.desc().instances.prototype[instance]];
}
// On what an instance shows, or at a corner or a face of its box.
inline Vec3 target_on_instance(const Scene& scene, std::uint32_t instance, Random& random) {
  const Aabb& box = scene.shapes().instances[instance].box;
  if (box.empty()) return random.in_cube();
  if (random.below(4) == 0) {
    Vec3 target = box.center() + 0.5F * box.extent() * random.in_cube();
    const std::uint32_t faces = 1 + random.below(7);
    for (int axis = 0; axis < 3; ++axis)
      if ((faces >> axis & 1U) != 0) target[axis] = random.below(2) == 0 ? box.lower[axis] : box.upper[axis];
    return target;
  }
  return reference::map_point(
      scene.desc().instances.to_world[instance],
      target_on(scene, primitive_of(scene, prototype_of(scene, instance), random), random));
}
inline Vec3 target_on(const Scene& scene, Random& random) {
  if (scene.instance_count() != 0 && random.below(8) != 0)
    return target_on_instance(scene, random.below(scene.instance_count()), random);
  if (scene.primitive_count() == 0) return random.in_cube();
  return target_on(scene, random.below(scene.primitive_count()), random);
}

// Where rays start: around the scene, far away, inside, on it, at a corner of its box, in the plane of one of
// the box's faces.
inline Vec3 origin_at(const Scene& scene, Random& random) {
  const auto [center, radius] = extent_of(scene);
  switch (random.below(7)) {
  case 0:
    return center + radius * any_size(random, 0, 10) * random.direction();
  case 1:
    return center + 0.7F * radius * random.in_cube();
  case 2:
    return target_on(scene, random);
  case 3:
    return scene.bounds().empty() ? center : scene.bounds().lower;
  case 4: {
    Vec3 origin = center + 3.0F * radius * random.in_cube();
    const auto axis = static_cast<int>(random.below(3));
    if (!scene.bounds().empty()) origin[axis] = scene.bounds().upper[axis];
    return origin;
  }
  default:
    return center + 2.0F * radius * random.in_cube();
  }
}

inline Ray aimed(const Vec3& origin, const Vec3& target, Random& random) {
  Ray ray;
  ray.origin = origin;
  ray.direction = any_size(random, -5, 5) * (target - origin);
  return ray;
}

// In the plane of a triangle, or `height` above it at the ray's start.
inline Ray along_triangle(const Scene& scene, float height, Random& random) {
  if (scene.triangle_count() == 0) return aimed(origin_at(scene, random), target_on(scene, random), random);
  const std::uint32_t triangle = random.below(scene.triangle_count());
  const auto [a, b, c] = reference::triangle_vertices(scene, triangle);
  const Vec3 normal = glm::cross(b - a, c - a);
  const float length = glm::length(normal);
  const Vec3 rise = length > 0.0F ? (height * std::sqrt(length) / length) * normal : Vec3(0.0F);
  const Vec3 origin = a + random.uniform(-3, 3) * (b - a) + random.uniform(-3, 3) * (c - a) + rise;
  return aimed(origin, target_on(scene, triangle, random), random);
}

inline Ray axis_parallel(const Scene& scene, Random& random) {
  Ray ray;
  ray.direction = axis_direction(random);
  ray.origin = target_on(scene, random) - random.uniform(-1, 3) * extent_of(scene).radius * ray.direction;
  ray.direction *= any_size(random, -5, 5);
  return ray;
}

inline Ray any_ray(const Scene& scene, Random& random) {
  switch (random.below(8)) {
  case 0:
    return axis_parallel(scene, random);
  case 1:
    return along_triangle(scene, 0, random);
  case 2:
    return along_triangle(scene, any_size(random, -16, -2), random);
  case 3: { // a zero in the direction
    const Vec3 target = target_on(scene, random);
    Vec3 origin = origin_at(scene, random);
    const auto axis = static_cast<int>(random.below(3));
    origin[axis] = target[axis];
    return aimed(origin, target, random);
  }
  case 4: { // an interval around the target
    const Vec3 target = target_on(scene, random);
    Ray ray = aimed(origin_at(scene, random), target, random);
    ray.direction = target - ray.origin;
    ray.t_min = random.uniform(-1, 1);
    ray.t_max = ray.t_min + random.uniform(0, 1);
    return ray;
  }
  default:
    return aimed(origin_at(scene, random), target_on(scene, random), random);
  }
}

} // namespace fastrt::test
