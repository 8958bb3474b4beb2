// SPDX-License-Identifier: Apache-2.0
// AOVs of a tile's centre rays (docs/numerics.md, "AOVs"). Nothing here is on the way of a picture without
// them.
#pragma once

#include "src/trace/hit_weights.hpp"
#include "src/trace/lighting.hpp"
#include "src/trace/tile_places.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

static void begin_recording(TileScratch& scratch) noexcept {
  AovScratch& aov = scratch.aov;
  for (int i = 0; i < batch_size; ++i) {
    aov.lit_r[i] = aov.lit_g[i] = aov.lit_b[i] = 0.0F;
    aov.rays[i] = aov.deepest[i] = 0;
  }
  scratch.recording = true;
}

FASTRT_INLINE void put3(float* to, long at, float x, float y, float z) {
  if (to == nullptr) return;
  to[3 * at] = x;
  to[3 * at + 1] = y;
  to[3 * at + 2] = z;
}

// (w*tA + u*tB) + v*tC where all corners have texture coordinates; otherwise (u, v).
FASTRT_INLINE void texture_coordinates(const ShadingView& scene, std::uint32_t primitive, float u, float v,
                                       float* out) {
  out[0] = u;
  out[1] = v;
  if (primitive >= scene.triangle_count || scene.uv_x == nullptr) return;
  const std::uint32_t a = scene.t0[primitive], b = scene.t1[primitive], c = scene.t2[primitive];
  if (a == no_row || b == no_row || c == no_row) return;
  const float w = (1.0F - u) - v;
  out[0] = (w * scene.uv_x[a] + u * scene.uv_x[b]) + v * scene.uv_x[c];
  out[1] = (w * scene.uv_y[a] + u * scene.uv_y[b]) + v * scene.uv_y[c];
}

// What camera ray i hit, into pixel `at` of the frame.
FASTRT_INLINE void record_hit(const TileJob& job, const PathBatch& rays, const TileScratch& scratch, int i,
                              long at) {
  const ShadingView& scene = job.scene->shading;
  const AovTargets& to = job.aovs;
  const SurfaceBatch& s = scratch.surface;
  const std::int32_t id = shown_primitive(scene.shapes, scratch.hits, i);
  const auto primitive = static_cast<std::uint32_t>(id);
  if (to.primitive != nullptr) to.primitive[at] = id;
  if (to.object != nullptr) to.object[at] = static_cast<std::int32_t>(object_of_hit(scene, scratch.hits, i));
  if (to.material != nullptr) to.material[at] = s.material[i];
  if (to.depth != nullptr) {
    const float length2 =
        (rays.dir_x[i] * rays.dir_x[i] + rays.dir_y[i] * rays.dir_y[i]) + rays.dir_z[i] * rays.dir_z[i];
    to.depth[at] = scratch.hits.t[i] * __builtin_sqrtf(length2);
  }
  put3(to.normal, at, s.shading_x[i], s.shading_y[i], s.shading_z[i]);
  put3(to.position, at, s.point_x[i], s.point_y[i], s.point_z[i]);
  if (to.uv != nullptr)
    texture_coordinates(scene, primitive, scratch.aov.u[i], scratch.aov.v[i], to.uv + 2 * at);
  const MaterialRow& row = scene.materials[s.material[i]];
  if (row.textures != nullptr)
    put3(to.albedo, at, s.diffuse_r[i], s.diffuse_g[i], s.diffuse_b[i]);
  else
    put3(to.albedo, at, row.diffuse[0], row.diffuse[1], row.diffuse[2]);
}

// The first surfaces of a tile. Lights have been gathered.
static void record_surfaces(const TileJob& job, const PathBatch& rays, TileScratch& scratch) noexcept {
  if (job.aovs.uv != nullptr)
    hit_weights(job.scene->shading, rays, scratch.hits, scratch.aov.u, scratch.aov.v);
  const ShadingView& scene = job.scene->shading;
  int shadowing = 0;
  for (std::uint32_t k = 0; k < scene.light_count; ++k) shadowing += scene.lights[k].casts_shadows != 0;
  const float share = 1.0F / static_cast<float>(shadowing);
  for (int i = 0; i < rays.count; ++i) {
    const int pixel = rays.pixel[i];
    if (!in_frame(job, pixel) || scratch.hits.primitive[i] < 0) continue;
    const long at = frame_pixel(job, pixel);
    record_hit(job, rays, scratch, i, at);
    if (shadowing == 0)
      put3(job.aovs.shadow, at, 1.0F, 1.0F, 1.0F);
    else
      put3(job.aovs.shadow, at, scratch.aov.lit_r[pixel] * share, scratch.aov.lit_g[pixel] * share,
           scratch.aov.lit_b[pixel] * share);
  }
}

// A batch whose light has been gathered.
static void record_batch(const TileJob& job, const PathBatch& rays, TileScratch& scratch) noexcept {
  for (int i = 0; i < rays.count; ++i) {
    const int pixel = rays.pixel[i];
    ++scratch.aov.rays[pixel];
    if (scratch.aov.deepest[pixel] < rays.depth) scratch.aov.deepest[pixel] = rays.depth;
  }
  if (rays.depth == 0) record_surfaces(job, rays, scratch);
}

// After the last ray.
static void end_recording(const TileJob& job, TileScratch& scratch) noexcept {
  scratch.recording = false;
  for (int i = 0; i < batch_size; ++i) {
    if (!in_frame(job, i)) continue;
    const long at = frame_pixel(job, i);
    if (job.aovs.recursion != nullptr) job.aovs.recursion[at] = scratch.aov.deepest[i];
    if (job.aovs.cost != nullptr) job.aovs.cost[at] = scratch.aov.rays[i];
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
