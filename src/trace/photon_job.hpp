// SPDX-License-Identifier: Apache-2.0
// What the drivers hand to the kernels for some photons of one light, and the memory that a thread follows
// them in. Plain data.
#pragma once

#include "src/trace/tile_job.hpp"

namespace fastrt {

// Photons on their way, all of one depth.
struct alignas(64) PhotonBatch : PathBatch {
  alignas(64) float length[batch_size]; // of the way from the light
  float strength[batch_size]; // multiplies the weight, but does not say whether a photon is worth following
  std::uint32_t key[batch_size];
  std::uint32_t index[batch_size]; // of the photon among those of its light
  std::int32_t bent[batch_size];   // 1: it met a mirror or was bent
  bool scattered;                  // these left a diffuse surface
};

// PhotonLight.
struct EmissionView {
  std::uint32_t light, count; // photons
  float u[3], v[3], w[3];
  float cap_height;
  float middle[3], half_side;
  float flux[3];
  const std::uint16_t* cells;
  std::uint32_t cell_count;
};

// EyeProjection, and the part of the picture that is made.
struct EyeView {
  float origin[3], u[3], v[3], w[3], direction[3];
  float inverse_area;
  float largest_coordinate;      // of the origin
  std::int32_t media[max_media]; // that the eye is in, innermost first
  bool orthographic;
  int x_begin, y_begin, x_end, y_end;
};

// Photons that caustics are made of, as they were met.
inline constexpr int photon_store_size = 16 * batch_size;
struct PhotonStore {
  float point[3][photon_store_size], normal[3][photon_store_size], flux[3][photon_store_size];
  std::uint32_t index[photon_store_size], key[photon_store_size];
  int count;
};

struct PhotonJob {
  const SceneView* scene; // whose materials say that what bends light lets no straight light through
  EmissionView emission;
  EyeView eye;
  std::int64_t* film; // three sums a pixel (src/film/light_film.hpp); null: caustics are wanted
  std::uint32_t seed;
  std::uint32_t last; // photons from PhotonScratch::next on, up to last - 1
  int max_depth;
  float min_contribution;
};

// Two open batches a depth, up to three full ones that wait, and the one at hand.
FASTRT_INLINE constexpr int photon_batches(int max_depth) { return 5 * (max_depth + 2) + 1; }

// Rays from one batch that go on, before they join those of other batches.
struct PhotonScratch {
  TileScratch tile;
  PathBatch reflected, refracted, diffuse;
  PhotonStore store;
  // Photons that wait for others, by depth: those that have not scattered yet, and those that have.
  PhotonBatch* open[2][max_path_depth + 2];
  // Batches to be followed, the next on top, and those not in use.
  PhotonBatch* waiting[photon_batches(max_path_depth)];
  PhotonBatch* unused[photon_batches(max_path_depth)];
  int waiting_count, unused_count;
  std::uint32_t next; // photon to be sent out
};

} // namespace fastrt
