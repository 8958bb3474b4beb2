// SPDX-License-Identifier: Apache-2.0
#include "src/scene/light_meshes.hpp"
#include "src/scene/light_numbers.hpp"
#include "src/trace/tracer_parts.hpp"

namespace fastrt {
namespace {

static_assert(no_row == no_index);
static_assert(fresnel_schlick == static_cast<std::uint32_t>(Fresnel::schlick));
static_assert(fresnel_dielectric == static_cast<std::uint32_t>(Fresnel::dielectric));

bool any_not_zero(const Vec3& v) { return v.x != 0.0F || v.y != 0.0F || v.z != 0.0F; }
bool any_positive(const Vec3& v) { return v.x > 0.0F || v.y > 0.0F || v.z > 0.0F; }

MaterialRow row_of(const Material& material) {
  MaterialRow row{};
  const Vec3 transmit = (1.0F - material.opacity) * material.transmission;
  copy(material.ambient, row.ambient);
  copy(material.diffuse, row.diffuse);
  copy(material.specular, row.specular);
  copy(material.emission, row.emission);
  copy(material.mirror, row.mirror);
  copy(transmit, row.transmit);
  copy(material.absorption, row.absorption);
  row.shininess = material.shininess;
  row.opacity = material.opacity;
  row.ior = material.ior;
  row.blinn = material.specular_model == SpecularModel::blinn;
  row.fresnel = static_cast<std::uint32_t>(material.fresnel);
  row.thin = material.thin;
  row.unlit = material.unlit;
  row.has_specular = any_not_zero(material.specular);
  row.has_mirror = any_not_zero(material.mirror) || material.fresnel == Fresnel::schlick;
  row.has_transmit = any_positive(transmit);
  row.has_absorption = any_not_zero(material.absorption);
  copy(material.transmission, row.transmission);
  if (material.opacity_texture != no_texture) row.has_transmit = any_positive(material.transmission);
  row.passes_light = row.has_transmit;
  if (row.has_transmit == 0) row.transmit[0] = row.transmit[1] = row.transmit[2] = 0.0F;
  return row;
}

EmitterRow row_of(const EmitterTriangle& triangle) {
  EmitterRow row{};
  const Vec3* const corners[] = {&triangle.a, &triangle.b, &triangle.c};
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) row.corners[i][axis] = (*corners[i])[axis];
    row.normal[axis] = triangle.normal[axis];
  }
  return row;
}

void fill_mesh(const LightMesh& mesh, const EmitterRow* emitters, LightRow& row) {
  copy(mesh.middle, row.position);
  copy(mesh.radiance, row.intensity);
  row.largest_coordinate = mesh.magnitude;
  row.area_over_pi = mesh.area_over_pi;
  row.emitters = emitters;
  row.emitter_begin = mesh.begin.data();
  row.emitter_scale = mesh.scale.data();
  row.emitter_count = static_cast<std::uint32_t>(mesh.triangles.size());
}

// The numbers of a light that is no mesh.
LightRow row_of(const Light& light) {
  LightRow row{};
  copy(light.position, row.position);
  copy(light.intensity, row.intensity);
  row.directional = light.kind == LightKind::directional;
  if (row.directional != 0) copy(glm::normalize(-light.direction), row.to_light);
  row.largest_coordinate = light_magnitude(light);
  row.constant = light.constant;
  row.linear = light.linear;
  row.quadratic = light.quadratic;
  row.spot = light.kind == LightKind::spot;
  if (row.spot != 0) {
    const SpotCone cone = spot_cone(light);
    copy(cone.axis, row.axis);
    row.rim = cone.rim;
    row.inverse_width = cone.inverse_width;
    row.exponent = light.exponent;
  }
  const LightAxes axes = light_axes(light);
  copy(axes.u, row.half_axes[0]);
  copy(axes.v, row.half_axes[1]);
  copy(axes.w, row.half_axes[2]);
  row.shape = static_cast<std::uint32_t>(shape_of(light));
  row.varies = row.spot != 0 || row.shape != 0 || fades(light);
  row.casts_shadows = light.casts_shadows;
  return row;
}

} // namespace

std::vector<MaterialRow> material_rows(const Scene& scene, const TextureRows& textures) {
  check_row_count<MaterialRow>(scene.materials().size(), "materials");
  std::vector<MaterialRow> rows;
  rows.reserve(scene.materials().size());
  for (const Material& material : scene.materials()) rows.push_back(row_of(material));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const SurfaceTextures& t = textures.materials[i];
    const bool any = t.ambient != nullptr || t.diffuse != nullptr || t.specular != nullptr ||
                     t.emission != nullptr || t.opacity != nullptr || t.bump != nullptr ||
                     t.vertex_colors != 0;
    if (any) rows[i].textures = &t;
  }
  return rows;
}

std::vector<LightRow> light_rows(const Scene& scene, std::vector<EmitterRow>& emitters) {
  const std::vector<LightMesh>& meshes = scene.light_meshes().lights;
  for (const LightMesh& mesh : meshes)
    for (const EmitterTriangle& triangle : mesh.triangles) emitters.push_back(row_of(triangle));
  std::vector<LightRow> rows;
  rows.reserve(scene.lights().size());
  const EmitterRow* next = emitters.data();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    rows.push_back(row_of(scene.lights()[i]));
    if (!meshes[i].triangles.empty()) fill_mesh(meshes[i], next, rows.back());
    next += meshes[i].triangles.size();
  }
  return rows;
}

} // namespace fastrt
