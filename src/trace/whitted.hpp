// SPDX-License-Identifier: Apache-2.0
// The Whitted loop of one tile: an explicit stack of ray batches, no recursion. A batch's own light is added
// first, then everything below its reflected rays, then everything below its refracted ones: the reflected
// batch goes on top. A batch holds at most one ray per pixel, so every pixel gets its contributions in that
// order.
#pragma once

#include "src/trace/aov.hpp"
#include "src/trace/camera_rays.hpp"
#include "src/trace/secondary.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// acc = acc + weight * light, for the lanes in `bits`.
FASTRT_INLINE void accumulate(const PathBatch& rays, const PathV& weight, const PathV& light,
                              std::uint32_t bits, int i, TileScratch& scratch) {
  alignas(64) float added[3][widest];
  store_lanes(weight * light, added);
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    const int pixel = rays.pixel[i + lane];
    scratch.radiance_r[pixel] = scratch.radiance_r[pixel] + added[0][lane];
    scratch.radiance_g[pixel] = scratch.radiance_g[pixel] + added[1][lane];
    scratch.radiance_b[pixel] = scratch.radiance_b[pixel] + added[2][lane];
  }
}

FASTRT_INLINE PathV load_weight(const PathBatch& rays, int i) {
  return load3<PathF>(rays.weight_r + i, rays.weight_g + i, rays.weight_b + i);
}

// Light fades on its way through a medium: weight = weight * exp(-(sigma * distance)).
FASTRT_INLINE void fade(const ShadingView& scene, PathBatch& rays, const HitBatch& hits, std::uint32_t bits,
                        int i) {
  alignas(64) float sigma[3][widest] = {};
  std::uint32_t fading = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    const std::int32_t medium = rays.media[0][i + lane];
    if (medium < 0 || scene.materials[medium].has_absorption == 0) continue;
    fading |= 1U << lane;
    for (int c = 0; c < 3; ++c) sigma[c][lane] = scene.materials[medium].absorption[c];
  }
  if (fading == 0) return;
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  const PathF distance = PathF::load_aligned(hits.t + i) * sqrt(dot(dir, dir));
  const PathV weight = load_weight(rays, i);
  using Ops = BatchOps<widest>;
  const auto left = [&](int c) { return shared_exp<Ops>(negate(PathF::load_aligned(sigma[c]) * distance)); };
  const PathV faded = weight * PathV{left(0), left(1), left(2)};
  store3(select(from_bits<widest>(fading), faded, weight), rays.weight_r + i, rays.weight_g + i,
         rays.weight_b + i);
}

// E = Ke + g * L, or Ke + Kd for an unlit material, for the lanes in `bits`.
FASTRT_INLINE PathV emitted_light(const ShadingView& scene, const SurfaceBatch& s, std::uint32_t bits,
                                  int i) {
  PathV light = broadcast3<PathF>(0.0F, 0.0F, 0.0F);
  const PathV local = load3<PathF>(s.local_r + i, s.local_g + i, s.local_b + i);
  for_each_material(
      scene, s.material + i, bits, [&](const MaterialRow& row, const PathM& mask, std::uint32_t) {
        const bool varies = row.textures != nullptr;
        const PathV kd = varies ? load3<PathF>(s.diffuse_r + i, s.diffuse_g + i, s.diffuse_b + i)
                                : broadcast3<PathF>(row.diffuse);
        const PathV ke = varies ? load3<PathF>(s.emission_r + i, s.emission_g + i, s.emission_b + i)
                                : broadcast3<PathF>(row.emission);
        const PathF opacity = varies ? PathF::load_aligned(s.opacity + i) : PathF(row.opacity);
        const PathV reflected = row.unlit != 0 ? kd : local * opacity;
        light = select(mask, ke + reflected, light);
      });
  return light;
}

// What the batch's rays see: the background where they miss, and the surfaces that lighting and secondary
// rays need.
static void see_surfaces(const TileJob& job, PathBatch& rays, TileScratch& scratch) noexcept {
  const SceneView& scene = *job.scene;
  const PathV background = broadcast3<PathF>(scene.shading.background);
  for (int i = 0; i < rays.count; i += widest) {
    const std::uint32_t bits = hit_bits(rays, scratch.hits, i);
    const int live = rays.count - i;
    const std::uint32_t in_batch = live >= widest ? (1U << (widest - 1)) * 2U - 1U : (1U << live) - 1U;
    if (bits != in_batch) accumulate(rays, load_weight(rays, i), background, in_batch & ~bits, i, scratch);
    scratch.surface.shaded[i / widest] = 0;
    if (bits == 0) continue;
    find_surfaces(scene.shading, rays, scratch.hits, i, scratch.surface);
    if (scene.shading.has_textures != 0)
      texture_surfaces(scene.shading, rays, scratch.hits, job.spread, bits, i, scratch.surface);
    if (scene.shading.has_absorption != 0) fade(scene.shading, rays, scratch.hits, bits, i);
    begin_local_light(scene.shading, bits, i, scratch.surface);
  }
}

FASTRT_INLINE PathBatch& take_batch(TileScratch& scratch, int depth) {
  PathBatch& batch = *scratch.unused[--scratch.unused_count];
  batch.count = 0;
  batch.depth = depth;
  batch.shape = BatchShape::coherent;
  return batch;
}
FASTRT_INLINE void give_back(TileScratch& scratch, PathBatch& batch) {
  scratch.unused[scratch.unused_count++] = &batch;
}
FASTRT_INLINE void push(TileScratch& scratch, PathBatch& batch) {
  if (batch.count == 0)
    give_back(scratch, batch);
  else
    scratch.waiting[scratch.waiting_count++] = &batch;
}

// One batch: its light, and its children onto the stack.
static void trace_paths(const TileJob& job, PathBatch& rays, TileScratch& scratch,
                        TileRayCounts& counts) noexcept {
  const SceneView& scene = *job.scene;
  find_closest_hits(scene.geometry, rays, scratch.hits);
  see_surfaces(job, rays, scratch);
  counts.shadow += gather_light(scene, rays, scratch);
  if (scratch.recording) record_batch(job, rays, scratch);
  for (int i = 0; i < rays.count; i += widest) {
    const std::uint32_t bits = hit_bits(rays, scratch.hits, i);
    if (bits == 0) continue;
    const PathV light = emitted_light(scene.shading, scratch.surface, bits, i);
    accumulate(rays, load_weight(rays, i), light, bits, i, scratch);
  }
  if (rays.depth >= job.max_depth) return;
  PathBatch& refracted = take_batch(scratch, rays.depth + 1);
  PathBatch& reflected = take_batch(scratch, rays.depth + 1);
  make_secondary_rays(job, rays, scratch, reflected, refracted);
  counts.reflected += static_cast<std::uint64_t>(reflected.count);
  counts.refracted += static_cast<std::uint64_t>(refracted.count);
  push(scratch, refracted);
  push(scratch, reflected);
}

FASTRT_INLINE void clear(float* r, float* g, float* b) {
  for (int i = 0; i < batch_size; i += widest)
    store3(broadcast3<PathF>(0.0F, 0.0F, 0.0F), r + i, g + i, b + i);
}

// sum = sum + radiance of one sample.
FASTRT_INLINE void add_sample(const TileScratch& scratch, float* sum_r, float* sum_g, float* sum_b) {
  for (int i = 0; i < batch_size; i += widest) {
    const PathV sum = load3<PathF>(sum_r + i, sum_g + i, sum_b + i);
    const PathV radiance =
        load3<PathF>(scratch.radiance_r + i, scratch.radiance_g + i, scratch.radiance_b + i);
    store3(sum + radiance, sum_r + i, sum_g + i, sum_b + i);
  }
}

FASTRT_INLINE void put_color(float* to, long pixel, float r, float g, float b) {
  to[3 * pixel] = r;
  to[3 * pixel + 1] = g;
  to[3 * pixel + 2] = b;
}

// One sample of every place into `radiance`, or with index -1 the pixels' centres.
static void trace_sample(const TileJob& job, int index, TileScratch& scratch,
                         TileRayCounts& counts) noexcept {
  clear(scratch.radiance_r, scratch.radiance_g, scratch.radiance_b);
  PathBatch& camera_rays = take_batch(scratch, 0);
  make_camera_rays(job, index, scratch, camera_rays);
  push(scratch, camera_rays);
  bool first = index <= 0;
  while (scratch.waiting_count != 0) {
    PathBatch& batch = *scratch.waiting[--scratch.waiting_count];
    trace_paths(job, batch, scratch, counts);
    if (first)
      __builtin_memcpy(scratch.first_primitive, scratch.hits.primitive, sizeof scratch.first_primitive);
    first = false;
    give_back(scratch, batch);
  }
}

// The tile's pixels into the frame.
static void write_tile(const TileJob& job, const TileScratch& scratch) noexcept {
  const bool one = job.last_sample == 0;
  const SampleWeights weights = sample_weights(job.filter, static_cast<std::uint32_t>(job.last_sample));
  for (int i = 0; i < batch_size; ++i) {
    if (!in_frame(job, i)) continue;
    const long pixel = frame_pixel(job, i);
    if (one)
      put_color(job.rgb, pixel, scratch.radiance_r[i], scratch.radiance_g[i], scratch.radiance_b[i]);
    else
      put_color(job.rgb, pixel, resolve_channel(weights, scratch.sum_r[i], scratch.lobe_r[i]),
                resolve_channel(weights, scratch.sum_g[i], scratch.lobe_g[i]),
                resolve_channel(weights, scratch.sum_b[i], scratch.lobe_b[i]));
    job.primitive[pixel] = scratch.first_primitive[i];
  }
}

// Adaptive sampling goes on from the sums of earlier rounds; the film makes colours of them.
static void load_sums(const TileJob& job, TileScratch& scratch) noexcept {
  for (int i = 0; i < scratch.place_count; ++i) {
    const int place = scratch.places[i];
    if (!in_frame(job, place)) continue;
    const float* const sum = job.round.sum + 3 * frame_pixel(job, place);
    scratch.sum_r[place] = sum[0];
    scratch.sum_g[place] = sum[1];
    scratch.sum_b[place] = sum[2];
    if (job.round.lobe_sum == nullptr) continue;
    const float* const lobe = job.round.lobe_sum + 3 * frame_pixel(job, place);
    scratch.lobe_r[place] = lobe[0];
    scratch.lobe_g[place] = lobe[1];
    scratch.lobe_b[place] = lobe[2];
  }
}

static void store_sums(const TileJob& job, const TileScratch& scratch) noexcept {
  for (int i = 0; i < scratch.place_count; ++i) {
    const int place = scratch.places[i];
    if (!in_frame(job, place)) continue;
    const long pixel = frame_pixel(job, place);
    put_color(job.round.sum, pixel, scratch.sum_r[place], scratch.sum_g[place], scratch.sum_b[place]);
    if (job.round.lobe_sum != nullptr)
      put_color(job.round.lobe_sum, pixel, scratch.lobe_r[place], scratch.lobe_g[place],
                scratch.lobe_b[place]);
    if (job.first_sample == 0) job.primitive[pixel] = scratch.first_primitive[place];
  }
}

// All samples of the job into the sums.
static void take_samples(const TileJob& job, TileScratch& scratch, TileRayCounts& counts) noexcept {
  clear(scratch.sum_r, scratch.sum_g, scratch.sum_b);
  clear(scratch.lobe_r, scratch.lobe_g, scratch.lobe_b);
  if (job.round.sum != nullptr) load_sums(job, scratch);
  for (int sample = job.first_sample; sample < job.last_sample; ++sample) {
    trace_sample(job, sample, scratch, counts);
    if (in_lobe(job.filter, static_cast<std::uint32_t>(sample)))
      add_sample(scratch, scratch.lobe_r, scratch.lobe_g, scratch.lobe_b);
    else
      add_sample(scratch, scratch.sum_r, scratch.sum_g, scratch.sum_b);
  }
}

static void render_tile(const TileJob& job, TileScratch& scratch, TileRayCounts& counts) noexcept {
  const auto pixels = static_cast<std::uint64_t>(pick_places(job, scratch));
  if (pixels == 0) return;
  if (job.aovs.any) {
    begin_recording(scratch);
    trace_sample(job, -1, scratch, counts);
    end_recording(job, scratch);
    counts.primary += pixels;
  }
  if (job.last_sample == 0) {
    if (!job.aovs.any) {
      trace_sample(job, -1, scratch, counts);
      counts.primary += pixels;
    }
  } else {
    take_samples(job, scratch, counts);
    counts.primary += pixels * static_cast<std::uint64_t>(job.last_sample - job.first_sample);
  }
  if (job.round.sum != nullptr)
    store_sums(job, scratch);
  else
    write_tile(job, scratch);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
