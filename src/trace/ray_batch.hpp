// SPDX-License-Identifier: Apache-2.0
// The unit that rays travel in: up to 256 rays as columns, the same on every ISA.
#pragma once

#include <cstdint>

namespace fastrt {

inline constexpr int tile_side = 16;                     // pixels
inline constexpr int batch_size = tile_side * tile_side; // rays
inline constexpr int group_size = 16;                    // rays that are culled together: 4 x 4 pixels
inline constexpr int batch_groups = batch_size / group_size;

// What is known of the rays of a batch. It decides how they are traced, never what they hit.
enum class BatchShape : std::uint32_t {
  any,
  coherent,           // neighbours are alike
  common_origin,      // all origins are equal, and neighbours point to places side by side
  parallel,           // all directions are equal, and neighbours begin side by side
  scattered_origin,   // all origins are equal; neighbours may well point to places far apart
  scattered_parallel, // all directions are equal; neighbours may well begin far apart
};

// Rays 0 .. count - 1 are live. A ray hits what lies in t_min < t < t_max and is not the primitive `exclude`.
// Where that is an instance, the ray does not hit the primitive `exclude_inner` in it; elsewhere
// `exclude_inner` means nothing.
struct alignas(64) RayBatch {
  float origin_x[batch_size], origin_y[batch_size], origin_z[batch_size];
  float dir_x[batch_size], dir_y[batch_size], dir_z[batch_size];
  float t_min[batch_size], t_max[batch_size];
  std::int32_t exclude[batch_size]; // -1: none
  std::int32_t exclude_inner[batch_size];
  int count;
  BatchShape shape;
};

// Closest hits of a batch: t = t_max and primitive = -1 on a miss. Where the primitive is an instance,
// `inner` is what it shows; elsewhere that means nothing.
struct alignas(64) HitBatch {
  float t[batch_size];
  std::int32_t primitive[batch_size];
  std::int32_t inner[batch_size];
  // What it took, added to by every question: boxes that a ray, or rays that went together, were held
  // against, and pairs of a ray and a primitive.
  std::uint64_t boxes, primitives;
  std::uint64_t lone; // within a question: nodes that lone rays met, times 2^32, and runs of blocks
};

} // namespace fastrt
