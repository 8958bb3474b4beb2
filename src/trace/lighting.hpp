// SPDX-License-Identifier: Apache-2.0
// The local part of the shading equation: ambient light, and each light with its shadows (docs/numerics.md,
// "Shading").
#pragma once

#include "src/trace/light_points.hpp"
#include "src/trace/shadow_media.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

inline constexpr float offset_share = 0x1p-20F; // h = M * 2^-20

// The rays i .. i + widest - 1 of a batch that are in it and hit something.
FASTRT_INLINE std::uint32_t hit_bits(const PathBatch& rays, const HitBatch& hits, int i) {
  return to_bits(simd::bool_cast(PathI::load_aligned(hits.primitive + i) >= PathI(0))) &
         lanes_in(rays.count - i);
}

FASTRT_INLINE PathV load_point(const SurfaceBatch& s, int i) {
  return load3<PathF>(s.point_x + i, s.point_y + i, s.point_z + i);
}
FASTRT_INLINE PathV load_geometric(const SurfaceBatch& s, int i) {
  return load3<PathF>(s.geometric_x + i, s.geometric_y + i, s.geometric_z + i);
}
FASTRT_INLINE PathV load_shading(const SurfaceBatch& s, int i) {
  return load3<PathF>(s.shading_x + i, s.shading_y + i, s.shading_z + i);
}
FASTRT_INLINE PathV load_viewer(const SurfaceBatch& s, int i) {
  return load3<PathF>(s.viewer_x + i, s.viewer_y + i, s.viewer_z + i);
}

// L = Ka * Ia; and which lanes answer light at all.
FASTRT_INLINE void begin_local_light(const ShadingView& scene, std::uint32_t bits, int i, SurfaceBatch& s) {
  PathV local = broadcast3<PathF>(0.0F, 0.0F, 0.0F);
  std::uint32_t& shaded = s.shaded[i / widest];
  shaded = 0;
  for_each_material(scene, s.material + i, bits,
                    [&](const MaterialRow& row, const PathM& mask, std::uint32_t same) {
                      const PathV ka = row.textures != nullptr
                                           ? load3<PathF>(s.ambient_r + i, s.ambient_g + i, s.ambient_b + i)
                                           : broadcast3<PathF>(row.ambient);
                      local = select(mask, ka * broadcast3<PathF>(scene.ambient), local);
                      if (row.unlit == 0) shaded |= same;
                    });
  store3(local, s.local_r + i, s.local_g + i, s.local_b + i);
}

// Direction and cosine of the light for rays i ..; returns the lanes that face it. share: of one of its
// samples.
FASTRT_INLINE std::uint32_t face_light(const LightRow& light, const SurfaceBatch& s, std::uint32_t bits,
                                       float share, int i, LightBatch& out) {
  PathV to_light = broadcast3<PathF>(light.to_light);
  if (light.directional == 0) {
    const PathV way = load_position(light, out, i) - load_point(s, i);
    to_light = normalize(way);
    if (light.shape == static_cast<std::uint32_t>(LightShape::mesh))
      mesh_strength(light, way, to_light, share, i, out);
    else if (light.varies != 0)
      bits &= light_strength(light, way, to_light, share, i, out);
  }
  const PathF zero(0.0F);
  const PathF cosine = dot(load_shading(s, i), to_light);
  store3(to_light, out.to_light_x + i, out.to_light_y + i, out.to_light_z + i);
  cosine.store_aligned(out.cosine + i);
  return to_bits((dot(load_geometric(s, i), to_light) > zero) & (cosine > zero)) & bits;
}

// The shadow rays of lanes i .., row for row; those not in `bits` have no room between t_min and t_max, and
// nothing else of them counts. instances: whether the scene has any.
FASTRT_INLINE void make_shadow_rays(const LightRow& light, const SurfaceBatch& s, const LightBatch& seen,
                                    std::uint32_t bits, bool instances, int i, RayBatch& rays) {
  const PathF none(0.0F);
  none.store_aligned(rays.t_min + i);
  if (bits == 0) {
    none.store_aligned(rays.t_max + i);
    return;
  }
  const PathV normal = load_geometric(s, i);
  const PathF magnitude = PathF::load_aligned(s.magnitude + i);
  PathF reach(1.0F);
  if (light.directional != 0) {
    const PathV origin = load_point(s, i) + normal * (magnitude * PathF(offset_share));
    store3(origin, rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    store3(broadcast3<PathF>(light.to_light), rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    reach = PathF(__builtin_inff());
  } else {
    PathV position = load_position(light, seen, i);
    if (light.shape == static_cast<std::uint32_t>(LightShape::mesh))
      position = position + load3<PathF>(seen.normal_x + i, seen.normal_y + i, seen.normal_z + i) *
                                PathF(light.largest_coordinate * offset_share);
    PathF reached(light.largest_coordinate);
    if (instances) reached = reached * PathF::load_aligned(s.growth + i);
    const PathF offset = max(magnitude, reached) * PathF(offset_share);
    store3(position, rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    store3((load_point(s, i) + normal * offset) - position, rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  }
  simd::select(from_bits<widest>(bits), reach, none).store_aligned(rays.t_max + i);
  load<PathI>(s.planar + i).store_aligned(rays.exclude + i);
  if (instances) load<PathI>(s.planar_inner + i).store_aligned(rays.exclude_inner + i);
}

// How surfaces reflect the light that comes straight from a light; bits: the lanes whose Ks counts, and those
// of them that are Blinn's.
struct ReflectingLanes {
  PathV diffuse, specular;
  PathF shininess;
  std::uint32_t glossy, blinn;
};

FASTRT_INLINE ReflectingLanes reflecting_lanes(const ShadingView& scene, const SurfaceBatch& s,
                                               std::uint32_t bits, int i) {
  // Not in one struct, which would be cleared in memory.
  PathV diffuse = broadcast3<PathF>(0.0F, 0.0F, 0.0F), specular = diffuse;
  PathF shininess(0.0F);
  std::uint32_t glossy = 0, blinn = 0;
  for_each_material(
      scene, s.material + i, bits, [&](const MaterialRow& row, const PathM& mask, std::uint32_t same) {
        const bool varies = row.textures != nullptr;
        const PathV kd = varies ? load3<PathF>(s.diffuse_r + i, s.diffuse_g + i, s.diffuse_b + i)
                                : broadcast3<PathF>(row.diffuse);
        const PathV ks = varies ? load3<PathF>(s.specular_r + i, s.specular_g + i, s.specular_b + i)
                                : broadcast3<PathF>(row.specular);
        diffuse = select(mask, kd, diffuse);
        specular = select(mask, ks, specular);
        shininess = simd::select(mask, PathF(row.shininess), shininess);
        if (row.has_specular != 0) glossy |= same;
        if (row.has_specular != 0 && row.blinn != 0) blinn |= same;
      });
  return {diffuse, specular, shininess, glossy, blinn};
}

// sp of all lanes at once, whatever their materials; 0 where Ks does not count.
FASTRT_INLINE PathF highlight(const ReflectingLanes& lanes, const PathV& normal, const PathV& viewer,
                              const PathV& to_light, const PathF& cosine) {
  const PathF zero(0.0F);
  if (lanes.glossy == 0) return zero;
  PathF x = dot(viewer, normal * (PathF(2.0F) * cosine) - to_light);
  if (lanes.blinn != 0)
    x = simd::select(from_bits<widest>(lanes.blinn), dot(normal, normalize(to_light + viewer)), x);
  const std::uint32_t shining = to_bits(x > zero) & lanes.glossy;
  if (shining == 0) return zero;
  return simd::select(from_bits<widest>(shining), shared_pow<BatchOps<widest>>(x, lanes.shininess), zero);
}

// L = L + ((Kd * cos + Ks * sp) * I) * S for the lanes in `bits`.
FASTRT_INLINE void add_light(const ShadingView& scene, const LightRow& light, const LightBatch& seen,
                             std::uint32_t bits, int i, SurfaceBatch& s) {
  const PathV to_light = load3<PathF>(seen.to_light_x + i, seen.to_light_y + i, seen.to_light_z + i);
  const PathF cosine = PathF::load_aligned(seen.cosine + i);
  const ReflectingLanes lanes = reflecting_lanes(scene, s, bits, i);
  const PathF sp = highlight(lanes, load_shading(s, i), load_viewer(s, i), to_light, cosine);
  const PathV reflected = lanes.diffuse * cosine + lanes.specular * sp;
  const PathV visible = load3<PathF>(seen.visible_r + i, seen.visible_g + i, seen.visible_b + i);
  PathV intensity = broadcast3<PathF>(light.intensity);
  if (light.varies != 0) intensity = intensity * PathF::load_aligned(seen.strength + i);
  const PathV added = (reflected * intensity) * visible;
  const PathV local = load3<PathF>(s.local_r + i, s.local_g + i, s.local_b + i);
  const PathV lit = select(from_bits<widest>(bits), local + added, local);
  store3(lit, s.local_r + i, s.local_g + i, s.local_b + i);
}

// A light's shadow rays: one more ray for each lit pixel, and what the light shows of its first surface.
// share: of one of its samples.
static void record_shadows(const PathBatch& rays, const std::uint32_t* lit, const LightRow& light,
                           float share, const LightBatch& seen, AovScratch& aov) noexcept {
  for (int i = 0; i < rays.count; ++i) {
    if (((lit[i / widest] >> (i % widest)) & 1U) == 0) continue;
    const int pixel = rays.pixel[i];
    ++aov.rays[pixel];
    if (rays.depth != 0) continue;
    Row3 visible{seen.visible_r[i], seen.visible_g[i], seen.visible_b[i]};
    if (light.shape != 0) visible = visible * share;
    aov.lit_r[pixel] = aov.lit_r[pixel] + visible.x;
    aov.lit_g[pixel] = aov.lit_g[pixel] + visible.y;
    aov.lit_b[pixel] = aov.lit_b[pixel] + visible.z;
  }
}

// What reflected and refracted rays see is scattered: as one tile, each shadow ray would be shown what all
// the others need, so those are tiles only where they happen to be dense.
FASTRT_INLINE BatchShape shadow_shape(const LightRow& light, int depth) {
  if (light.shape != 0) return BatchShape::coherent;
  if (depth != 0)
    return light.directional != 0 ? BatchShape::scattered_parallel : BatchShape::scattered_origin;
  return light.directional != 0 ? BatchShape::parallel : BatchShape::common_origin;
}

// Gathers what light k, or one point of it, gives to the surfaces of the batch. Returns the number of shadow
// rays.
static std::uint64_t gather_one_light(const TileJob& job, const PathBatch& rays, std::uint32_t k, float share,
                                      TileScratch& scratch) noexcept {
  const SceneView& scene = *job.scene;
  const LightRow& light = scene.shading.lights[k];
  SurfaceBatch& s = scratch.surface;
  LightBatch& seen = scratch.light;
  std::uint32_t lit[batch_size / widest];
  int lit_count = 0;
  for (int i = 0; i < rays.count; i += widest) {
    std::uint32_t& bits = lit[i / widest];
    bits = s.shaded[i / widest];
    if (bits != 0) bits = face_light(light, s, bits, share, i, seen);
    make_shadow_rays(light, s, seen, bits, scene.shading.shapes.instance_count != 0, i, scratch.shadow);
    lit_count += __builtin_popcount(bits);
  }
  if (lit_count == 0) return 0;
  if (light.casts_shadows != 0) {
    scratch.shadow.count = (rays.count + widest - 1) / widest * widest;
    scratch.shadow.shape = shadow_shape(light, rays.depth);
    if (scene.shading.has_absorption != 0) {
      std::uint32_t alive[batch_size / widest];
      for (int i = 0; i < rays.count; i += widest) alive[i / widest] = lit[i / widest];
      begin_shadow_media(light, rays, scratch);
      trace_fading_shadows(scene, light.directional != 0, alive, scratch);
    } else if (scene.shading.has_transmission != 0)
      trace_coloured_shadows(scene, scratch.shadow, scratch.shadow_hits, seen);
    else
      trace_opaque_shadows(scene.geometry, scratch.shadow, scratch.shadow_hits, seen);
  } else {
    for (int i = 0; i < rays.count; i += widest)
      store_visibility(broadcast3<PathF>(1.0F, 1.0F, 1.0F), i, seen);
  }
  if (scratch.recording && light.casts_shadows != 0)
    record_shadows(rays, lit, light, share, seen, scratch.aov);
  for (int i = 0; i < rays.count; i += widest)
    if (lit[i / widest] != 0) add_light(scene.shading, light, seen, lit[i / widest], i, s);
  return light.casts_shadows != 0 ? static_cast<std::uint64_t>(lit_count) : 0;
}

// Gathers what every light gives to the surfaces of the batch. Returns the number of shadow rays.
static std::uint64_t gather_light(const TileJob& job, const PathBatch& rays, TileScratch& scratch) noexcept {
  std::uint64_t shadow_rays = 0;
  for (std::uint32_t k = 0; k < job.scene->shading.light_count; ++k) {
    if (job.scene->shading.lights[k].shape == 0) {
      shadow_rays += gather_one_light(job, rays, k, 1.0F, scratch);
      continue;
    }
    const float share = 1.0F / static_cast<float>(job.light_samples);
    find_light_keys(job, rays, k, scratch, scratch.light);
    for (int index = 0; index < job.light_samples; ++index) {
      place_light(job.scene->shading.lights[k], index, job.light_samples, rays.count, scratch.light);
      shadow_rays += gather_one_light(job, rays, k, share, scratch);
    }
  }
  return shadow_rays;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
