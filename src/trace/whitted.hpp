// SPDX-License-Identifier: Apache-2.0
// The Whitted loop of a batch of camera rays: an explicit stack of ray batches, no recursion. A batch's own
// light is added first, then everything below its reflected rays, then everything below its refracted ones:
// the reflected batch goes on top. A batch holds at most one ray per row of `radiance`, so each gets its
// contributions in that order.
#pragma once

#include "src/trace/aov.hpp"
#include "src/trace/caustics.hpp"
#include "src/trace/secondary.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// 0, 1, 2 ..
struct alignas(64) LaneNumbers {
  std::int32_t lane[widest];
};
inline constexpr LaneNumbers lane_numbers = [] {
  LaneNumbers numbers{};
  for (int i = 0; i < widest; ++i) numbers.lane[i] = i;
  return numbers;
}();

// Whether rays i .. belong to pixels one after the other, as camera rays do.
FASTRT_INLINE bool are_in_a_row(const PathBatch& rays, int i) {
  const PathI expected = PathI::load_aligned(lane_numbers.lane) + PathI(rays.pixel[i]);
  const PathM same = simd::bool_cast(PathI::load_aligned(rays.pixel + i) == expected);
  return to_bits(same) == register_bits;
}

// acc = acc + weight * light, for the lanes in `bits`.
FASTRT_INLINE void accumulate(const PathBatch& rays, const PathV& weight, const PathV& light,
                              std::uint32_t bits, int i, TileScratch& scratch) {
  if (are_in_a_row(rays, i)) {
    const int first = rays.pixel[i];
    float* const r = scratch.radiance_r + first;
    float* const g = scratch.radiance_g + first;
    float* const b = scratch.radiance_b + first;
    const PathV sum = load3<PathF>(r, g, b);
    store3(select(from_bits<widest>(bits), sum + weight * light, sum), r, g, b);
    return;
  }
  alignas(64) float added[3][widest];
  store_lanes(weight * light, added);
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    const int pixel = rays.pixel[i + lane];
    scratch.radiance_r[pixel] = scratch.radiance_r[pixel] + added[0][lane];
    scratch.radiance_g[pixel] = scratch.radiance_g[pixel] + added[1][lane];
    scratch.radiance_b[pixel] = scratch.radiance_b[pixel] + added[2][lane];
  }
}

FASTRT_INLINE PathV load_weight(const PathBatch& rays, int i) {
  return load3<PathF>(rays.weight_r + i, rays.weight_g + i, rays.weight_b + i);
}

// Light fades on its way through a medium: weight = weight * exp(-(sigma * distance)).
FASTRT_INLINE void fade(const ShadingView& scene, PathBatch& rays, const HitBatch& hits, std::uint32_t bits,
                        int i) {
  alignas(64) float sigma[3][widest] = {};
  std::uint32_t fading = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    const std::int32_t medium = rays.media[0][i + lane];
    if (medium < 0 || scene.materials[medium].has_absorption == 0) continue;
    fading |= 1U << lane;
    for (int c = 0; c < 3; ++c) sigma[c][lane] = scene.materials[medium].absorption[c];
  }
  if (fading == 0) return;
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  const PathF distance = PathF::load_aligned(hits.t + i) * sqrt(dot(dir, dir));
  const PathV weight = load_weight(rays, i);
  using Ops = BatchOps<widest>;
  const auto left = [&](int c) { return shared_exp<Ops>(negate(PathF::load_aligned(sigma[c]) * distance)); };
  const PathV faded = weight * PathV{left(0), left(1), left(2)};
  store3(select(from_bits<widest>(fading), faded, weight), rays.weight_r + i, rays.weight_g + i,
         rays.weight_b + i);
}

// E = Ke + g * L, or Ke + Kd for an unlit material, for the lanes in `bits`.
FASTRT_INLINE PathV emitted_light(const ShadingView& scene, const SurfaceBatch& s, std::uint32_t bits,
                                  int i) {
  PathV light = broadcast3<PathF>(0.0F, 0.0F, 0.0F);
  const PathV local = load3<PathF>(s.local_r + i, s.local_g + i, s.local_b + i);
  for_each_material(
      scene, s.material + i, bits, [&](const MaterialRow& row, const PathM& mask, std::uint32_t) {
        const bool varies = row.textures != nullptr;
        const PathV kd = varies ? load3<PathF>(s.diffuse_r + i, s.diffuse_g + i, s.diffuse_b + i)
                                : broadcast3<PathF>(row.diffuse);
        const PathV ke = varies ? load3<PathF>(s.emission_r + i, s.emission_g + i, s.emission_b + i)
                                : broadcast3<PathF>(row.emission);
        const PathF opacity = varies ? PathF::load_aligned(s.opacity + i) : PathF(row.opacity);
        const PathV reflected = row.unlit != 0 ? kd : local * opacity;
        light = select(mask, ke + reflected, light);
      });
  return light;
}

// What the batch's rays see: the background where they miss, and the surfaces that lighting and secondary
// rays need.
static void see_surfaces(const TileJob& job, PathBatch& rays, TileScratch& scratch) noexcept {
  const SceneView& scene = *job.scene;
  const PathV background = broadcast3<PathF>(scene.shading.background);
  for (int i = 0; i < rays.count; i += widest) {
    const std::uint32_t bits = hit_bits(rays, scratch.hits, i);
    const std::uint32_t in_batch = lanes_in(rays.count - i);
    if (bits != in_batch) accumulate(rays, load_weight(rays, i), background, in_batch & ~bits, i, scratch);
    scratch.surface.shaded[i / widest] = 0;
    if (bits == 0) continue;
    find_surfaces(scene.shading, rays, scratch.hits, bits, i, scratch.surface);
    if (scene.shading.has_textures != 0)
      texture_surfaces(scene.shading, rays, scratch.hits, job.spread, bits, i, scratch.surface);
    if (scene.shading.has_absorption != 0) fade(scene.shading, rays, scratch.hits, bits, i);
    begin_local_light(scene.shading, bits, i, scratch.surface);
  }
}

FASTRT_INLINE PathBatch& take_batch(TileScratch& scratch, int depth) {
  PathBatch& batch = *scratch.unused[--scratch.unused_count];
  batch.count = 0;
  batch.depth = depth;
  batch.shape = BatchShape::coherent;
  return batch;
}
FASTRT_INLINE void give_back(TileScratch& scratch, PathBatch& batch) {
  scratch.unused[scratch.unused_count++] = &batch;
}
FASTRT_INLINE void push(TileScratch& scratch, PathBatch& batch) {
  if (batch.count == 0)
    give_back(scratch, batch);
  else
    scratch.waiting[scratch.waiting_count++] = &batch;
}

// Moves what questions took to where a tile counts it.
FASTRT_INLINE void take_tests(HitBatch& hits, TileTestCounts& counts) {
  counts.boxes += hits.boxes;
  counts.primitives += hits.primitives;
  hits.boxes = hits.primitives = 0;
}

// Those of a batch of some depth and of its shadow rays.
FASTRT_INLINE void take_tests(int depth, TileScratch& scratch, TileRayCounts& counts) {
  take_tests(scratch.hits, depth == 0 ? counts.primary_tests : counts.secondary_tests);
  take_tests(scratch.shadow_hits, counts.shadow_tests);
}

// One batch: its light, and its children onto the stack.
static void trace_paths(const TileJob& job, PathBatch& rays, TileScratch& scratch,
                        TileRayCounts& counts) noexcept {
  const SceneView& scene = *job.scene;
  find_closest_hits(scene.geometry, rays, scratch.hits);
  see_surfaces(job, rays, scratch);
  counts.shadow += gather_light(job, rays, scratch);
  if (job.caustics != nullptr) gather_caustics(job, rays, scratch);
  take_tests(rays.depth, scratch, counts);
  if (scratch.recording) record_batch(job, rays, scratch);
  for (int i = 0; i < rays.count; i += widest) {
    const std::uint32_t bits = hit_bits(rays, scratch.hits, i);
    if (bits == 0) continue;
    const PathV light = emitted_light(scene.shading, scratch.surface, bits, i);
    accumulate(rays, load_weight(rays, i), light, bits, i, scratch);
  }
  if (rays.depth >= job.max_depth || scene.shading.sends_on == 0) return;
  PathBatch& refracted = take_batch(scratch, rays.depth + 1);
  PathBatch& reflected = take_batch(scratch, rays.depth + 1);
  make_secondary_rays(job, rays, scratch, reflected, refracted);
  counts.reflected += static_cast<std::uint64_t>(reflected.count);
  counts.refracted += static_cast<std::uint64_t>(refracted.count);
  push(scratch, refracted);
  push(scratch, reflected);
}

// What the pixels see: in an instance, the primitive that it shows.
FASTRT_INLINE void keep_first(const ShapeView& shapes, TileScratch& scratch) {
  if (scratch.row_count != 0) {
    for (int row = 0; row < scratch.row_count; row += scratch.rows_per_place)
      scratch.first_primitive[scratch.row_places[row]] = shown_primitive(shapes, scratch.hits, row);
    return;
  }
  __builtin_memcpy(scratch.first_primitive, scratch.hits.primitive, sizeof scratch.first_primitive);
  if (shapes.instance_count == 0) return;
  for (int i = 0; i < batch_size; ++i) scratch.first_primitive[i] = shown_primitive(shapes, scratch.hits, i);
}

// All that follows from a batch of camera rays. first: the primitives that they see are to be kept.
static void trace_tree(const TileJob& job, PathBatch& camera_rays, bool first, TileScratch& scratch,
                       TileRayCounts& counts) noexcept {
  push(scratch, camera_rays);
  while (scratch.waiting_count != 0) {
    PathBatch& batch = *scratch.waiting[--scratch.waiting_count];
    trace_paths(job, batch, scratch, counts);
    if (first) keep_first(job.scene->shading.shapes, scratch);
    first = false;
    give_back(scratch, batch);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
