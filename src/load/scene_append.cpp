// SPDX-License-Identifier: Apache-2.0
#include "src/load/scene_append.hpp"

#include "src/scene/row_counts.hpp"

#include <utility>

namespace fastrt {
namespace {

using Indices = Column<std::uint32_t>;

// Where the rows of `from` will begin.
struct Shifts {
  std::uint32_t position, normal, uv, material, texture, object;
};

void append(Columns3& to, const Columns3& from) {
  to.x.append(from.x.data(), from.size());
  to.y.append(from.y.data(), from.size());
  to.z.append(from.z.data(), from.size());
}

void append(Column<float>& to, const Column<float>& from) { to.append(from.data(), from.size()); }

void append(Indices& to, const Indices& from, std::uint32_t shift) {
  const std::size_t before = to.size();
  to.append(from.data(), from.size());
  for (std::size_t i = before; i < to.size(); ++i)
    if (to[i] != no_index) to[i] += shift;
}

template <class Columns>
void append_owners(Columns& to, const Columns& from, const Shifts& shifts) {
  append(to.material, from.material, shifts.material);
  append(to.object, from.object, shifts.object);
}

void pad(Indices& column, std::size_t size) {
  if (column.size() < size) column.extend(size, no_index);
}

void append_triangles(SceneDesc& to, const SceneDesc& from, const Shifts& shifts) {
  TriangleColumns& t = to.triangles;
  const TriangleColumns& f = from.triangles;
  if (!f.n0.empty()) pad_normals(to);
  if (!f.t0.empty()) pad_uvs(to);
  append(t.v0, f.v0, shifts.position);
  append(t.v1, f.v1, shifts.position);
  append(t.v2, f.v2, shifts.position);
  append(t.n0, f.n0, shifts.normal);
  append(t.n1, f.n1, shifts.normal);
  append(t.n2, f.n2, shifts.normal);
  append(t.t0, f.t0, shifts.uv);
  append(t.t1, f.t1, shifts.uv);
  append(t.t2, f.t2, shifts.uv);
  append_owners(t, f, shifts);
  if (!t.n0.empty()) pad_normals(to);
  if (!t.t0.empty()) pad_uvs(to);
}

void append_shapes(SceneDesc& to, const SceneDesc& from, const Shifts& shifts) {
  append(to.spheres.x, from.spheres.x);
  append(to.spheres.y, from.spheres.y);
  append(to.spheres.z, from.spheres.z);
  append(to.spheres.radius, from.spheres.radius);
  append_owners(to.spheres, from.spheres, shifts);
  append(to.cones.base, from.cones.base);
  append(to.cones.apex, from.cones.apex);
  append(to.cones.base_radius, from.cones.base_radius);
  append(to.cones.apex_radius, from.cones.apex_radius);
  append(to.cones.capped, from.cones.capped, 0);
  append_owners(to.cones, from.cones, shifts);
  append(to.disks.center, from.disks.center);
  append(to.disks.normal, from.disks.normal);
  append(to.disks.radius, from.disks.radius);
  append_owners(to.disks, from.disks, shifts);
}

void append_polygons(PolygonColumns& to, const PolygonColumns& from, const Shifts& shifts) {
  const auto vertices = static_cast<std::uint32_t>(to.vertex.size());
  const auto contours = static_cast<std::uint32_t>(to.vertex_end.size());
  checked_size(to.vertex.size() + from.vertex.size(), "vertices");
  append(to.vertex, from.vertex, shifts.position);
  append(to.vertex_end, from.vertex_end, vertices);
  append(to.contour_end, from.contour_end, contours);
  append_owners(to, from, shifts);
}

void append_materials(SceneDesc& to, SceneDesc& from, const Shifts& shifts) {
  for (Texture& texture : from.textures) to.textures.push_back(std::move(texture));
  for (Material& material : from.materials) {
    for (std::uint32_t* const slot : texture_slots(material))
      if (*slot != no_texture) *slot += shifts.texture;
    to.materials.push_back(std::move(material));
  }
}

} // namespace

std::array<std::uint32_t*, 6> texture_slots(Material& material) {
  return {&material.ambient_texture,  &material.diffuse_texture, &material.specular_texture,
          &material.emission_texture, &material.opacity_texture, &material.bump_texture};
}

void pad_normals(SceneDesc& desc) {
  for (auto* column : {&desc.triangles.n0, &desc.triangles.n1, &desc.triangles.n2})
    pad(*column, desc.triangles.size());
}

void pad_uvs(SceneDesc& desc) {
  for (auto* column : {&desc.triangles.t0, &desc.triangles.t1, &desc.triangles.t2})
    pad(*column, desc.triangles.size());
}

void pad_colors(SceneDesc& desc) {
  Columns3& colors = desc.colors;
  for (auto* column : {&colors.x, &colors.y, &colors.z})
    if (column->size() < desc.positions.size()) column->extend(desc.positions.size(), 1.0F);
}

void append_scene(SceneDesc& to, SceneDesc from) {
  const Shifts shifts{
      checked_size(to.positions.size(), "vertices"),      checked_size(to.normals.size(), "normals"),
      checked_size(to.uvs.size(), "texture coordinates"), checked_size(to.materials.size(), "materials"),
      checked_size(to.textures.size(), "textures"),       checked_size(to.object_names.size(), "objects")};
  checked_size(to.positions.size() + from.positions.size(), "vertices");
  checked_size(to.normals.size() + from.normals.size(), "normals");
  checked_size(to.uvs.size() + from.uvs.size(), "texture coordinates");
  checked_size(to.triangles.size() + from.triangles.size(), "triangles");
  const bool has_colors = from.colors.size() != 0;
  if (has_colors) pad_colors(to);
  append(to.positions, from.positions);
  if (has_colors) append(to.colors, from.colors);
  if (to.colors.size() != 0) pad_colors(to);
  append(to.normals, from.normals);
  append(to.uvs.x, from.uvs.x);
  append(to.uvs.y, from.uvs.y);
  append_triangles(to, from, shifts);
  append_shapes(to, from, shifts);
  append_polygons(to.polygons, from.polygons, shifts);
  append_materials(to, from, shifts);
  for (std::string& name : from.object_names) to.object_names.push_back(std::move(name));
}

} // namespace fastrt
