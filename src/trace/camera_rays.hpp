// SPDX-License-Identifier: Apache-2.0
// The rays of one sample of every pixel of a tile (docs/numerics.md, "Camera and samples").
#pragma once

#include "src/film/sampling.hpp"
#include "src/kernels/vec3.hpp"
#include "src/trace/tile_job.hpp"
#include "src/trace/tile_order.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Where sample `index` of the tile's pixels lies on the image; -1: their centres.
FASTRT_INLINE void place_samples(const TileJob& job, int index, float* px, float* py) {
  for (int i = 0; i < batch_size; ++i) {
    const int x = job.x + tile_pixel_x(i);
    const int y = job.y + tile_pixel_y(i);
    px[i] = static_cast<float>(x) + 0.5F;
    py[i] = static_cast<float>(y) + 0.5F;
    if (index < 0) continue;
    const SampleOffset offset = sample_offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                              static_cast<std::uint32_t>(index),
                                              static_cast<std::uint32_t>(job.samples), job.seed, job.tent);
    px[i] = px[i] + offset.x;
    py[i] = py[i] + offset.y;
  }
}

// Pixels beyond the frame's edge get rays that can't hit anything.
FASTRT_INLINE void make_camera_rays(const TileJob& job, int index, PathBatch& rays) {
  using F = Floats<widest>;
  alignas(64) float px[batch_size];
  alignas(64) float py[batch_size];
  place_samples(job, index, px, py);
  const V3<F> eye = broadcast3<F>(job.eye), corner = broadcast3<F>(job.corner);
  const V3<F> du = broadcast3<F>(job.du), dv = broadcast3<F>(job.dv);
  for (int i = 0; i < batch_size; i += widest) {
    const V3<F> dir = (corner + du * load<F>(px + i)) + dv * load<F>(py + i);
    store3(eye, rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    store3(dir, rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    F(0.0F).store_aligned(rays.t_min + i);
    store3(broadcast3<F>(1.0F, 1.0F, 1.0F), rays.weight_r + i, rays.weight_g + i, rays.weight_b + i);
    Ints<widest>(-1).store_aligned(rays.exclude + i);
    F(0.0F).store_aligned(rays.width + i);
    for (auto& medium : rays.media) Ints<widest>(-1).store_aligned(medium + i);
  }
  for (int i = 0; i < batch_size; ++i) {
    const bool in_frame = job.x + tile_pixel_x(i) < job.width && job.y + tile_pixel_y(i) < job.height;
    rays.t_max[i] = in_frame ? __builtin_inff() : 0.0F;
    rays.pixel[i] = i;
  }
  rays.count = batch_size;
  rays.shape = BatchShape::common_origin;
  rays.depth = 0;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
