// SPDX-License-Identifier: Apache-2.0
// What the frame driver hands to the kernels for one tile, and the memory that a thread works in. Plain data.
#pragma once

#include "src/film/sampling.hpp"
#include "src/trace/photon_map_view.hpp"
#include "src/trace/ray_batch.hpp"
#include "src/trace/scene_view.hpp"

#include <cstdint>

namespace fastrt {

inline constexpr int max_path_depth = 64;

// Rays on the way through the scene, all of one depth. Each belongs to a pixel of the tile.
struct alignas(64) PathBatch : RayBatch {
  float weight_r[batch_size], weight_g[batch_size], weight_b[batch_size];
  std::int32_t media[max_media]
                    [batch_size]; // materials, innermost first; -1: none. Kept when the scene refracts.
  std::int32_t pixel[batch_size]; // row of `radiance`: the place in the tile's order, or a row of take_rows()
  float width[batch_size];        // of the ray's footprint where it starts. Kept when the scene has textures.
  int depth;
};

// The surfaces that a batch of rays hit, row i for ray i. The names are those of docs/numerics.md.
struct alignas(64) SurfaceBatch {
  float point_x[batch_size], point_y[batch_size], point_z[batch_size];
  float geometric_x[batch_size], geometric_y[batch_size], geometric_z[batch_size]; // ng
  float shading_x[batch_size], shading_y[batch_size], shading_z[batch_size];       // ns
  float viewer_x[batch_size], viewer_y[batch_size], viewer_z[batch_size];          // c
  float magnitude[batch_size];                                                     // M
  float local_r[batch_size], local_g[batch_size], local_b[batch_size];             // L
  // Of materials with textures alone: their terms at the point, and the footprint's width.
  float ambient_r[batch_size], ambient_g[batch_size], ambient_b[batch_size];
  float diffuse_r[batch_size], diffuse_g[batch_size], diffuse_b[batch_size];
  float specular_r[batch_size], specular_g[batch_size], specular_b[batch_size];
  float emission_r[batch_size], emission_g[batch_size], emission_b[batch_size];
  float opacity[batch_size];
  float width[batch_size];
  std::int32_t material[batch_size];
  std::int32_t planar[batch_size]; // the primitive (or instance), where a secondary ray must exclude it; else
                                   // -1
  // Of scenes with instances alone: the primitive to exclude in the instance, and the map's growth.
  std::int32_t planar_inner[batch_size];
  float growth[batch_size];
  std::uint32_t shaded[batch_size / 4]; // per packet: bits of the rays whose surfaces answer light
};

// A light as the surfaces of a batch see it.
struct alignas(64) LightBatch {
  float to_light_x[batch_size], to_light_y[batch_size], to_light_z[batch_size];
  float cosine[batch_size];
  float strength[batch_size];                         // of lights whose strength varies
  std::uint32_t key_u[batch_size], key_v[batch_size], // of lights with a size: what shifts their samples,
      first[batch_size];                              // and the stratum that the first of them comes into
  float position_x[batch_size], position_y[batch_size],
      position_z[batch_size]; // of lights with a size: the point asked
  float normal_x[batch_size], normal_y[batch_size], normal_z[batch_size];    // of meshes: there
  float visible_r[batch_size], visible_g[batch_size], visible_b[batch_size]; // S
};

// What AOVs need to know of a tile's camera rays and of all that follows from them; by place in the tile.
struct AovScratch {
  float u[batch_size], v[batch_size];                            // of the hits
  float lit_r[batch_size], lit_g[batch_size], lit_b[batch_size]; // sum of S over the lights with shadows
  std::int32_t rays[batch_size], deepest[batch_size];
};

// Where a frame keeps its AOVs; null for those that are not asked for.
struct AovTargets {
  std::int32_t *object, *primitive, *material, *recursion, *cost;
  float *depth, *normal, *position, *uv, *albedo, *shadow;
  bool any; // whether any is asked for
};

struct TileScratch {
  HitBatch hits, shadow_hits;
  SurfaceBatch surface;
  LightBatch light;
  RayBatch shadow;
  std::int32_t shadow_media[max_media][batch_size]; // as PathBatch::media. Kept in scenes that absorb.
  float radiance_r[batch_size], radiance_g[batch_size], radiance_b[batch_size]; // of one sample
  float sum_r[batch_size], sum_g[batch_size], sum_b[batch_size];
  float lobe_r[batch_size], lobe_g[batch_size], lobe_b[batch_size]; // of samples in the filter's lobes
  std::int32_t places[batch_size]; // in the tile, of the pixels that get samples
  int place_count;
  // Of several samples of few pixels in one batch: the place and the sample of each row of `radiance`, those
  // of a place side by side and in order.
  std::int32_t row_places[batch_size], row_samples[batch_size];
  int row_count, rows_per_place;
  std::int32_t first_primitive[batch_size];
  std::int32_t sample; // that is being traced, where row_count is 0
  bool recording;      // AOVs, while the rays of the pixels' centres are traced
  AovScratch aov;
  // The explicit stack: batches waiting, the next on top, and those not in use.
  PathBatch* waiting[max_path_depth + 4];
  PathBatch* unused[max_path_depth + 4];
  int waiting_count, unused_count;
};

enum class CameraKind : std::uint32_t { pinhole, orthographic, lens };

// CameraFrame.
struct CameraView {
  CameraKind kind;
  float eye[3], corner[3], du[3], dv[3];
  float direction[3];
  float lens_u[3], lens_v[3], shift_u[3], shift_v[3];
};

// One round of adaptive sampling; all null otherwise. Three floats a pixel of the frame.
struct RoundView {
  const std::uint8_t* active; // null: all pixels
  float *sum, *lobe_sum;
};

struct TileJob {
  const SceneView* scene;
  CameraView camera;
  std::int32_t eye_media[max_media]; // that camera rays start in, innermost first
  float width, spread; // of a footprint at a camera ray's origin, and what it grows by per unit of length
  int x, y;            // the tile's upper left pixel, in the picture
  int x_begin, y_begin, x_end, y_end; // the part of the picture that the frame is
  int first_sample, last_sample;      // to take: first .. last - 1; 0 .. 0: the pixels' centres
  std::uint32_t seed;
  Filter filter;
  RoundView round;
  int light_samples; // of each light with a size
  int max_depth;
  float min_contribution;
  float* rgb;              // of the frame
  std::int32_t* primitive; // of the frame
  AovTargets aovs;
  const PhotonMapView* caustics; // null: none
};

struct TileTestCounts {
  std::uint64_t boxes, primitives; // as HitBatch counts
};

struct TileRayCounts {
  std::uint64_t primary, shadow, reflected, refracted;
  TileTestCounts primary_tests, shadow_tests, secondary_tests;
};

} // namespace fastrt
