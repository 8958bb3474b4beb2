// SPDX-License-Identifier: Apache-2.0
#include "src/scene/assert.hpp"
#include "src/scene/light_meshes.hpp"
#include "src/scene/scene_check.hpp"
#include "src/scene/shapes.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>
#include <fastrt/scene.hpp>

#include <algorithm>
#include <utility>

namespace fastrt {

namespace {

bool lets_light_through(const Material& material) {
  const Vec3& through = material.transmission;
  if (material.opacity_texture != no_texture) return through.x > 0.0F || through.y > 0.0F || through.z > 0.0F;
  const Vec3 transmit = (1.0F - material.opacity) * material.transmission;
  return transmit.x > 0.0F || transmit.y > 0.0F || transmit.z > 0.0F;
}

// Directions may have any length, but the square of it must be a number that floats hold well.
void tame_direction(Light& light) {
  const float length2 = glm::dot(light.direction, light.direction);
  if (length2 > 1e-30F && length2 < 1e30F) return;
  const Vec3 size = glm::abs(light.direction);
  light.direction /= std::max(size.x, std::max(size.y, size.z));
}

template <class... Columns>
std::size_t bytes_of(const Columns&... columns) {
  return (columns.bytes() + ... + 0);
}

// What a column of a primitive's kind holds for it. column_of: from the columns of a kind to the one.
template <class ColumnOf>
std::uint32_t row_of(const Scene& scene, std::uint32_t primitive, const ColumnOf& column_of) {
  FASTRT_ASSERT_LT(primitive, scene.primitive_count());
  const SceneDesc& desc = scene.desc();
  const PrimitiveKind kind = scene.kind(primitive);
  const std::uint32_t row = primitive - scene.first_of(kind);
  switch (kind) {
  case PrimitiveKind::triangle:
    return column_of(desc.triangles)[row];
  case PrimitiveKind::sphere:
    return column_of(desc.spheres)[row];
  case PrimitiveKind::cone:
    return column_of(desc.cones)[row];
  case PrimitiveKind::disk:
    return column_of(desc.disks)[row];
  case PrimitiveKind::polygon:
    return column_of(desc.polygons)[row];
  case PrimitiveKind::plane:
    break;
  }
  return column_of(desc.planes)[row];
}

std::size_t bytes_of(const Columns3& columns) { return bytes_of(columns.x, columns.y, columns.z); }

} // namespace

Scene::Scene(SceneDesc desc) : desc_(std::move(desc)) {
  check_scene(desc_);
  for (Light& light : desc_.lights)
    if (light.kind != LightKind::point && light.kind != LightKind::rectangle &&
        light.kind != LightKind::sphere && light.kind != LightKind::mesh)
      tame_direction(light);
  has_transmission_ = std::any_of(desc_.materials.begin(), desc_.materials.end(), lets_light_through);
  const std::size_t counts[primitive_kinds] = {desc_.triangles.size(), desc_.spheres.size(),
                                               desc_.cones.size(),     desc_.disks.size(),
                                               desc_.polygons.size(),  desc_.planes.size()};
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind)
    first_[kind + 1] = first_[kind] + static_cast<std::uint32_t>(counts[kind]);
  shapes_ = std::make_shared<const SceneShapes>(make_shapes(desc_));
  light_meshes_ = std::make_shared<const LightMeshes>(make_light_meshes(desc_));
  bounds_ = bounds_of(desc_);
}

std::uint32_t Scene::material_of(std::uint32_t primitive, std::int32_t instance) const noexcept {
  if (instance != no_instance) {
    const std::uint32_t own = desc_.instances.material[static_cast<std::size_t>(instance)];
    if (own != no_index) return own;
  }
  return row_of(
      *this, primitive, [](const auto& columns) -> const auto& { return columns.material; });
}

std::uint32_t Scene::object_of(std::uint32_t primitive, std::int32_t instance) const noexcept {
  if (instance != no_instance) {
    const std::uint32_t own = desc_.instances.object[static_cast<std::size_t>(instance)];
    if (own != no_index) return own;
  }
  return row_of(
      *this, primitive, [](const auto& columns) -> const auto& { return columns.object; });
}

Vec3 Scene::ambient() const noexcept {
  Vec3 sum = desc_.ambient.value_or(Vec3(0.0F));
  for (const Light& light : desc_.lights) sum = sum + light.ambient;
  return sum;
}

std::size_t Scene::bytes() const noexcept {
  const auto& [v0, v1, v2, n0, n1, n2, t0, t1, t2, material, object] = desc_.triangles;
  const SphereColumns& s = desc_.spheres;
  std::size_t images = 0;
  for (const Texture& texture : desc_.textures)
    if (texture.image != nullptr)
      images += texture.image->bytes().size() + sizeof(float) * texture.image->floats().size();
  const ConeColumns& c = desc_.cones;
  const DiskColumns& d = desc_.disks;
  const PolygonColumns& g = desc_.polygons;
  const PlaneColumns& p = desc_.planes;
  const InstanceColumns& i = desc_.instances;
  return images + bytes_of(desc_.colors) + bytes_of(desc_.positions) + bytes_of(desc_.normals) +
         bytes_of(desc_.uvs.x, desc_.uvs.y) + bytes_of(v0, v1, v2, n0, n1, n2, t0, t1, t2, material, object) +
         bytes_of(s.x, s.y, s.z, s.radius, s.material, s.object) + bytes_of(c.base) + bytes_of(c.apex) +
         bytes_of(c.base_radius, c.apex_radius, c.capped, c.material, c.object) + bytes_of(d.center) +
         bytes_of(d.normal) + bytes_of(d.radius, d.material, d.object) +
         bytes_of(g.vertex, g.vertex_end, g.contour_end, g.material, g.object) + bytes_of(p.point) +
         bytes_of(p.normal) + bytes_of(p.material, p.object) +
         bytes_of(i.prototype, i.to_world, i.material, i.object) +
         desc_.prototypes.capacity() * sizeof(Prototype) + shapes_->bytes() + light_meshes_->bytes();
}

} // namespace fastrt
