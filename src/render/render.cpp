// SPDX-License-Identifier: Apache-2.0
// The frame driver: tiles dealt out to threads, each thread with its own memory; one film write per tile.
#include "src/reference/render.hpp"

#include "src/film/adaptive.hpp"
#include "src/film/filter_table.hpp"
#include "src/film/frame.hpp"
#include "src/render/caustics.hpp"
#include "src/render/forward.hpp"
#include "src/render/part_done.hpp"
#include "src/render/srgb8_tile.hpp"
#include "src/scene/picture_limits.hpp"
#include "src/scene/threads.hpp"
#include "src/trace/point_media.hpp"

#include <fastrt/render.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace fastrt {
namespace {

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

CameraView view_of(const CameraFrame& camera) {
  CameraView view{};
  view.kind = camera.orthographic ? CameraKind::orthographic
              : camera.has_lens   ? CameraKind::lens
                                  : CameraKind::pinhole;
  copy(camera.eye, view.eye);
  copy(camera.corner, view.corner);
  copy(camera.du, view.du);
  copy(camera.dv, view.dv);
  copy(camera.direction, view.direction);
  copy(camera.lens_u, view.lens_u);
  copy(camera.lens_v, view.lens_v);
  copy(camera.shift_u, view.shift_u);
  copy(camera.shift_v, view.shift_v);
  return view;
}

TileJob make_job(const Tracer::Parts& parts, const CameraFrame& camera, const RenderSettings& settings,
                 const Crop& part, Frame& frame) {
  TileJob job{};
  job.scene = &parts.view;
  job.camera = view_of(camera);
  media_around(parts, camera, settings.width, settings.height, job.eye_media);
  const Footprint footprint = camera_footprint(camera, settings.samples_per_pixel);
  job.width = footprint.width;
  job.spread = footprint.spread;
  job.x_begin = part.x0;
  job.y_begin = part.y0;
  job.x_end = part.x1;
  job.y_end = part.y1;
  job.last_sample = settings.samples_per_pixel == 1 ? 0 : settings.samples_per_pixel;
  job.seed = settings.seed;
  job.filter = filter_of(settings.filter);
  job.light_samples = settings.light_samples;
  job.max_depth = settings.max_depth;
  job.min_contribution = settings.min_contribution;
  job.rgb = frame.rgb.data();
  job.primitive = frame.primitive.data();
  job.aovs = targets_of(frame);
  return job;
}

static_assert(most_bounces <= max_path_depth);

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

int tiles_along(int pixels) { return (pixels + tile_side - 1) / tile_side; }

int tile_count(const TileJob& job) {
  return tiles_along(job.x_end - job.x_begin) * tiles_along(job.y_end - job.y_begin);
}

TileJob job_of_tile(const TileJob& frame_job, int tile) {
  const int columns = tiles_along(frame_job.x_end - frame_job.x_begin);
  TileJob job = frame_job;
  job.x = job.x_begin + tile % columns * tile_side;
  job.y = job.y_begin + tile / columns * tile_side;
  return job;
}

// One thread's share of the tiles, until none is left. codes: of the frame, if it keeps nothing else.
void render_tiles(const Tracer::Parts& parts, const TileJob& frame_job, unsigned char* codes,
                  std::atomic<int>& next_tile, FrameProgress& progress) {
  TileMemory memory(frame_job.max_depth);
  Srgb8Tile pixels;
  const int count = tile_count(frame_job);
  while (!progress.stopped()) {
    const int tile = next_tile.fetch_add(1, std::memory_order_relaxed);
    if (tile >= count) return;
    TileRayCounts rays{};
    const TileJob job = job_of_tile(frame_job, tile);
    parts.kernels->render_tile(codes == nullptr ? job : pixels.alone(job), memory.scratch(), rays);
    if (codes != nullptr) pixels.put(job, codes);
    part_done(rays, progress);
  }
}

// A tile that nobody came to: black, and sees nothing.
void blacken(const TileJob& job, unsigned char* codes) {
  const int x_end = std::min(job.x + tile_side, job.x_end), y_end = std::min(job.y + tile_side, job.y_end);
  for (int y = job.y; y < y_end; ++y) {
    const std::ptrdiff_t row = std::ptrdiff_t{y - job.y_begin} * (job.x_end - job.x_begin) - job.x_begin;
    if (codes != nullptr) {
      std::fill(codes + 3 * (row + job.x), codes + 3 * (row + x_end), static_cast<unsigned char>(0));
      continue;
    }
    std::fill(job.rgb + 3 * (row + job.x), job.rgb + 3 * (row + x_end), 0.0F);
    std::fill(job.primitive + row + job.x, job.primitive + row + x_end, no_primitive);
  }
}

// All tiles, by all threads.
void render_all(const Tracer::Parts& parts, const TileJob& job, unsigned char* codes, int threads,
                FrameProgress& progress) {
  std::atomic<int> next_tile{0};
  const int team = thread_count(threads);
  place_threads(team);
#pragma omp parallel num_threads(team)
  {
    // Exceptions must not leave a parallel region.
    try {
      render_tiles(parts, job, codes, next_tile, progress);
    } catch (...) {
      progress.failed(std::current_exception());
    }
  }
  // Whoever took a tile has finished it.
  if (job.round.sum == nullptr)
    for (int tile = next_tile; tile < tile_count(job); ++tile) blacken(job_of_tile(job, tile), codes);
}

// Round by round, each of all tiles.
void render_adaptively(const Tracer::Parts& parts, TileJob job, const RenderSettings& settings, Frame& frame,
                       FrameProgress& progress) {
  AdaptiveFilm film(settings, job.filter, frame);
  bool going_on = true;
  while (going_on && !progress.stopped()) {
    job.first_sample = film.first();
    job.last_sample = film.last();
    job.round.active = film.first() == 0 ? nullptr : film.active().data();
    job.round.sum = film.sum().data();
    job.round.lobe_sum = film.lobe_sum().empty() ? nullptr : film.lobe_sum().data();
    render_all(parts, job, nullptr, settings.threads, progress);
    job.aovs = {};
    going_on = film.next_round();
  }
  progress.rest_is_done();
}

// Before any tile.
void show_caustics(Caustics& caustics, FrameProgress& progress, TileJob& job) {
  caustics.trace(progress);
  job.scene = &caustics.scene();
  job.caustics = &caustics.map();
}

Frame frame_memory(const RenderSettings& settings, const Crop& part) {
  const int width = part.x1 - part.x0, height = part.y1 - part.y0;
  if (settings.adaptive > 0.0F) return black_frame(width, height, settings.aovs, settings.threads);
  if (settings.pixel_format == PixelFormat::srgb8 && settings.aovs.empty())
    return make_srgb8_frame(width, height);
  return make_frame(width, height, settings.aovs, settings.threads);
}

Frame render_pixels(const Tracer& tracer, const Camera& camera, const RenderSettings& settings) {
  const Tracer::Parts& parts = tracer.parts();
  if (parts.scalar_bvh && parts.view.geometry.culls == 0)
    return render_reference(parts.scene, camera, settings);
  if (parts.scalar_bvh) return reference::render(parts.scene, *parts.scalar_bvh, camera, settings);
  if (settings.integrator == Integrator::forward) return render_forward(tracer, camera, settings);
  check(settings);
  const CameraFrame camera_frame = make_camera_frame(camera, settings.width, settings.height);
  const Crop part = part_with_margin(settings);
  Frame frame = frame_memory(settings, part);
  TileJob job = make_job(parts, camera_frame, settings, part, frame);
  std::optional<Caustics> caustics;
  if (settings.caustic_photons > 0) caustics.emplace(parts, settings);
  FrameProgress progress(settings,
                         tile_count(job) * (1 + most_rounds(settings)) + (caustics ? caustics->parts() : 0));
  if (caustics) show_caustics(*caustics, progress, job);
  if (settings.adaptive > 0.0F)
    render_adaptively(parts, job, settings, frame, progress);
  else
    render_all(parts, job, frame.srgb8.data(), settings.threads, progress);
  progress.finish(frame);
  return cut_out(std::move(frame), part, part_of(settings));
}

} // namespace

Frame render(const Tracer& tracer, const Camera& camera, const RenderSettings& settings) {
  Frame frame = render_pixels(tracer, camera, settings);
  keep_pixels(settings, frame);
  return frame;
}

} // namespace fastrt
