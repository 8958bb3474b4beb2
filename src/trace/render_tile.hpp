// SPDX-License-Identifier: Apache-2.0
// The samples of one tile: their rays, their sums and what becomes of them (docs/numerics.md, "Camera and
// samples").
#pragma once

#include "src/trace/sample_rows.hpp"
#include "src/trace/whole_tile.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

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
  scratch.row_count = 0;
  scratch.sample = index < 0 ? 0 : index;
  trace_tree(job, camera_rays, index <= 0, scratch, counts);
}

// The tile's pixels into the frame.
static void write_tile(const TileJob& job, const TileScratch& scratch) noexcept {
  const bool one = job.last_sample == 0;
  if (one && is_whole(job)) return write_whole_tile(job, scratch);
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
  if (job.round.active != nullptr) return take_active_places(job, scratch, counts);
  int sample = job.first_sample;
  for (const int together : {16, 4})
    for (; job.last_sample - sample >= together; sample += together)
      take_side_by_side(job, sample, sample + together, scratch, counts);
  for (; sample < job.last_sample; ++sample) {
    trace_sample(job, sample, scratch, counts);
    add_sample(scratch, sums_of(job, sample, scratch));
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
