// SPDX-License-Identifier: Apache-2.0
// The rays of one sample of every pixel of a tile (docs/numerics.md, "Camera and samples").
#pragma once

#include "src/film/sampling.hpp"
#include "src/kernels/vec3.hpp"
#include "src/trace/tile_places.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

using CameraF = Floats<widest>;
using CameraV = V3<CameraF>;

// Where rays go through the image and the lens.
struct alignas(64) SamplePlaces {
  float px[batch_size], py[batch_size];
  float lens_a[batch_size], lens_b[batch_size];
};

// Where the pixels of a group of 4 x 4 lie in it.
struct alignas(64) GroupPixels {
  std::int32_t x[group_size], y[group_size];
};
inline constexpr GroupPixels group_pixels = [] {
  GroupPixels pixels{};
  for (int i = 0; i < group_size; ++i) {
    pixels.x[i] = tile_pixel_x(i);
    pixels.y[i] = tile_pixel_y(i);
  }
  return pixels;
}();

FASTRT_INLINE void place_all_centers(const TileJob& job, SamplePlaces& to) {
  const CameraF half(0.5F);
  for (int i = 0; i < batch_size; i += widest) {
    const int group = i / group_size * group_size, k = i % group_size;
    const Ints<widest> x =
        Ints<widest>::load_aligned(group_pixels.x + k) + Ints<widest>(picture_x(job, group));
    const Ints<widest> y =
        Ints<widest>::load_aligned(group_pixels.y + k) + Ints<widest>(picture_y(job, group));
    (simd::to_float(x) + half).store_aligned(to.px + i);
    (simd::to_float(y) + half).store_aligned(to.py + i);
  }
}

FASTRT_INLINE void place_centers(const TileJob& job, const TileScratch& scratch, SamplePlaces& to) {
  if (scratch.place_count == batch_size) return place_all_centers(job, to);
  for (int i = 0; i < scratch.place_count; ++i) {
    to.px[i] = static_cast<float>(picture_x(job, scratch.places[i])) + 0.5F;
    to.py[i] = static_cast<float>(picture_y(job, scratch.places[i])) + 0.5F;
  }
}

FASTRT_INLINE void place_sample(const TileJob& job, int place, const SampleSet& set, int i,
                                SamplePlaces& to) {
  const int x = picture_x(job, place), y = picture_y(job, place);
  const SampleOffset offset =
      sample_offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), set);
  to.px[i] = (static_cast<float>(x) + 0.5F) + offset.x;
  to.py[i] = (static_cast<float>(y) + 0.5F) + offset.y;
  if (job.camera.kind != CameraKind::lens) return;
  const SampleOffset lens = lens_point(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), set);
  to.lens_a[i] = lens.x;
  to.lens_b[i] = lens.y;
}

FASTRT_INLINE SampleSet sample_set_of(const TileJob& job, int index) {
  return sample_set(static_cast<std::uint32_t>(index), job.filter, job.seed);
}

// Samples of pixels, row by row: the pixels' places in the tile, and the points of the sequence.
struct alignas(64) SampleRows {
  std::int32_t place[batch_size];
  std::uint32_t u[batch_size], v[batch_size];
  int count;
};

// In filters without a table. (A loop that compilers make SIMD of.)
template <FilterShape shape>
static void place_rows_in(const TileJob& job, const SampleRows& rows, SamplePlaces& to) noexcept {
  const int left = job.x, top = job.y, count = rows.count; // which no store to `to` can change
  const std::uint32_t seed = job.seed;
  for (int i = 0; i < count; ++i) {
    const int x = left + tile_pixel_x(rows.place[i]), y = top + tile_pixel_y(rows.place[i]);
    const std::uint32_t key = pixel_key(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed);
    const SampleOffset offset = offset_in<shape>({rows.u[i], rows.v[i]}, key);
    to.px[i] = (static_cast<float>(x) + 0.5F) + offset.x;
    to.py[i] = (static_cast<float>(y) + 0.5F) + offset.y;
  }
}

// Whether place_rows() knows where samples lie.
FASTRT_INLINE bool places_by_rows(const TileJob& job) {
  return job.filter.shape != FilterShape::table && job.camera.kind != CameraKind::lens;
}

FASTRT_INLINE void place_rows(const TileJob& job, const SampleRows& rows, SamplePlaces& to) {
  if (job.filter.shape == FilterShape::tent)
    place_rows_in<FilterShape::tent>(job, rows, to);
  else
    place_rows_in<FilterShape::box>(job, rows, to);
}

FASTRT_INLINE void place_samples(const TileJob& job, const TileScratch& scratch, int index,
                                 SamplePlaces& to) {
  const SampleSet set = sample_set_of(job, index);
  if (!places_by_rows(job)) {
    for (int i = 0; i < scratch.place_count; ++i) place_sample(job, scratch.places[i], set, i, to);
    return;
  }
  SampleRows rows;
  rows.count = scratch.place_count;
  __builtin_memcpy(rows.place, scratch.places, sizeof rows.place);
  for (int i = 0; i < rows.count; ++i) {
    rows.u[i] = set.point.u;
    rows.v[i] = set.point.v;
  }
  place_rows(job, rows, to);
}

// (first + du * px) + dv * py
FASTRT_INLINE CameraV image_point(const CameraView& camera, const SamplePlaces& places, int i) {
  return (broadcast3<CameraF>(camera.corner) +
          broadcast3<CameraF>(camera.du) * CameraF::load_aligned(places.px + i)) +
         broadcast3<CameraF>(camera.dv) * CameraF::load_aligned(places.py + i);
}

FASTRT_INLINE void aim(const CameraView& camera, CameraKind kind, const SamplePlaces& places, int i,
                       PathBatch& rays) {
  const CameraV point = image_point(camera, places, i);
  CameraV origin = broadcast3<CameraF>(camera.eye), dir = point;
  if (kind == CameraKind::orthographic) {
    origin = point;
    dir = broadcast3<CameraF>(camera.direction);
  } else if (kind == CameraKind::lens) {
    const CameraF a = CameraF::load_aligned(places.lens_a + i), b = CameraF::load_aligned(places.lens_b + i);
    origin = origin + (broadcast3<CameraF>(camera.lens_u) * a + broadcast3<CameraF>(camera.lens_v) * b);
    dir = dir - (broadcast3<CameraF>(camera.shift_u) * a + broadcast3<CameraF>(camera.shift_v) * b);
  }
  store3(origin, rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
  store3(dir, rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
}

// `count` rays through the places; pixels beyond the frame's edge get rays that can't hit anything. The
// caller says which row of `radiance` each adds to.
FASTRT_INLINE void aim_rays(const TileJob& job, CameraKind kind, const SamplePlaces& places, int count,
                            PathBatch& rays) {
  const ShadingView& scene = job.scene->shading;
  for (int i = 0; i < count; i += widest) {
    aim(job.camera, kind, places, i, rays);
    CameraF(0.0F).store_aligned(rays.t_min + i);
    CameraF(__builtin_inff()).store_aligned(rays.t_max + i);
    store3(broadcast3<CameraF>(1.0F, 1.0F, 1.0F), rays.weight_r + i, rays.weight_g + i, rays.weight_b + i);
    Ints<widest>(-1).store_aligned(rays.exclude + i);
    if (scene.has_textures != 0) CameraF(job.width).store_aligned(rays.width + i);
    if (scene.has_transmission == 0) continue;
    for (int k = 0; k < max_media; ++k) Ints<widest>(job.eye_media[k]).store_aligned(rays.media[k] + i);
  }
  rays.count = count;
  rays.shape = kind == CameraKind::lens           ? BatchShape::coherent
               : kind == CameraKind::orthographic ? BatchShape::parallel
                                                  : BatchShape::common_origin;
  rays.depth = 0;
}

// Sample `index` of the places, or with -1 their centres, seen through the middle of a lens.
FASTRT_INLINE void make_camera_rays(const TileJob& job, int index, const TileScratch& scratch,
                                    PathBatch& rays) {
  SamplePlaces places;
  CameraKind kind = job.camera.kind;
  if (index < 0)
    place_centers(job, scratch, places);
  else
    place_samples(job, scratch, index, places);
  if (index < 0 && kind == CameraKind::lens) kind = CameraKind::pinhole;
  aim_rays(job, kind, places, scratch.place_count, rays);
  __builtin_memcpy(rays.pixel, scratch.places, sizeof rays.pixel);
  if (is_whole(job)) return;
  for (int i = 0; i < scratch.place_count; ++i)
    if (!in_frame(job, scratch.places[i])) rays.t_max[i] = 0.0F;
}

// The rows of `scratch`, which all are in the frame: samples first .. last - 1 of each pixel.
FASTRT_INLINE void make_row_rays(const TileJob& job, int first, int last, const TileScratch& scratch,
                                 PathBatch& rays) {
  SamplePlaces places;
  const int samples = last - first;
  if (places_by_rows(job)) {
    std::uint32_t u[batch_size], v[batch_size];
    for (int k = 0; k < samples; ++k) {
      const SequencePoint point = sample_set_of(job, first + k).point;
      u[k] = point.u;
      v[k] = point.v;
    }
    SampleRows rows;
    rows.count = scratch.row_count;
    __builtin_memcpy(rows.place, scratch.row_places, sizeof rows.place);
    for (int i = 0; i < rows.count; i += samples)
      for (int k = 0; k < samples; ++k) {
        rows.u[i + k] = u[k];
        rows.v[i + k] = v[k];
      }
    place_rows(job, rows, places);
  } else {
    for (int i = 0; i < scratch.row_count; ++i)
      place_sample(job, scratch.row_places[i], sample_set_of(job, scratch.row_samples[i]), i, places);
  }
  for (int i = 0; i < scratch.row_count; ++i) rays.pixel[i] = i;
  aim_rays(job, job.camera.kind, places, scratch.row_count, rays);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
