// SPDX-License-Identifier: Apache-2.0
#include "src/scene/scene_check.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>
#include <fastrt/scene.hpp>

#include <algorithm>
#include <cmath>
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

} // namespace

Scene::Scene(SceneDesc desc) : desc_(std::move(desc)) {
  check_scene(desc_);
  for (Light& light : desc_.lights)
    if (light.kind == LightKind::directional) tame_direction(light);
  has_transmission_ = std::any_of(desc_.materials.begin(), desc_.materials.end(), lets_light_through);
  bounds_ = bounds_of(desc_);
}

std::uint32_t Scene::material_of(std::uint32_t primitive) const noexcept {
  FASTRT_ASSERT_LT(primitive, primitive_count());
  const std::uint32_t triangles = triangle_count();
  return primitive < triangles ? desc_.triangles.material[primitive]
                               : desc_.spheres.material[primitive - triangles];
}

std::uint32_t Scene::object_of(std::uint32_t primitive) const noexcept {
  FASTRT_ASSERT_LT(primitive, primitive_count());
  const std::uint32_t triangles = triangle_count();
  return primitive < triangles ? desc_.triangles.object[primitive]
                               : desc_.spheres.object[primitive - triangles];
}

std::size_t Scene::bytes() const noexcept {
  const auto& [v0, v1, v2, n0, n1, n2, t0, t1, t2, material, object] = desc_.triangles;
  const SphereColumns& s = desc_.spheres;
  const Columns3 &p = desc_.positions, &n = desc_.normals;
  std::size_t images = 0;
  for (const Texture& texture : desc_.textures)
    if (texture.image != nullptr)
      images += texture.image->bytes().size() + sizeof(float) * texture.image->floats().size();
  const Columns3& c = desc_.colors;
  return images + bytes_of(c.x, c.y, c.z) + bytes_of(p.x, p.y, p.z, n.x, n.y, n.z, desc_.uvs.x, desc_.uvs.y) +
         bytes_of(v0, v1, v2, n0, n1, n2, t0, t1, t2, material, object) +
         bytes_of(s.x, s.y, s.z, s.radius, s.material, s.object);
}

} // namespace fastrt
