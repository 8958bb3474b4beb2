// SPDX-License-Identifier: Apache-2.0
// What one instruction set offers: the same functions from the same text, compiled per ISA. Whoever traces
// picks a table once; a call then does a batch or a tile, never a single ray.
#pragma once

#include "src/trace/photon_job.hpp"
#include "src/trace/ray_batch.hpp"
#include "src/trace/scene_view.hpp"
#include "src/trace/tile_job.hpp"

#include <cstddef>
#include <cstdint>

namespace fastrt {

// Many independent ray-primitive pairs as columns; for tests and benchmarks of the kernels themselves. count
// is a multiple of 16. primitive: nine columns ax ay az bx .. cz for triangles, four (x y z radius) for
// spheres, six (lower xyz, upper xyz) for boxes.
struct PairColumns {
  const float* primitive[9];
  const float* origin[3];
  const float* dir[3];
  const float* t_min;
  std::size_t count;
};

struct KernelTable {
  // rays.count rays; hits of those. Rows up to the next multiple of 16 may be written.
  void (*closest_hits)(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept;
  // Only whether primitive >= 0 means anything in `hits`.
  void (*any_hits)(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept;
  // (u, v) of the hits of a batch: 0 for misses.
  void (*hit_weights)(const ShadingView& scene, const RayBatch& rays, const HitBatch& hits, float* u,
                      float* v) noexcept;
  void (*render_tile)(const TileJob& job, TileScratch& scratch, TileRayCounts& counts) noexcept;
  // Follows the job's photons. Returns whether some are left because the store is full: to be called again
  // when it has been emptied.
  bool (*trace_photons)(const PhotonJob& job, PhotonScratch& scratch, TileRayCounts& counts) noexcept;

  // hit[i] is 1 where pair i meets at t_min < t[i] < infinity (t: 0 elsewhere). u and v: weights, or null.
  void (*meet_triangles)(const PairColumns& pairs, std::uint8_t* hit, float* t, float* u, float* v) noexcept;
  void (*meet_spheres)(const PairColumns& pairs, std::uint8_t* hit, float* t) noexcept;
  // hit[i] is 1 where the box may not be culled.
  void (*meet_boxes)(const PairColumns& pairs, std::uint8_t* hit) noexcept;
  // Elementwise pow and exp; count is a multiple of 16.
  void (*powers)(const float* x, const float* y, float* out, std::size_t count) noexcept;
  void (*exponentials)(const float* x, float* out, std::size_t count) noexcept;
};

namespace sse42 {
const KernelTable& kernel_table() noexcept;
}
namespace avx2 {
const KernelTable& kernel_table() noexcept;
}
namespace avx512 {
const KernelTable& kernel_table() noexcept;
}

} // namespace fastrt
