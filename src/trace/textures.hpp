// SPDX-License-Identifier: Apache-2.0
// What textures make of the surfaces of a batch: the material's terms at each point, and the shading normal
// that a bump map turns (docs/numerics.md, "Textures").
#pragma once

#include "src/trace/shape_weights.hpp"
#include "src/trace/texture_lookup.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

using Row3 = V3<float>;

FASTRT_INLINE Row3 row3(const float* x, const float* y, const float* z, std::uint32_t i) {
  return {x[i], y[i], z[i]};
}

// One hit of a ray. Triangles alone have weights, coordinates and edges.
struct HitSite {
  TextureSite at;
  float w, u, v;
  std::uint32_t corner[3];
  float du1, dv1, du2, dv2; // (u, v) along the edges from A to B and to C
  Row3 edge1, edge2;
  bool is_triangle, has_uv;
};

// Hit i of the batch. point: the surface's, or null for origin + t * dir.
static HitSite find_site(const ShadingView& scene, const RayBatch& rays, const HitBatch& hits, int i,
                         const Row3* point) noexcept {
  HitSite site{};
  const float t = hits.t[i];
  const std::int32_t primitive = shown_primitive(scene.shapes, hits, i);
  const InstanceRow* const instance = instance_of(scene.shapes, hits.primitive[i]);
  Row3 origin = row3(rays.origin_x, rays.origin_y, rays.origin_z, static_cast<std::uint32_t>(i));
  Row3 dir = row3(rays.dir_x, rays.dir_y, rays.dir_z, static_cast<std::uint32_t>(i));
  const Row3 p = point != nullptr ? *point : origin + dir * t;
  if (instance != nullptr) {
    origin = map_point(instance->to_object, origin);
    dir = map_vector(instance->to_object, dir);
  }
  site.at.point[0] = p.x;
  site.at.point[1] = p.y;
  site.at.point[2] = p.z;
  const auto id = static_cast<std::uint32_t>(primitive);
  site.is_triangle = id < scene.triangle_count;
  if (!site.is_triangle) {
    const ShapeWeights weights = shape_weights(scene, primitive, origin, dir, t);
    site.at.u = weights.u;
    site.at.v = weights.v;
    return site;
  }
  const std::uint32_t corner[3] = {scene.v0[id], scene.v1[id], scene.v2[id]};
  Row3 vertex[3];
  V3<Rgba> relative[3];
  for (int k = 0; k < 3; ++k) {
    site.corner[k] = corner[k];
    vertex[k] = row3(scene.position_x, scene.position_y, scene.position_z, corner[k]);
    const Row3 r = vertex[k] - origin;
    relative[k] = broadcast3<Rgba>(r.x, r.y, r.z);
  }
  const auto weights = triangle_weights(set_up_triangle(relative[0], relative[1], relative[2]),
                                        broadcast3<Rgba>(dir.x, dir.y, dir.z));
  site.u = weights.u.get(0);
  site.v = weights.v.get(0);
  site.w = (1.0F - site.u) - site.v;
  if (scene.t0 == nullptr) return site;
  const std::uint32_t uv[3] = {scene.t0[id], scene.t1[id], scene.t2[id]};
  if (uv[0] == 0xFFFFFFFFU || uv[1] == 0xFFFFFFFFU || uv[2] == 0xFFFFFFFFU) return site;
  const float *tu = scene.uv_x, *tv = scene.uv_y;
  site.has_uv = true;
  site.at.u = (site.w * tu[uv[0]] + site.u * tu[uv[1]]) + site.v * tu[uv[2]];
  site.at.v = (site.w * tv[uv[0]] + site.u * tv[uv[1]]) + site.v * tv[uv[2]];
  site.du1 = tu[uv[1]] - tu[uv[0]];
  site.dv1 = tv[uv[1]] - tv[uv[0]];
  site.du2 = tu[uv[2]] - tu[uv[0]];
  site.dv2 = tv[uv[2]] - tv[uv[0]];
  site.edge1 = vertex[1] - vertex[0];
  site.edge2 = vertex[2] - vertex[0];
  if (instance != nullptr) {
    site.edge1 = map_vector(instance->to_world, site.edge1);
    site.edge2 = map_vector(instance->to_world, site.edge2);
  }
  const Row3 normal = cross(site.edge1, site.edge2);
  site.at.density =
      __builtin_fabsf(site.du1 * site.dv2 - site.du2 * site.dv1) / __builtin_sqrtf(dot(normal, normal));
  return site;
}

// Which way u and v grow on the surface; false where there are no coordinates.
FASTRT_INLINE bool tangents(const HitSite& site, const TextureRow& row, Row3& along_u, Row3& along_v) {
  if (row.planar != 0) {
    along_u = {row.plane_u[0], row.plane_u[1], row.plane_u[2]};
    along_v = {row.plane_v[0], row.plane_v[1], row.plane_v[2]};
    return true;
  }
  if (!site.has_uv) return false;
  const bool mirrored = site.du1 * site.dv2 - site.du2 * site.dv1 < 0.0F;
  const float sign = mirrored ? -1.0F : 1.0F;
  along_u = (site.edge1 * site.dv2 - site.edge2 * site.dv1) * sign;
  along_v = (site.edge2 * site.du1 - site.edge1 * site.du2) * sign;
  return true;
}

// The bump map's normal in the frame of u, v and the surface's normal.
static Row3 bump_of(const SurfaceTextures& textures, const TexturePlace& place) noexcept {
  const TextureRow& row = *textures.bump;
  const Rgba here = look_up(row, place);
  if (textures.normal_map != 0) {
    const Row3 n{here.get(0) * 2.0F - 1.0F, here.get(1) * 2.0F - 1.0F, here.get(2) * 2.0F - 1.0F};
    return {n.x * textures.bump_u, n.y * textures.bump_v, n.z};
  }
  const TextureLevel& level = row.levels[static_cast<std::int32_t>(place.level)];
  const auto width = static_cast<float>(level.width), height = static_cast<float>(level.height);
  const float h = channel_of(row, here);
  TexturePlace right = place, above = place;
  right.s = place.s + 1.0F / width;
  above.t = place.t + 1.0F / height;
  const float rise_u = channel_of(row, look_up(row, right)) - h;
  const float rise_v = channel_of(row, look_up(row, above)) - h;
  return {-((rise_u * width) * textures.bump_u), -((rise_v * height) * textures.bump_v), 1.0F};
}

// n: the shading normal, kept where the bump makes no sense. ng: the geometric one.
static Row3 bumped(const SurfaceTextures& textures, const HitSite& site, float footprint, const Row3& n,
                   const Row3& ng) noexcept {
  Row3 along_u, along_v;
  if (!tangents(site, *textures.bump, along_u, along_v)) return n;
  Row3 x = along_u - n * dot(n, along_u);
  const float x2 = dot(x, x);
  if (!(x2 > 0.0F && x2 < __builtin_inff())) return n;
  x = x * (1.0F / __builtin_sqrtf(x2));
  Row3 y = cross(n, x);
  if (dot(y, along_v) < 0.0F) y = Row3{-y.x, -y.y, -y.z};
  const Row3 b = bump_of(textures, place_on(*textures.bump, site.at, footprint));
  const Row3 turned = (x * b.x + y * b.y) + n * b.z;
  const float length2 = dot(turned, turned);
  if (!(length2 > 0.0F && length2 < __builtin_inff())) return n;
  const Row3 unit = turned * (1.0F / __builtin_sqrtf(length2));
  return dot(unit, ng) > 0.0F ? unit : n;
}

// The colour that a factor is multiplied by: 1 where there is no texture.
FASTRT_INLINE Row3 texture_color(const TextureRow* row, const HitSite& site, float footprint) {
  if (row == nullptr) return {1.0F, 1.0F, 1.0F};
  const Rgba found = look_up(*row, place_on(*row, site.at, footprint));
  return {found.get(0), found.get(1), found.get(2)};
}

FASTRT_INLINE Row3 times(const float* factor, const Row3& color) {
  return Row3{factor[0], factor[1], factor[2]} * color;
}

FASTRT_INLINE float textured_opacity(const MaterialRow& material, const HitSite& site, float footprint) {
  const TextureRow* row = material.textures->opacity;
  if (row == nullptr) return material.opacity;
  const float found = channel_of(*row, look_up(*row, place_on(*row, site.at, footprint)));
  const float opacity = material.opacity * found;
  return opacity < 1.0F ? opacity : 1.0F;
}

FASTRT_INLINE Row3 vertex_color(const ShadingView& scene, const HitSite& site) {
  const Row3 a = row3(scene.color_x, scene.color_y, scene.color_z, site.corner[0]);
  const Row3 b = row3(scene.color_x, scene.color_y, scene.color_z, site.corner[1]);
  const Row3 c = row3(scene.color_x, scene.color_y, scene.color_z, site.corner[2]);
  return (a * site.w + b * site.u) + c * site.v;
}

FASTRT_INLINE void put(const Row3& value, float* r, float* g, float* b, int i) {
  r[i] = value.x;
  g[i] = value.y;
  b[i] = value.z;
}

// The terms of one surface whose material has textures.
static void texture_surface(const ShadingView& scene, const PathBatch& rays, const HitBatch& hits,
                            const MaterialRow& material, int i, SurfaceBatch& s) noexcept {
  const SurfaceTextures& textures = *material.textures;
  const Row3 point{s.point_x[i], s.point_y[i], s.point_z[i]};
  const Row3 ng{s.geometric_x[i], s.geometric_y[i], s.geometric_z[i]};
  const Row3 viewer{s.viewer_x[i], s.viewer_y[i], s.viewer_z[i]};
  const HitSite site = find_site(scene, rays, hits, i, &point);
  const float footprint = (s.width[i] * s.width[i]) / dot(ng, viewer);
  const Row3 color = texture_color(textures.diffuse, site, footprint);
  Row3 diffuse = times(material.diffuse, color);
  Row3 ambient =
      times(material.ambient,
            textures.ambient == textures.diffuse ? color : texture_color(textures.ambient, site, footprint));
  if (textures.vertex_colors != 0 && site.is_triangle) {
    const Row3 of_vertices = vertex_color(scene, site);
    ambient = ambient * of_vertices;
    diffuse = diffuse * of_vertices;
  }
  put(ambient, s.ambient_r, s.ambient_g, s.ambient_b, i);
  put(diffuse, s.diffuse_r, s.diffuse_g, s.diffuse_b, i);
  put(times(material.specular, texture_color(textures.specular, site, footprint)), s.specular_r, s.specular_g,
      s.specular_b, i);
  put(times(material.emission, texture_color(textures.emission, site, footprint)), s.emission_r, s.emission_g,
      s.emission_b, i);
  s.opacity[i] = textured_opacity(material, site, footprint);
  if (textures.bump == nullptr) return;
  const Row3 n{s.shading_x[i], s.shading_y[i], s.shading_z[i]};
  put(bumped(textures, site, footprint, n, ng), s.shading_x, s.shading_y, s.shading_z, i);
}

// For the lanes in `bits` of rays i ..: the footprints, and the terms where there are textures.
FASTRT_INLINE void texture_surfaces(const ShadingView& scene, const PathBatch& rays, const HitBatch& hits,
                                    float spread, std::uint32_t bits, int i, SurfaceBatch& s) {
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  const PathF distance = PathF::load_aligned(hits.t + i) * sqrt(dot(dir, dir));
  (PathF::load_aligned(rays.width + i) + PathF(spread) * distance).store_aligned(s.width + i);
  for (; bits != 0; bits &= bits - 1) {
    const int k = i + __builtin_ctz(bits);
    const MaterialRow& material = scene.materials[s.material[k]];
    if (material.textures != nullptr) texture_surface(scene, rays, hits, material, k, s);
  }
}

// What the surface that shadow ray i hit lets through, where its opacity is a texture. Looked up in level 0.
static Row3 transmit_at(const ShadingView& scene, const MaterialRow& material, const RayBatch& rays,
                        const HitBatch& hits, int i) noexcept {
  const HitSite site = find_site(scene, rays, hits, i, nullptr);
  const float through = 1.0F - textured_opacity(material, site, 0.0F);
  return {through * material.transmission[0], through * material.transmission[1],
          through * material.transmission[2]};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
