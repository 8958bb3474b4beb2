// SPDX-License-Identifier: Apache-2.0
// What textures make of the surfaces of a batch: the material's terms at each point, and the shading normal
// that a bump map turns (docs/numerics.md, "Textures").
#pragma once

#include "src/trace/bumps.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The hits of one material in the lanes `bits` of rays i .. of a batch.
struct TexturedHits {
  const MaterialRow& material;
  const HitSites& sites;
  PathV points;
  PathF footprint;
  std::uint32_t bits;
};

// The colour that a factor is multiplied by: 1 where there is no texture.
FASTRT_INLINE PathV texture_color(const TextureRow* row, const TexturedHits& h) {
  if (row == nullptr) return broadcast3<PathF>(1.0F, 1.0F, 1.0F);
  return look_up(*row, places_on(*row, h.sites, h.points, h.footprint), h.bits).color;
}

FASTRT_INLINE PathF textured_opacity(const TexturedHits& h) {
  const TextureRow* const row = h.material.textures->opacity;
  const PathF constant(h.material.opacity), one(1.0F);
  if (row == nullptr) return constant;
  const PathF opacity =
      constant * look_up_number(*row, places_on(*row, h.sites, h.points, h.footprint), h.bits);
  return simd::select(opacity < one, opacity, one);
}

// 1 where there are no vertices.
FASTRT_INLINE PathV vertex_colors(const ShadingView& scene, const TexturedHits& h) {
  alignas(64) float r[widest], g[widest], b[widest];
  for (float* column : {r, g, b}) PathF(1.0F).store_aligned(column);
  for (std::uint32_t left = h.bits; left != 0; left &= left - 1) {
    const int k = __builtin_ctz(left);
    const HitSite& site = h.sites.hit[k];
    if (!site.is_triangle) continue;
    const auto color = [&](int corner) {
      return row3(scene.color_x, scene.color_y, scene.color_z, site.corner[corner]);
    };
    const Row3 mixed = (color(0) * site.w + color(1) * site.u) + color(2) * site.v;
    r[k] = mixed.x;
    g[k] = mixed.y;
    b[k] = mixed.z;
  }
  return load3<PathF>(r, g, b);
}

// Stores the lanes of `mask`.
FASTRT_INLINE void put(const PathM& mask, const PathV& value, float* x, float* y, float* z) {
  store3(select(mask, value, load3<PathF>(x, y, z)), x, y, z);
}

FASTRT_INLINE void turn_normals(const TexturedHits& h, int i, SurfaceBatch& s) {
  const SurfaceTextures& textures = *h.material.textures;
  alignas(64) float x[widest], y[widest], z[widest];
  store3(bumps_of(textures, places_on(*textures.bump, h.sites, h.points, h.footprint), h.bits), x, y, z);
  for (std::uint32_t left = h.bits; left != 0; left &= left - 1) {
    const auto k = static_cast<std::uint32_t>(__builtin_ctz(left));
    const std::uint32_t at = static_cast<std::uint32_t>(i) + k;
    const Row3 n = bumped(*textures.bump, h.sites.hit[k], row3(x, y, z, k),
                          row3(s.shading_x, s.shading_y, s.shading_z, at),
                          row3(s.geometric_x, s.geometric_y, s.geometric_z, at));
    s.shading_x[at] = n.x;
    s.shading_y[at] = n.y;
    s.shading_z[at] = n.z;
  }
}

// The terms of the surfaces of one material that has textures: the lanes `mask` of rays i ..
FASTRT_INLINE void texture_material(const ShadingView& scene, const TexturedHits& h, const PathM& mask, int i,
                                    SurfaceBatch& s) {
  const MaterialRow& material = h.material;
  const SurfaceTextures& textures = *material.textures;
  const PathV color = texture_color(textures.diffuse, h);
  PathV diffuse = broadcast3<PathF>(material.diffuse) * color;
  PathV ambient = broadcast3<PathF>(material.ambient) *
                  (textures.ambient == textures.diffuse ? color : texture_color(textures.ambient, h));
  if (textures.vertex_colors != 0) {
    const PathV of_vertices = vertex_colors(scene, h);
    ambient = ambient * of_vertices;
    diffuse = diffuse * of_vertices;
  }
  put(mask, ambient, s.ambient_r + i, s.ambient_g + i, s.ambient_b + i);
  put(mask, diffuse, s.diffuse_r + i, s.diffuse_g + i, s.diffuse_b + i);
  put(mask, broadcast3<PathF>(material.specular) * texture_color(textures.specular, h), s.specular_r + i,
      s.specular_g + i, s.specular_b + i);
  put(mask, broadcast3<PathF>(material.emission) * texture_color(textures.emission, h), s.emission_r + i,
      s.emission_g + i, s.emission_b + i);
  simd::select(mask, textured_opacity(h), PathF::load_aligned(s.opacity + i)).store_aligned(s.opacity + i);
  if (textures.bump != nullptr) turn_normals(h, i, s);
}

// For the lanes in `bits` of rays i ..: the footprints, and the terms where there are textures.
FASTRT_INLINE void texture_surfaces(const ShadingView& scene, const PathBatch& rays, const HitBatch& hits,
                                    float spread, std::uint32_t bits, int i, SurfaceBatch& s) {
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  const PathF distance = PathF::load_aligned(hits.t + i) * sqrt(dot(dir, dir));
  const PathF width = PathF::load_aligned(rays.width + i) + PathF(spread) * distance;
  width.store_aligned(s.width + i);
  const PathV points = load3<PathF>(s.point_x + i, s.point_y + i, s.point_z + i),
              normals = load3<PathF>(s.geometric_x + i, s.geometric_y + i, s.geometric_z + i),
              viewers = load3<PathF>(s.viewer_x + i, s.viewer_y + i, s.viewer_z + i);
  const PathF footprint = (width * width) / dot(normals, viewers);
  for_each_material(scene, s.material + i, bits,
                    [&](const MaterialRow& material, const PathM& mask, std::uint32_t same) {
                      if (material.textures == nullptr) return;
                      HitSites sites;
                      find_sites(scene, rays, hits, same, i, sites);
                      texture_material(scene, {material, sites, points, footprint, same}, mask, i, s);
                    });
}

// What the surface that shadow ray i hit lets through, where its opacity is a texture. Looked up in level 0.
static Row3 transmit_at(const ShadingView& scene, const MaterialRow& material, const RayBatch& rays,
                        const HitBatch& hits, int i) noexcept {
  const int first = i / widest * widest, k = i - first;
  HitSites sites;
  find_sites(scene, rays, hits, 1U << k, first, sites);
  const PathV origins = load3<PathF>(rays.origin_x + first, rays.origin_y + first, rays.origin_z + first),
              dirs = load3<PathF>(rays.dir_x + first, rays.dir_y + first, rays.dir_z + first);
  const PathV points = origins + dirs * PathF::load_aligned(hits.t + first);
  const PathF opacity = textured_opacity({material, sites, points, PathF(0.0F), 1U << k});
  const float through = 1.0F - opacity.get(static_cast<std::size_t>(k));
  return {through * material.transmission[0], through * material.transmission[1],
          through * material.transmission[2]};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
