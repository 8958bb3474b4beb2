// SPDX-License-Identifier: Apache-2.0
// The frame driver: tiles dealt out to threads, each thread with its own memory; one film write per tile.
#include "src/reference/render.hpp"

#include "src/film/frame.hpp"
#include "src/scene/threads.hpp"
#include "src/trace/tracer_parts.hpp"

#include <fastrt/render.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <vector>

namespace fastrt {
namespace {

void copy(const Vec3& from, float (&to)[3]) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

AovTargets targets_of(Frame& frame) {
  AovTargets to{};
  std::int32_t** const ids[] = {&to.object, &to.primitive, &to.material, &to.recursion, &to.cost};
  constexpr Aov ids_of[] = {Aov::id, Aov::primitive, Aov::material, Aov::recursion, Aov::cost};
  float** const values[] = {&to.depth, &to.normal, &to.position, &to.uv, &to.albedo, &to.shadow};
  constexpr Aov values_of[] = {Aov::depth, Aov::normal, Aov::position, Aov::uv, Aov::albedo, Aov::shadow};
  for (AovPlane& plane : frame.aovs) {
    for (std::size_t i = 0; i < std::size(ids); ++i)
      if (plane.aov == ids_of[i]) *ids[i] = plane.ids.data();
    for (std::size_t i = 0; i < std::size(values); ++i)
      if (plane.aov == values_of[i]) *values[i] = plane.values.data();
  }
  to.any = !frame.aovs.empty();
  return to;
}

TileJob make_job(const Tracer::Parts& parts, const CameraFrame& camera, const RenderSettings& settings,
                 Frame& frame) {
  TileJob job{};
  job.scene = &parts.view;
  copy(camera.eye, job.eye);
  copy(camera.corner, job.corner);
  copy(camera.du, job.du);
  copy(camera.dv, job.dv);
  job.spread = footprint_spread(camera, settings.samples_per_pixel);
  job.width = settings.width;
  job.height = settings.height;
  job.samples = settings.samples_per_pixel;
  job.seed = settings.seed;
  job.tent = settings.filter == PixelFilter::tent;
  job.max_depth = std::clamp(settings.max_depth, 0, max_path_depth);
  job.min_contribution = settings.min_contribution;
  job.rgb = frame.rgb.data();
  job.primitive = frame.primitive.data();
  job.aovs = targets_of(frame);
  return job;
}

// A thread's memory: the scratch and as many batches as the stack can hold at once (one waiting per depth,
// and the batch at hand with its two children).
class TileMemory {
public:
  explicit TileMemory(int max_depth)
      : scratch_(std::make_unique<TileScratch>()), batches_(static_cast<std::size_t>(max_depth) + 3) {
    scratch_->recording = false;
    scratch_->waiting_count = 0;
    scratch_->unused_count = 0;
    for (PathBatch& batch : batches_) scratch_->unused[scratch_->unused_count++] = &batch;
  }
  TileScratch& scratch() { return *scratch_; }

private:
  std::unique_ptr<TileScratch> scratch_;
  std::vector<PathBatch> batches_;
};

RayCounts to_counts(const TileRayCounts& rays) {
  return {rays.primary, rays.shadow, rays.reflected, rays.refracted};
}

// One thread's share of the tiles, until none is left.
void render_tiles(const Tracer::Parts& parts, const TileJob& frame_job, int tile_columns, int tile_count,
                  std::atomic<int>& next_tile, FrameProgress& progress) {
  TileMemory memory(frame_job.max_depth);
  while (!progress.stopped()) {
    const int tile = next_tile.fetch_add(1, std::memory_order_relaxed);
    if (tile >= tile_count) return;
    TileJob job = frame_job;
    job.x = tile % tile_columns * tile_side;
    job.y = tile / tile_columns * tile_side;
    TileRayCounts rays{};
    parts.kernels->render_tile(job, memory.scratch(), rays);
    progress.part_done(to_counts(rays));
  }
}

} // namespace

Frame render(const Tracer& tracer, const Camera& camera, const RenderSettings& settings) {
  const Tracer::Parts& parts = tracer.parts();
  if (parts.scalar_bvh) return reference::render(parts.scene, *parts.scalar_bvh, camera, settings);
  check(settings);
  const CameraFrame camera_frame = make_camera_frame(camera, settings.width, settings.height);
  Frame frame = black_frame(settings.width, settings.height, settings.aovs);
  const TileJob job = make_job(parts, camera_frame, settings, frame);
  const int columns = (settings.width + tile_side - 1) / tile_side;
  const int rows = (settings.height + tile_side - 1) / tile_side;
  FrameProgress progress(settings, columns * rows);
  std::atomic<int> next_tile{0};
#pragma omp parallel num_threads(thread_count(settings.threads))
  {
    // Exceptions must not leave a parallel region.
    try {
      render_tiles(parts, job, columns, columns * rows, next_tile, progress);
    } catch (...) {
      progress.failed(std::current_exception());
    }
  }
  progress.finish(frame);
  return frame;
}

} // namespace fastrt
