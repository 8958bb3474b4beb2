// SPDX-License-Identifier: Apache-2.0
// Several samples of few pixels in one batch (docs/numerics.md, "Camera and samples"): rays of fewer pixels
// have more in common than one ray of each pixel of a tile.
#pragma once

#include "src/trace/camera_rays.hpp"
#include "src/trace/whitted.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

FASTRT_INLINE void clear(float* r, float* g, float* b) {
  for (int i = 0; i < batch_size; i += widest)
    store3(broadcast3<PathF>(0.0F, 0.0F, 0.0F), r + i, g + i, b + i);
}

// The sums that sample `index` adds to.
struct SampleSums {
  float *r, *g, *b;
};
FASTRT_INLINE SampleSums sums_of(const TileJob& job, int index, TileScratch& scratch) {
  if (in_lobe(job.filter, static_cast<std::uint32_t>(index)))
    return {scratch.lobe_r, scratch.lobe_g, scratch.lobe_b};
  return {scratch.sum_r, scratch.sum_g, scratch.sum_b};
}

// sum = sum + radiance of one sample of all places.
FASTRT_INLINE void add_sample(const TileScratch& scratch, const SampleSums& sums) {
  for (int i = 0; i < batch_size; i += widest) {
    const PathV sum = load3<PathF>(sums.r + i, sums.g + i, sums.b + i);
    const PathV radiance =
        load3<PathF>(scratch.radiance_r + i, scratch.radiance_g + i, scratch.radiance_b + i);
    store3(sum + radiance, sums.r + i, sums.g + i, sums.b + i);
  }
}

// sum = sum + radiance, of `count` samples of a pixel from number `first` on, which lie in rows `row` ..
FASTRT_INLINE void add_rows(const TileJob& job, int row, int first, int count, TileScratch& scratch) {
  const int place = scratch.row_places[row];
  for (int k = 0; k < count;) {
    const SampleSums sums = sums_of(job, first + k, scratch);
    float r = sums.r[place], g = sums.g[place], b = sums.b[place];
    do {
      r = r + scratch.radiance_r[row + k];
      g = g + scratch.radiance_g[row + k];
      b = b + scratch.radiance_b[row + k];
      ++k;
    } while (k < count && (job.filter.negative == 0.0F || sums_of(job, first + k, scratch).r == sums.r));
    sums.r[place] = r;
    sums.g[place] = g;
    sums.b[place] = b;
  }
}

// Makes rows of samples first .. last - 1 of the `count` places from number `begin` on, those of a pixel side
// by side and in order. Places beyond the frame's edge get none.
static void make_rows(const TileJob& job, int begin, int count, int first, int last,
                      TileScratch& scratch) noexcept {
  const bool whole = is_whole(job);
  scratch.rows_per_place = last - first;
  int rows = 0;
  for (int i = begin; i < begin + count; ++i) {
    const int place = scratch.places[i];
    if (!whole && !in_frame(job, place)) continue;
    for (int sample = first; sample < last; ++sample, ++rows) {
      scratch.row_places[rows] = place;
      scratch.row_samples[rows] = sample;
    }
  }
  scratch.row_count = rows;
}

// Takes these samples in one batch.
static void take_rows(const TileJob& job, int begin, int count, int first, int last, TileScratch& scratch,
                      TileRayCounts& counts) noexcept {
  make_rows(job, begin, count, first, last, scratch);
  if (scratch.row_count == 0) return;
  clear(scratch.radiance_r, scratch.radiance_g, scratch.radiance_b);
  PathBatch& camera_rays = take_batch(scratch, 0);
  make_row_rays(job, first, scratch, camera_rays);
  trace_tree(job, camera_rays, first == 0, scratch, counts);
  for (int row = 0; row < scratch.row_count; row += scratch.rows_per_place)
    add_rows(job, row, first, scratch.rows_per_place, scratch);
}

// Samples first .. last - 1 of all places: of as many pixels at a time as fill a batch. At most batch_size.
static void take_side_by_side(const TileJob& job, int first, int last, TileScratch& scratch,
                              TileRayCounts& counts) noexcept {
  const int most = batch_size / (last - first);
  for (int begin = 0; begin < scratch.place_count; begin += most) {
    const int count = scratch.place_count - begin < most ? scratch.place_count - begin : most;
    take_rows(job, begin, count, first, last, scratch, counts);
  }
}

// The samples of places that others lie between: of each pixel 16 side by side, or as many as fill a batch
// where there are few.
static void take_active_places(const TileJob& job, TileScratch& scratch, TileRayCounts& counts) noexcept {
  const int fair = batch_size / scratch.place_count, most = fair > 16 ? fair : 16;
  for (int first = job.first_sample, last = 0; first < job.last_sample; first = last) {
    last = job.last_sample - first < most ? job.last_sample : first + most;
    take_side_by_side(job, first, last, scratch, counts);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
