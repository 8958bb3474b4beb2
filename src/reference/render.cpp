// SPDX-License-Identifier: Apache-2.0
#include "src/reference/render.hpp"

#include "src/film/adaptive.hpp"
#include "src/film/filter_table.hpp"
#include "src/film/frame.hpp"
#include "src/film/sampling.hpp"
#include "src/reference/photons.hpp"
#include "src/scene/threads.hpp"

#include <exception>
#include <span>
#include <utility>
#include <vector>

namespace fastrt {
namespace reference {
namespace {

struct Job {
  const Scene* scene;
  const HitFinder* finder;
  const RenderSettings* settings;
  CameraFrame camera;
  Filter filter;
  Crop part; // of the picture: the frame
  Footprint footprint;
  Surroundings around;
  const PhotonMap* caustics; // null: none
};

// lens: a point of the unit disk.
Ray camera_ray(const CameraFrame& camera, float px, float py, const Vec2& lens, const Footprint& footprint) {
  const Vec3 point = (camera.corner + px * camera.du) + py * camera.dv;
  Ray ray;
  ray.width = footprint.width;
  ray.spread = footprint.spread;
  if (camera.orthographic) {
    ray.origin = point;
    ray.direction = camera.direction;
  } else if (lens == Vec2(0.0F)) {
    ray.origin = camera.eye;
    ray.direction = point;
  } else {
    ray.origin = camera.eye + (lens.x * camera.lens_u + lens.y * camera.lens_v);
    ray.direction = point - (lens.x * camera.shift_u + lens.y * camera.shift_v);
  }
  return ray;
}

LightQuestion question_of(const Job& job, int x, int y, int sample) {
  LightQuestion question{};
  question.x = static_cast<std::uint32_t>(x);
  question.y = static_cast<std::uint32_t>(y);
  question.sample = static_cast<std::uint32_t>(sample);
  question.seed = job.settings->seed;
  return question;
}

// The ray through the pixel's centre and the lens's.
Vec3 trace_center(const Job& job, int x, int y, RayCounts& rays, Sight& sight) {
  ++rays.primary;
  const Ray ray = camera_ray(job.camera, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F,
                             Vec2(0.0F), job.footprint);
  return ray_trace(*job.scene, *job.finder, ray, *job.settings, job.around, question_of(job, x, y, 0),
                   job.caustics, rays, sight);
}

Vec3 trace_sample(const Job& job, int x, int y, int sample, RayCounts& rays, Sight& sight) {
  const auto column = static_cast<std::uint32_t>(x);
  const auto row = static_cast<std::uint32_t>(y);
  const SampleSet set = sample_set(static_cast<std::uint32_t>(sample), job.filter, job.settings->seed);
  const SampleOffset offset = sample_offset(column, row, set);
  SampleOffset lens{0.0F, 0.0F};
  if (job.camera.has_lens) lens = lens_point(column, row, set);
  ++rays.primary;
  const Ray ray = camera_ray(job.camera, (static_cast<float>(x) + 0.5F) + offset.x,
                             (static_cast<float>(y) + 0.5F) + offset.y, {lens.x, lens.y}, job.footprint);
  return ray_trace(*job.scene, *job.finder, ray, *job.settings, job.around, question_of(job, x, y, sample),
                   job.caustics, rays, sight);
}

std::size_t index_of(const Frame& frame, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x);
}

// Of pixel (x, y) of the frame.
void record_center(const Job& job, int x, int y, RayCounts& rays, Frame& frame) {
  const std::uint64_t rays_before = rays.total();
  Sight sight;
  trace_center(job, job.part.x0 + x, job.part.y0 + y, rays, sight);
  record_aovs(*job.scene, sight, rays.total() - rays_before, index_of(frame, x, y), frame);
}

// Adds samples first .. last - 1 to the sums of those in no lobe of the filter and of those in lobes.
void add_samples(const Job& job, int x, int y, int first, int last, RayCounts& rays, Frame& frame, Vec3& sum,
                 Vec3& lobe_sum) {
  for (int sample = first; sample < last; ++sample) {
    Sight sight;
    const Vec3 color = trace_sample(job, job.part.x0 + x, job.part.y0 + y, sample, rays, sight);
    Vec3& to = in_lobe(job.filter, static_cast<std::uint32_t>(sample)) ? lobe_sum : sum;
    to = to + color;
    if (sample == 0) frame.primitive[index_of(frame, x, y)] = sight.hit.primitive;
  }
}

Vec3 load(const Column<float>& values, std::size_t pixel) {
  return {values[3 * pixel], values[3 * pixel + 1], values[3 * pixel + 2]};
}

void store(const Vec3& value, std::size_t pixel, std::span<float> values) {
  for (int c = 0; c < 3; ++c) values[3 * pixel + static_cast<std::size_t>(c)] = value[c];
}

void render_pixel(const Job& job, int x, int y, RayCounts& rays, Frame& frame) {
  const std::size_t pixel = index_of(frame, x, y);
  const int count = job.settings->samples_per_pixel;
  if (count == 1) {
    const std::uint64_t rays_before = rays.total();
    Sight sight;
    store(trace_center(job, job.part.x0 + x, job.part.y0 + y, rays, sight), pixel, frame.rgb);
    frame.primitive[pixel] = sight.hit.primitive;
    record_aovs(*job.scene, sight, rays.total() - rays_before, pixel, frame);
    return;
  }
  if (!frame.aovs.empty()) record_center(job, x, y, rays, frame);
  Vec3 sum{0.0F};
  Vec3 lobe_sum{0.0F};
  add_samples(job, x, y, 0, count, rays, frame, sum, lobe_sum);
  const SampleWeights weights = sample_weights(job.filter, static_cast<std::uint32_t>(count));
  Vec3 color;
  for (int c = 0; c < 3; ++c) color[c] = resolve_channel(weights, sum[c], lobe_sum[c]);
  store(color, pixel, frame.rgb);
}

// One pixel's share of a round of adaptive sampling.
void refine_pixel(const Job& job, int x, int y, AdaptiveFilm& film, RayCounts& rays, Frame& frame) {
  const std::size_t pixel = index_of(frame, x, y);
  if (film.active()[pixel] == 0) return;
  if (film.first() == 0 && !frame.aovs.empty()) record_center(job, x, y, rays, frame);
  Vec3 sum = load(film.sum(), pixel);
  Vec3 lobe_sum = film.lobe_sum().empty() ? Vec3(0.0F) : load(film.lobe_sum(), pixel);
  add_samples(job, x, y, film.first(), film.last(), rays, frame, sum, lobe_sum);
  store(sum, pixel, film.sum());
  if (!film.lobe_sum().empty()) store(lobe_sum, pixel, film.lobe_sum());
}

// Calls render_one(x, y, rays) for every pixel of the frame, a row at a time.
template <class RenderOne>
void render_rows(const RenderSettings& settings, const Frame& frame, FrameProgress& progress,
                 const RenderOne& render_one) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(thread_count(settings.threads))
  for (int y = 0; y < frame.height; ++y) {
    try {
      if (progress.stopped()) continue;
      RayCounts rays;
      for (int x = 0; x < frame.width; ++x) render_one(x, y, rays);
      progress.part_done(rays);
    } catch (...) {
      progress.failed(std::current_exception());
    }
  }
}

void render_adaptively(const Job& job, FrameProgress& progress, Frame& frame) {
  AdaptiveFilm film(*job.settings, job.filter, frame);
  bool going_on = true;
  while (going_on && !progress.stopped()) {
    render_rows(*job.settings, frame, progress,
                [&](int x, int y, RayCounts& rays) { refine_pixel(job, x, y, film, rays, frame); });
    going_on = film.next_round();
  }
  progress.rest_is_done();
}

} // namespace

Frame render(const Scene& scene, const HitFinder& finder, const Camera& camera,
             const RenderSettings& settings) {
  if (settings.integrator == Integrator::forward) return render_forward(scene, finder, camera, settings);
  check(settings);
  const Crop part = part_with_margin(settings);
  const CameraFrame camera_frame = make_camera_frame(camera, settings.width, settings.height);
  Job job{&scene,
          &finder,
          &settings,
          camera_frame,
          filter_of(settings.filter),
          part,
          camera_footprint(camera_frame, settings.samples_per_pixel),
          surroundings_of(scene, finder, camera_frame, settings.width, settings.height),
          nullptr};
  Frame frame = black_frame(part.x1 - part.x0, part.y1 - part.y0, settings.aovs, settings.threads);
  PhotonPlan plan;
  if (settings.caustic_photons > 0) plan = plan_caustic_photons(scene, settings.caustic_photons);
  const std::vector<PhotonChunk> chunks = photon_chunks(plan);
  FrameProgress progress(settings,
                         frame.height * (1 + most_rounds(settings)) + static_cast<int>(chunks.size()));
  PhotonMap caustics;
  if (settings.caustic_photons > 0) {
    caustics = trace_caustics(scene, finder, job.around, plan, chunks, settings, progress);
    job.caustics = &caustics;
  }
  if (settings.adaptive > 0.0F)
    render_adaptively(job, progress, frame);
  else
    render_rows(settings, frame, progress,
                [&](int x, int y, RayCounts& rays) { render_pixel(job, x, y, rays, frame); });
  progress.finish(frame);
  return cut_out(std::move(frame), part, part_of(settings));
}

} // namespace reference

Frame render_reference(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  Frame frame = reference::render(scene, reference::BruteForce(scene), camera, settings);
  keep_pixels(settings, frame);
  return frame;
}

} // namespace fastrt
