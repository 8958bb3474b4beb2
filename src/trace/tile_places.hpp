// SPDX-License-Identifier: Apache-2.0
// Which pixels of a tile are rendered, and where they are in the frame.
#pragma once

#include "src/simd/lanes.hpp"
#include "src/trace/tile_job.hpp"
#include "src/trace/tile_order.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Column and row in the picture.
FASTRT_INLINE int picture_x(const TileJob& job, int place) { return job.x + tile_pixel_x(place); }
FASTRT_INLINE int picture_y(const TileJob& job, int place) { return job.y + tile_pixel_y(place); }

FASTRT_INLINE bool in_frame(const TileJob& job, int place) {
  return picture_x(job, place) < job.x_end && picture_y(job, place) < job.y_end;
}

// The pixel of the frame; `place` must be in it.
FASTRT_INLINE long frame_pixel(const TileJob& job, int place) {
  return static_cast<long>(picture_y(job, place) - job.y_begin) * (job.x_end - job.x_begin) +
         (picture_x(job, place) - job.x_begin);
}

FASTRT_INLINE bool is_whole(const TileJob& job) {
  return job.x + tile_side <= job.x_end && job.y + tile_side <= job.y_end;
}

FASTRT_INLINE void pick_all_places(TileScratch& scratch) {
  for (int place = 0; place < batch_size; ++place) scratch.places[place] = place;
  scratch.place_count = batch_size;
}

// All places, so that groups of rays stay squares; of a later round of adaptive sampling the active ones.
// Returns how many of them are in the frame.
FASTRT_INLINE int pick_places(const TileJob& job, TileScratch& scratch) {
  if (job.round.active == nullptr && is_whole(job)) {
    pick_all_places(scratch);
    return batch_size;
  }
  scratch.place_count = 0;
  int count = 0;
  for (int place = 0; place < batch_size; ++place) {
    const bool inside = in_frame(job, place);
    if (job.round.active != nullptr && (!inside || job.round.active[frame_pixel(job, place)] == 0)) continue;
    scratch.places[scratch.place_count++] = place;
    count += inside ? 1 : 0;
  }
  return count;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
