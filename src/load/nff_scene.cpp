// SPDX-License-Identifier: Apache-2.0
#include "src/load/nff_scene.hpp"

#include "src/scene/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastrt {
// Opacity weakens all that the surface itself sends; the highlight is to keep its strength.
Material nff_material(const NffFill& fill) {
  const float opacity = std::max(1.0F - fill.transmittance, 0.0F);
  Material material;
  material.diffuse = fill.diffuse * fill.color;
  material.ambient = material.diffuse;
  material.specular = Vec3(opacity > 0.0F ? fill.specular / opacity : 0.0F);
  material.specular_model = SpecularModel::phong;
  material.shininess = std::max(fill.shine, 1.0F);
  material.mirror = Vec3(fill.specular);
  material.opacity = opacity;
  material.transmission = fill.color;
  material.ior = fill.ior > 0.0F ? fill.ior : 1.0F;
  return material;
}

void NffScene::set_fill(const NffFill& fill) {
  const std::array<float, 8> numbers = {fill.color.x,  fill.color.y, fill.color.z,       fill.diffuse,
                                        fill.specular, fill.shine,   fill.transmittance, fill.ior};
  const auto next = static_cast<std::uint32_t>(desc_.materials.size());
  const std::uint32_t known = fills_.try_emplace(numbers, next).first->second;
  // Bodies of glass are told apart by their materials, so each keeps its own.
  material_ = fill.transmittance > 0.0F ? next : known;
  if (material_ == next) {
    desc_.materials.push_back(nff_material(fill));
    desc_.materials.back().name = "f" + std::to_string(desc_.materials.size());
  }
  desc_.object_names.push_back("f" + std::to_string(desc_.object_names.size() + 1));
}

void NffScene::set_view(const Camera& camera, int width, int height) {
  desc_.camera = camera;
  desc_.width = width;
  desc_.height = height;
}

void NffScene::push_light(const Vec3& position) {
  Light light;
  light.position = position;
  desc_.lights.push_back(light);
}

void NffScene::add_light(const Vec3& position, const Vec3& color) {
  push_light(position);
  desc_.lights.back().intensity = color;
}

bool NffScene::add_sphere(const Vec3& center, float radius) {
  if (radius == 0.0F) return false;
  SphereColumns& spheres = desc_.spheres;
  spheres.x.push_back(center.x);
  spheres.y.push_back(center.y);
  spheres.z.push_back(center.z);
  spheres.radius.push_back(std::fabs(radius));
  spheres.material.push_back(material_);
  spheres.object.push_back(static_cast<std::uint32_t>(desc_.object_names.size() - 1));
  return true;
}

bool NffScene::add_cone(const Vec3& base, float base_radius, const Vec3& apex, float apex_radius) {
  if (base == apex || (base_radius == 0.0F && apex_radius == 0.0F)) return false;
  ConeColumns& cones = desc_.cones;
  cones.base.push_back(base);
  cones.base_radius.push_back(std::fabs(base_radius));
  cones.apex.push_back(apex);
  cones.apex_radius.push_back(std::fabs(apex_radius));
  cones.capped.push_back(0);
  cones.material.push_back(material_);
  cones.object.push_back(static_cast<std::uint32_t>(desc_.object_names.size() - 1));
  return true;
}

std::uint32_t NffScene::push_positions(std::span<const Vec3> vertices) {
  const auto first = static_cast<std::uint32_t>(desc_.positions.size());
  for (const Vec3& vertex : vertices) desc_.positions.push_back(vertex);
  return first;
}

// The vertices begin at position `first`. A normal of 0 is none.
void NffScene::push_triangles(std::span<const Vec3> vertices, std::uint32_t first,
                              std::span<const Vec3> normals) {
  if (vertices.size() == 3)
    triangles_.assign(1, {0, 1, 2});
  else
    triangulator_.run(vertices, triangles_);
  const auto first_normal = static_cast<std::uint32_t>(desc_.normals.size());
  for (const Vec3& normal : normals) desc_.normals.push_back(normal);
  has_normals_ = has_normals_ || !normals.empty();
  const auto normal_of = [&](std::uint32_t corner) {
    return normals.empty() || normals[corner] == Vec3(0.0F) ? no_index : first_normal + corner;
  };
  TriangleColumns& t = desc_.triangles;
  for (const auto& [a, b, c] : triangles_) {
    const TriangleFault fault = fault_of_triangle(vertices[a], vertices[b], vertices[c]);
    if (fault != TriangleFault::none) {
      faults_.push_back(fault);
      continue;
    }
    t.v0.push_back(first + a);
    t.v1.push_back(first + b);
    t.v2.push_back(first + c);
    t.n0.push_back(normal_of(a));
    t.n1.push_back(normal_of(b));
    t.n2.push_back(normal_of(c));
    t.material.push_back(material_);
    t.object.push_back(static_cast<std::uint32_t>(desc_.object_names.size() - 1));
  }
}

NffScene::Found NffScene::add_polygon(std::span<const Vec3> vertices) {
  faults_.clear();
  const std::uint32_t first = push_positions(vertices);
  if (vertices.size() == 3) {
    const glm::dvec3 a(vertices[0]), b(vertices[1]), c(vertices[2]);
    if (!(glm::length(glm::cross(b - a, c - a)) > 0.0)) return Found::empty;
    push_triangles(vertices, first, {});
    return Found::good;
  }
  PolygonColumns& p = desc_.polygons;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) p.vertex.push_back(first + i);
  p.vertex_end.push_back(static_cast<std::uint32_t>(p.vertex.size()));
  p.contour_end.push_back(static_cast<std::uint32_t>(p.vertex_end.size()));
  const std::size_t row = p.contour_end.size() - 1;
  const PolygonPlane plane = plane_of(desc_, row);
  if (plane.usable && is_flat(desc_, row, plane)) {
    p.material.push_back(material_);
    p.object.push_back(static_cast<std::uint32_t>(desc_.object_names.size() - 1));
    return Found::good;
  }
  p.contour_end.resize(p.contour_end.size() - 1);
  p.vertex_end.resize(p.vertex_end.size() - 1);
  p.vertex.resize(p.vertex.size() - vertices.size());
  if (!plane.usable) return Found::empty;
  if (vertices.size() > max_face_corners) return Found::too_long;
  push_triangles(vertices, first, {});
  return Found::bent;
}

NffScene::Found NffScene::add_patch(std::span<const Vec3> vertices, std::span<const Vec3> normals) {
  faults_.clear();
  push_triangles(vertices, push_positions(vertices), normals);
  return Found::good;
}

SceneDesc NffScene::finish() {
  // Together as bright as the root of their number: more lights give more light, but do not wash out.
  const auto count = static_cast<float>(desc_.lights.size());
  for (const std::size_t light : dim_lights_) desc_.lights[light].intensity = Vec3(std::sqrt(count) / count);
  if (!has_normals_)
    for (auto* column : {&desc_.triangles.n0, &desc_.triangles.n1, &desc_.triangles.n2}) column->clear();
  return std::move(desc_);
}

} // namespace fastrt
