// SPDX-License-Identifier: Apache-2.0
#include "src/scene/row_counts.hpp"

#include <fastrt/error.hpp>
#include <fastrt/scene.hpp>

#include <array>
#include <utility>

namespace fastrt {

namespace {

void check_count(std::size_t count, std::size_t vertex_count, const char* what) {
  if (count != 0 && count != vertex_count)
    throw InputError("a mesh has " + std::to_string(count) + ' ' + what + " for " +
                     std::to_string(vertex_count) + " vertices");
}

void check_indices(std::size_t vertex_count, std::span<const std::uint32_t> indices) {
  if (indices.size() % 3 != 0)
    throw InputError("a mesh has " + std::to_string(indices.size()) +
                     " indices, which is no multiple of three");
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] >= vertex_count)
      throw InputError("index " + std::to_string(i) + " of a mesh refers to vertex " +
                       std::to_string(indices[i]) + ", but there are " + std::to_string(vertex_count));
}

using IndexColumns = std::array<Column<std::uint32_t>*, 3>;

// Columns that are empty while no triangle has any: as long as the triangles so far, without indices.
void begin_columns(const IndexColumns& columns, std::size_t triangle_count) {
  for (auto* column : columns)
    if (column->empty()) column->resize(triangle_count, no_index);
}

// The mesh's own indices from `first` on, or none if it has no such values; nothing where no mesh has.
void append_optional(const IndexColumns& columns, std::size_t triangle_count, bool present,
                     std::uint32_t first, std::span<const std::uint32_t> indices) {
  if (present) begin_columns(columns, triangle_count);
  if (!present && columns[0]->empty()) return;
  for (std::size_t i = 0; i < indices.size(); ++i)
    columns[i % 3]->push_back(present ? first + indices[i] : no_index);
}

} // namespace

std::uint32_t SceneBuilder::add_material(Material material) {
  const std::uint32_t id = checked_size(desc_.materials.size(), "materials");
  desc_.materials.push_back(std::move(material));
  return id;
}

std::uint32_t SceneBuilder::add_texture(Texture texture) {
  const std::uint32_t id = checked_size(desc_.textures.size(), "textures");
  desc_.textures.push_back(std::move(texture));
  return id;
}

std::uint32_t SceneBuilder::add_mesh(std::span<const Vec3> positions, std::span<const std::uint32_t> indices,
                                     std::uint32_t material, std::span<const Vec3> normals, std::string name,
                                     std::span<const Vec2> uvs, std::span<const Vec3> colors) {
  check_count(normals.size(), positions.size(), "normals");
  check_count(uvs.size(), positions.size(), "texture coordinates");
  check_count(colors.size(), positions.size(), "colours");
  check_indices(positions.size(), indices);
  const std::uint32_t object = checked_size(desc_.object_names.size(), "objects");
  const std::uint32_t first_position = checked_size(desc_.positions.size(), "vertices");
  const std::uint32_t first_normal = checked_size(desc_.normals.size(), "normals");
  const std::uint32_t first_uv = checked_size(desc_.uvs.size(), "texture coordinates");
  checked_size(desc_.positions.size() + positions.size(), "vertices");

  desc_.object_names.push_back(std::move(name));
  for (const Vec3& position : positions) desc_.positions.push_back(position);
  for (const Vec3& normal : normals) desc_.normals.push_back(normal);
  for (const Vec2& uv : uvs) desc_.uvs.x.push_back(uv.x), desc_.uvs.y.push_back(uv.y);
  if (!colors.empty() || desc_.colors.size() != 0) {
    while (desc_.colors.size() < first_position) desc_.colors.push_back(Vec3(1.0F));
    for (const Vec3& color : colors) desc_.colors.push_back(color);
    while (desc_.colors.size() < desc_.positions.size()) desc_.colors.push_back(Vec3(1.0F));
  }
  TriangleColumns& triangles = desc_.triangles;
  const std::size_t before = triangles.size();
  append_optional({&triangles.n0, &triangles.n1, &triangles.n2}, before, !normals.empty(), first_normal,
                  indices);
  append_optional({&triangles.t0, &triangles.t1, &triangles.t2}, before, !uvs.empty(), first_uv, indices);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    triangles.v0.push_back(first_position + indices[i]);
    triangles.v1.push_back(first_position + indices[i + 1]);
    triangles.v2.push_back(first_position + indices[i + 2]);
    triangles.material.push_back(material);
    triangles.object.push_back(object);
  }
  return object;
}

std::uint32_t SceneBuilder::add_object(std::string name) {
  const std::uint32_t object = checked_size(desc_.object_names.size(), "objects");
  desc_.object_names.push_back(std::move(name));
  return object;
}

std::uint32_t SceneBuilder::add_sphere(const Vec3& center, float radius, std::uint32_t material,
                                       std::string name) {
  const std::uint32_t object = add_object(std::move(name));
  SphereColumns& spheres = desc_.spheres;
  spheres.x.push_back(center.x);
  spheres.y.push_back(center.y);
  spheres.z.push_back(center.z);
  spheres.radius.push_back(radius);
  spheres.material.push_back(material);
  spheres.object.push_back(object);
  return object;
}

std::uint32_t SceneBuilder::add_cone(const Vec3& base, float base_radius, const Vec3& apex, float apex_radius,
                                     std::uint32_t material, bool capped, std::string name) {
  const std::uint32_t object = add_object(std::move(name));
  ConeColumns& cones = desc_.cones;
  cones.base.push_back(base);
  cones.base_radius.push_back(base_radius);
  cones.apex.push_back(apex);
  cones.apex_radius.push_back(apex_radius);
  cones.capped.push_back(capped ? 1 : 0);
  cones.material.push_back(material);
  cones.object.push_back(object);
  return object;
}

std::uint32_t SceneBuilder::add_cylinder(const Vec3& base, const Vec3& apex, float radius,
                                         std::uint32_t material, bool capped, std::string name) {
  return add_cone(base, radius, apex, radius, material, capped, std::move(name));
}

std::uint32_t SceneBuilder::add_disk(const Vec3& center, const Vec3& normal, float radius,
                                     std::uint32_t material, std::string name) {
  const std::uint32_t object = add_object(std::move(name));
  DiskColumns& disks = desc_.disks;
  disks.center.push_back(center);
  disks.normal.push_back(normal);
  disks.radius.push_back(radius);
  disks.material.push_back(material);
  disks.object.push_back(object);
  return object;
}

std::uint32_t SceneBuilder::add_polygon(std::span<const std::vector<Vec3>> contours, std::uint32_t material,
                                        std::string name) {
  const std::uint32_t object = add_object(std::move(name));
  PolygonColumns& polygons = desc_.polygons;
  for (const std::vector<Vec3>& contour : contours) {
    for (const Vec3& position : contour) {
      polygons.vertex.push_back(checked_size(desc_.positions.size(), "vertices"));
      desc_.positions.push_back(position);
    }
    polygons.vertex_end.push_back(checked_size(polygons.vertex.size(), "vertices"));
  }
  if (desc_.colors.size() != 0)
    while (desc_.colors.size() < desc_.positions.size()) desc_.colors.push_back(Vec3(1.0F));
  polygons.contour_end.push_back(checked_size(polygons.vertex_end.size(), "contours"));
  polygons.material.push_back(material);
  polygons.object.push_back(object);
  return object;
}

std::uint32_t SceneBuilder::add_plane(const Vec3& point, const Vec3& normal, std::uint32_t material,
                                      std::string name) {
  if (open_) throw InputError("a plane has no end: it can't be part of a prototype");
  const std::uint32_t object = add_object(std::move(name));
  PlaneColumns& planes = desc_.planes;
  planes.point.push_back(point);
  planes.normal.push_back(normal);
  planes.material.push_back(material);
  planes.object.push_back(object);
  return object;
}

void SceneBuilder::begin_prototype() {
  if (open_) throw InputError("a prototype can't be part of another one");
  open_ = Prototype{checked_row_counts(desc_), {}};
}

std::uint32_t SceneBuilder::end_prototype() {
  if (!open_) throw InputError("a prototype ends that has not begun");
  const std::uint32_t id = checked_size(desc_.prototypes.size(), "prototypes");
  open_->end = checked_row_counts(desc_);
  desc_.prototypes.push_back(*open_);
  open_.reset();
  return id;
}

std::uint32_t SceneBuilder::add_instance(std::uint32_t prototype, const Affine& to_world,
                                         std::uint32_t material, std::string name) {
  if (open_) throw InputError("an instance can't be part of a prototype");
  const std::uint32_t object = add_object(std::move(name));
  InstanceColumns& instances = desc_.instances;
  instances.prototype.push_back(prototype);
  instances.to_world.push_back(to_world);
  instances.material.push_back(material);
  instances.object.push_back(object);
  return object;
}

Scene SceneBuilder::build() {
  if (open_) throw InputError("a prototype has not ended");
  return Scene(std::exchange(desc_, SceneDesc{}));
}

} // namespace fastrt
