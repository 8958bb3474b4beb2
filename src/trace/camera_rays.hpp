// SPDX-License-Identifier: Apache-2.0
// The rays of one sample of every pixel of a tile (docs/numerics.md, "Camera and samples").
#pragma once

#include "src/trace/sample_places.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

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
  if (index < 0) {
    place_centers(job, scratch, places);
    if (kind == CameraKind::lens) kind = CameraKind::pinhole;
  } else {
    place_samples(job, scratch.places, scratch.place_count, index, 1, places);
  }
  aim_rays(job, kind, places, scratch.place_count, rays);
  __builtin_memcpy(rays.pixel, scratch.places, sizeof rays.pixel);
  if (is_whole(job)) return;
  for (int i = 0; i < scratch.place_count; ++i)
    if (!in_frame(job, scratch.places[i])) rays.t_max[i] = 0.0F;
}

// The rows of `scratch`, which all are in the frame: of samples from number `first` on.
FASTRT_INLINE void make_row_rays(const TileJob& job, int first, const TileScratch& scratch, PathBatch& rays) {
  SamplePlaces places;
  place_samples(job, scratch.row_places, scratch.row_count, first, scratch.rows_per_place, places);
  for (int i = 0; i < scratch.row_count; ++i) rays.pixel[i] = i;
  aim_rays(job, job.camera.kind, places, scratch.row_count, rays);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
