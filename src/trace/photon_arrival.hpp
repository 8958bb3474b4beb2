// SPDX-License-Identifier: Apache-2.0
// Photons that met a surface: how strong they are, and what becomes of their light there. It is either seen
// by the eye or kept for caustics (docs/numerics.md, "Photons").
#pragma once

#include "src/trace/photon_job.hpp"
#include "src/trace/whitted.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// For one batch, row for row. The surfaces' g * Kd is where SurfaceBatch keeps other light: in local_r .. b.
struct ArrivalBatch {
  alignas(64) float strength[batch_size];
  std::uint32_t lit[batch_size / widest]; // per packet: surfaces that scatter the photon's light
};

// strength * (f(D) * D^2) for light that comes from a point and has not been scattered: so that it fades as
// the light does, and not by spreading; a mesh's spreads as light does.
FASTRT_INLINE PathF faded_strength(const LightRow& light, const PhotonBatch& rays, int i) {
  const PathF strength = PathF::load_aligned(rays.strength + i);
  if (rays.scattered || light.directional != 0 || light.shape == static_cast<std::uint32_t>(LightShape::mesh))
    return strength;
  const PathF d = PathF::load_aligned(rays.length + i);
  const PathF f =
      PathF(1.0F) / (PathF(light.constant) + d * (PathF(light.linear) + PathF(light.quadratic) * d));
  return strength * (f * (d * d));
}

FASTRT_INLINE void find_albedo(const ShadingView& scene, std::uint32_t bits, int i, SurfaceBatch& s) {
  PathV albedo = broadcast3<PathF>(0.0F, 0.0F, 0.0F);
  for_each_material(
      scene, s.material + i, bits, [&](const MaterialRow& row, const PathM& mask, std::uint32_t) {
        if (row.unlit != 0) return;
        const bool varies = row.textures != nullptr;
        const PathV kd = varies ? load3<PathF>(s.diffuse_r + i, s.diffuse_g + i, s.diffuse_b + i)
                                : broadcast3<PathF>(row.diffuse);
        const PathF opacity = varies ? PathF::load_aligned(s.opacity + i) : PathF(row.opacity);
        albedo = select(mask, kd * opacity, albedo);
      });
  store3(albedo, s.local_r + i, s.local_g + i, s.local_b + i);
}

FASTRT_INLINE PathV load_albedo(const SurfaceBatch& s, int i) {
  return load3<PathF>(s.local_r + i, s.local_g + i, s.local_b + i);
}

// The shading normal turns the light that arrives on the surface's true area into what the Whitted picture
// shows: cos_n / cos_g of it.
static void meet_surfaces(const PhotonJob& job, PhotonBatch& rays, TileScratch& scratch,
                          ArrivalBatch& out) noexcept {
  const ShadingView& scene = job.scene->shading;
  const LightRow& light = scene.lights[job.emission.light];
  SurfaceBatch& s = scratch.surface;
  const PathF zero(0.0F);
  for (int i = 0; i < rays.count; i += widest) {
    const std::uint32_t bits = hit_bits(rays, scratch.hits, i);
    out.lit[i / widest] = 0;
    if (bits == 0) continue;
    find_surfaces(scene, rays, scratch.hits, bits, i, s);
    if (scene.has_textures != 0) texture_surfaces(scene, rays, scratch.hits, 0.0F, bits, i, s);
    if (scene.has_absorption != 0) fade(scene, rays, scratch.hits, bits, i);
    find_albedo(scene, bits, i, s);
    const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    const PathF distance = PathF::load_aligned(scratch.hits.t + i) * sqrt(dot(dir, dir));
    (PathF::load_aligned(rays.length + i) + distance).store_aligned(rays.length + i);
    const PathV viewer = load_viewer(s, i);
    const PathF cos_g = dot(load_geometric(s, i), viewer), cos_n = dot(load_shading(s, i), viewer);
    (faded_strength(light, rays, i) * (cos_n / cos_g)).store_aligned(out.strength + i);
    const PathV albedo = load_albedo(s, i);
    const PathM scatters = max(albedo.x, max(albedo.y, albedo.z)) > zero;
    out.lit[i / widest] = to_bits((cos_g > zero) & (cos_n > zero) & scatters) & bits;
  }
}

// What arrives: weight * strength.
FASTRT_INLINE PathV arrived_light(const PhotonBatch& rays, const ArrivalBatch& arrival, int i) {
  return load_weight(rays, i) * PathF::load_aligned(arrival.strength + i);
}

// Keeps the photons that met a mirror or were bent. There is room for a batch.
static void store_photons(const PhotonJob& job, const PhotonBatch& rays, const SurfaceBatch& s,
                          const ArrivalBatch& arrival, PhotonStore& store) noexcept {
  int count = store.count;
  for (int i = 0; i < rays.count; i += widest) {
    std::uint32_t bits = arrival.lit[i / widest];
    if (bits == 0) continue;
    alignas(64) float flux[3][widest];
    store_lanes(arrived_light(rays, arrival, i) * broadcast3<PathF>(job.emission.flux), flux);
    for (; bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits), k = i + lane;
      if (rays.bent[k] == 0) continue;
      const float point[3] = {s.point_x[k], s.point_y[k], s.point_z[k]};
      const float normal[3] = {s.geometric_x[k], s.geometric_y[k], s.geometric_z[k]};
      for (int axis = 0; axis < 3; ++axis) {
        store.point[axis][count] = point[axis];
        store.normal[axis][count] = normal[axis];
        store.flux[axis][count] = flux[axis][lane];
      }
      store.index[count] = rays.index[k];
      store.key[count] = rays.key[k];
      ++count;
    }
  }
  store.count = count;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
