// SPDX-License-Identifier: Apache-2.0
#include "src/reference/render.hpp"

#include "src/film/frame.hpp"
#include "src/film/sampling.hpp"
#include "src/scene/threads.hpp"

#include <exception>

namespace fastrt {
namespace reference {
namespace {

struct Job {
  const Scene* scene;
  const HitFinder* finder;
  const RenderSettings* settings;
  CameraFrame camera;
  float spread; // of the rays' footprints
};

Ray camera_ray(const CameraFrame& camera, float px, float py, float spread) {
  Ray ray;
  ray.spread = spread;
  ray.origin = camera.eye;
  ray.direction = (camera.corner + px * camera.du) + py * camera.dv;
  return ray;
}

// The ray through the pixel's centre: its colour; its AOVs go into the frame.
Vec3 trace_center(const Job& job, int x, int y, RayCounts& rays, Sight& sight) {
  ++rays.primary;
  const Ray ray =
      camera_ray(job.camera, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, job.spread);
  return ray_trace(*job.scene, *job.finder, ray, *job.settings, rays, sight);
}

Vec3 trace_sample(const Job& job, int x, int y, int sample, RayCounts& rays, Sight& sight) {
  const RenderSettings& settings = *job.settings;
  const SampleOffset offset = sample_offset(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                            static_cast<std::uint32_t>(sample),
                                            static_cast<std::uint32_t>(settings.samples_per_pixel),
                                            settings.seed, settings.filter == PixelFilter::tent);
  ++rays.primary;
  const Ray ray = camera_ray(job.camera, (static_cast<float>(x) + 0.5F) + offset.x,
                             (static_cast<float>(y) + 0.5F) + offset.y, job.spread);
  return ray_trace(*job.scene, *job.finder, ray, settings, rays, sight);
}

void render_pixel(const Job& job, int x, int y, RayCounts& rays, Frame& frame) {
  const std::size_t pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x);
  const int count = job.settings->samples_per_pixel;
  Vec3 color{0.0F};
  Sight sight;
  if (count == 1 || !frame.aovs.empty()) {
    const std::uint64_t rays_before = rays.total();
    color = trace_center(job, x, y, rays, sight);
    record_aovs(*job.scene, sight, rays.total() - rays_before, pixel, frame);
  }
  if (count > 1) {
    color = Vec3(0.0F);
    for (int sample = 0; sample < count; ++sample) {
      Sight seen;
      color = color + trace_sample(job, x, y, sample, rays, seen);
      if (sample == 0) sight = seen;
    }
    color = color * (1.0F / static_cast<float>(count));
  }
  frame.primitive[pixel] = sight.hit.primitive;
  for (int c = 0; c < 3; ++c) frame.rgb[3 * pixel + static_cast<std::size_t>(c)] = color[c];
}

RayCounts render_row(const Job& job, int y, Frame& frame) {
  RayCounts rays;
  for (int x = 0; x < frame.width; ++x) render_pixel(job, x, y, rays, frame);
  return rays;
}

} // namespace

Frame render(const Scene& scene, const HitFinder& finder, const Camera& camera,
             const RenderSettings& settings) {
  check(settings);
  const CameraFrame camera_frame = make_camera_frame(camera, settings.width, settings.height);
  const Job job{&scene, &finder, &settings, camera_frame,
                footprint_spread(camera_frame, settings.samples_per_pixel)};
  Frame frame = black_frame(settings.width, settings.height, settings.aovs);
  FrameProgress progress(settings, settings.height);
#pragma omp parallel for schedule(dynamic, 1) num_threads(thread_count(settings.threads))
  for (int y = 0; y < settings.height; ++y) {
    try {
      if (!progress.stopped()) progress.part_done(render_row(job, y, frame));
    } catch (...) {
      progress.failed(std::current_exception());
    }
  }
  progress.finish(frame);
  return frame;
}

} // namespace reference

Frame render_reference(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  return reference::render(scene, reference::BruteForce(scene), camera, settings);
}

} // namespace fastrt
