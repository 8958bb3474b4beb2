// SPDX-License-Identifier: Apache-2.0
#include "src/reference/surface.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/intersect.hpp"
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

} // namespace

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit) {
  Surface surface;
  const float length = std::sqrt(glm::dot(ray.direction, ray.direction));
  surface.incident = ray.direction * (1.0F / length);
  surface.to_viewer = -surface.incident;
  surface.distance = hit.t * length;

  const auto primitive = static_cast<std::uint32_t>(hit.primitive);
  surface.material = scene.material_of(primitive);
  if (scene.kind(primitive) == PrimitiveKind::triangle)
    fill_triangle(surface, scene, primitive, hit);
  else
    fill_sphere(surface, sphere_shape(scene, primitive - scene.triangle_count()), ray, hit.t);

  if (glm::dot(surface.geometric_normal, ray.direction) > 0.0F)
    surface.geometric_normal = -surface.geometric_normal;
  if (glm::dot(surface.shading_normal, surface.geometric_normal) < 0.0F)
    surface.shading_normal = -surface.shading_normal;
  surface.width = ray.width + ray.spread * surface.distance;
  if (has_textures(scene.materials()[surface.material])) apply_textures(scene, hit, surface);
  return surface;
}

} // namespace fastrt::reference
