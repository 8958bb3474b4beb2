// SPDX-License-Identifier: Apache-2.0
#include <fastrt/error.hpp>
#include <fastrt/scene.hpp>

#include <utility>

namespace fastrt {

namespace {

std::uint32_t checked_id(std::size_t id, const char* what) {
  if (id >= no_index) throw LimitError(std::string("too many ") + what);
  return static_cast<std::uint32_t>(id);
}

void check_mesh(std::size_t vertex_count, std::span<const std::uint32_t> indices, std::size_t normal_count) {
  if (indices.size() % 3 != 0)
    throw InputError("a mesh has " + std::to_string(indices.size()) +
                     " indices, which is no multiple of three");
  if (normal_count != 0 && normal_count != vertex_count)
    throw InputError("a mesh has " + std::to_string(normal_count) + " normals for " +
                     std::to_string(vertex_count) + " vertices");
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] >= vertex_count)
      throw InputError("index " + std::to_string(i) + " of a mesh refers to vertex " +
                       std::to_string(indices[i]) + ", but there are " + std::to_string(vertex_count));
}

// The n columns of triangles made so far: as long as v0, without normals.
void begin_normals(TriangleColumns& triangles, std::size_t count) {
  for (auto* column : {&triangles.n0, &triangles.n1, &triangles.n2}) column->resize(count, no_index);
}

} // namespace

std::uint32_t SceneBuilder::add_material(Material material) {
  const std::uint32_t id = checked_id(desc_.materials.size(), "materials");
  desc_.materials.push_back(std::move(material));
  return id;
}

std::uint32_t SceneBuilder::add_mesh(std::span<const Vec3> positions, std::span<const std::uint32_t> indices,
                                     std::uint32_t material, std::span<const Vec3> normals,
                                     std::string name) {
  check_mesh(positions.size(), indices, normals.size());
  const std::uint32_t object = checked_id(desc_.object_names.size(), "objects");
  const std::uint32_t first_position = checked_id(desc_.positions.size(), "vertices");
  const std::uint32_t first_normal = checked_id(desc_.normals.size(), "normals");
  checked_id(desc_.positions.size() + positions.size(), "vertices");

  desc_.object_names.push_back(std::move(name));
  for (const Vec3& position : positions) desc_.positions.push_back(position);
  for (const Vec3& normal : normals) desc_.normals.push_back(normal);
  TriangleColumns& triangles = desc_.triangles;
  if (!normals.empty() && triangles.n0.empty()) begin_normals(triangles, triangles.size());
  const bool has_normal_columns = !normals.empty() || !triangles.n0.empty();
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    triangles.v0.push_back(first_position + indices[i]);
    triangles.v1.push_back(first_position + indices[i + 1]);
    triangles.v2.push_back(first_position + indices[i + 2]);
    triangles.material.push_back(material);
    triangles.object.push_back(object);
    if (!has_normal_columns) continue;
    triangles.n0.push_back(normals.empty() ? no_index : first_normal + indices[i]);
    triangles.n1.push_back(normals.empty() ? no_index : first_normal + indices[i + 1]);
    triangles.n2.push_back(normals.empty() ? no_index : first_normal + indices[i + 2]);
  }
  return object;
}

std::uint32_t SceneBuilder::add_sphere(const Vec3& center, float radius, std::uint32_t material,
                                       std::string name) {
  const std::uint32_t object = checked_id(desc_.object_names.size(), "objects");
  desc_.object_names.push_back(std::move(name));
  SphereColumns& spheres = desc_.spheres;
  spheres.x.push_back(center.x);
  spheres.y.push_back(center.y);
  spheres.z.push_back(center.z);
  spheres.radius.push_back(radius);
  spheres.material.push_back(material);
  spheres.object.push_back(object);
  return object;
}

Scene SceneBuilder::build() { return Scene(std::exchange(desc_, SceneDesc{})); }

} // namespace fastrt
