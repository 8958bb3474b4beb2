// SPDX-License-Identifier: Apache-2.0
#include "src/reference/surface.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/instances.hpp"
#include "src/reference/textures.hpp"

namespace fastrt::reference {
namespace {

// The corners' normals weighed like the point, or `otherwise` where a corner has none or they cancel out.
Vec3 interpolated_normal(const Scene& scene, std::uint32_t triangle, const Vec3& weights,
                         const Vec3& otherwise) {
  const TriangleColumns& triangles = scene.triangles();
  if (triangles.n0.empty()) return otherwise;
  const std::uint32_t n0 = triangles.n0[triangle];
  const std::uint32_t n1 = triangles.n1[triangle];
  const std::uint32_t n2 = triangles.n2[triangle];
  if (n0 == no_index || n1 == no_index || n2 == no_index) return otherwise;
  const Columns3& normals = scene.normals();
  const Vec3 sum = (weights.x * normals[n0] + weights.y * normals[n1]) + weights.z * normals[n2];
  const float length_squared = glm::dot(sum, sum);
  if (!(0.0F < length_squared && length_squared < infinity)) return otherwise;
  return sum * (1.0F / std::sqrt(length_squared));
}

// Barycentric, not origin + t * direction: the error then follows the vertices and not the distance.
void fill_triangle(Surface& surface, const Scene& scene, std::uint32_t triangle, const Hit& hit) {
  const auto [a, b, c] = triangle_vertices(scene, triangle);
  const Vec3 weights{(1.0F - hit.u) - hit.v, hit.u, hit.v};
  surface.point = (weights.x * a + weights.y * b) + weights.z * c;
  const Vec3 normal = glm::cross(b - a, c - a);
  // Divided by its largest part first, so that its square neither overflows nor vanishes.
  surface.geometric_normal = glm::normalize(normal / largest_magnitude(normal));
  surface.shading_normal = interpolated_normal(scene, triangle, weights, surface.geometric_normal);
  surface.magnitude = max(largest_magnitude(a), max(largest_magnitude(b), largest_magnitude(c)));
  surface.planar = hit.primitive;
}

// Lecture notes, 11.6: the normal of f(p) = |p - c|^2 - r^2 is along its gradient. The point is put onto the
// sphere along it.
void fill_sphere(Surface& surface, const SphereShape& sphere, const Ray& ray, float t) {
  const Vec3 f = ray.origin - sphere.center;
  surface.geometric_normal = glm::normalize(f + t * ray.direction);
  surface.shading_normal = surface.geometric_normal;
  surface.point = sphere.center + sphere.radius * surface.geometric_normal;
  surface.magnitude = largest_magnitude(sphere.center) + sphere.radius;
}

float magnitude_of(const Aabb& box) {
  return max(largest_magnitude(box.lower), largest_magnitude(box.upper));
}

// The point is put onto the mantle, or onto the disc at an end where that is closer.
void fill_cone(Surface& surface, const ConeShape& cone, const Ray& ray, float t) {
  const Vec3& u = cone.axis;
  const Vec3 q = (ray.origin - cone.center) + t * ray.direction;
  const float z = glm::dot(q, u);
  const Vec3 g = q - z * u;
  const float distance = std::sqrt(glm::dot(g, g));
  const float height = min(max(z, -cone.half_height), cone.half_height);
  const float radius = cone.radius + cone.slope * height;
  const bool on_cap =
      cone.capped && std::fabs(cone.half_height - std::fabs(z)) < std::fabs(distance - radius);
  if (on_cap) {
    surface.geometric_normal = u;
    surface.point = cone.center + (std::copysign(cone.half_height, z) * u + g);
  } else {
    const Vec3 outward = g * (distance > 0.0F ? 1.0F / distance : 0.0F);
    surface.geometric_normal = glm::normalize(outward - cone.slope * u);
    surface.point = cone.center + (height * u + radius * outward);
  }
  surface.shading_normal = surface.geometric_normal;
  surface.magnitude = magnitude_of(cone.box);
}

// The point is put into the plane.
void fill_flat(Surface& surface, const Vec3& point, const Vec3& normal, const Ray& ray, const Hit& hit) {
  const Vec3 q = ray.origin + hit.t * ray.direction;
  surface.point = q - glm::dot(q - point, normal) * normal;
  surface.geometric_normal = normal;
  surface.shading_normal = normal;
  surface.planar = hit.primitive;
}

void fill_shape(Surface& surface, const Scene& scene, const Ray& ray, const Hit& hit) {
  const auto primitive = static_cast<std::uint32_t>(hit.primitive);
  const PrimitiveKind kind = scene.kind(primitive);
  const std::uint32_t row = primitive - scene.first_of(kind);
  const SceneShapes& shapes = scene.shapes();
  if (kind == PrimitiveKind::cone) {
    fill_cone(surface, shapes.cones[row], ray, hit.t);
  } else if (kind == PrimitiveKind::disk) {
    const DiskShape& disk = shapes.disks[row];
    fill_flat(surface, disk.center, disk.normal, ray, hit);
    surface.magnitude = magnitude_of(disk.box);
  } else if (kind == PrimitiveKind::polygon) {
    const PolygonShape& polygon = shapes.polygons[row];
    fill_flat(surface, polygon.point, polygon.normal, ray, hit);
    surface.magnitude = magnitude_of(polygon.box);
  } else {
    const PlaneShape& plane = shapes.planes[row];
    fill_flat(surface, plane.point, plane.normal, ray, hit);
    surface.magnitude = max(largest_magnitude(plane.point), largest_magnitude(surface.point));
  }
}

// From object space to the world.
void place_in_world(Surface& surface, const Scene& scene, const Hit& hit) {
  const auto instance = static_cast<std::size_t>(hit.instance);
  const Affine& map = scene.desc().instances.to_world[instance];
  const InstanceShape& shape = scene.shapes().instances[instance];
  surface.point = map_point(map, surface.point);
  surface.geometric_normal = map_normal(shape.to_object, surface.geometric_normal);
  surface.shading_normal = map_normal(shape.to_object, surface.shading_normal);
  surface.magnitude = map_magnitude(map, surface.magnitude) * shape.growth;
  surface.growth = shape.growth;
  surface.instance = hit.instance;
}

} // namespace

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit) {
  Surface surface;
  const float length = std::sqrt(glm::dot(ray.direction, ray.direction));
  surface.incident = ray.direction * (1.0F / length);
  surface.to_viewer = -surface.incident;
  surface.distance = hit.t * length;

  const auto primitive = static_cast<std::uint32_t>(hit.primitive);
  surface.material = scene.material_of(primitive, hit.instance);
  const Ray inner = object_ray(scene, ray, hit);
  if (scene.kind(primitive) == PrimitiveKind::triangle)
    fill_triangle(surface, scene, primitive, hit);
  else if (scene.kind(primitive) == PrimitiveKind::sphere)
    fill_sphere(surface, sphere_shape(scene, primitive - scene.triangle_count()), inner, hit.t);
  else
    fill_shape(surface, scene, inner, hit);
  if (hit.instance != no_instance) place_in_world(surface, scene, hit);

  if (glm::dot(surface.geometric_normal, ray.direction) > 0.0F)
    surface.geometric_normal = -surface.geometric_normal;
  if (glm::dot(surface.shading_normal, surface.geometric_normal) < 0.0F)
    surface.shading_normal = -surface.shading_normal;
  surface.width = ray.width + ray.spread * surface.distance;
  if (has_textures(scene.materials()[surface.material])) apply_textures(scene, hit, surface);
  return surface;
}

} // namespace fastrt::reference
