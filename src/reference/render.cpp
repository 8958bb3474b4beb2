// SPDX-License-Identifier: Apache-2.0
#include "src/reference/render.hpp"

#include "src/film/frame.hpp"
#include "src/film/sampling.hpp"
#include "src/scene/threads.hpp"

#include <exception>

namespace fastrt {
namespace reference {
namespace {

struct Pixel {
  Vec3 color{0.0F};
  Hit first_hit; // of its first sample
};

struct Job {
  const Scene* scene;
  const HitFinder* finder;
  const RenderSettings* settings;
  CameraFrame camera;
};

Ray camera_ray(const CameraFrame& camera, float px, float py) {
  Ray ray;
  ray.origin = camera.eye;
  ray.direction = (camera.corner + px * camera.du) + py * camera.dv;
  return ray;
}

Pixel render_pixel(const Job& job, int x, int y, RayCounts& rays) {
  const RenderSettings& settings = *job.settings;
  const int count = settings.samples_per_pixel;
  const float center_x = static_cast<float>(x) + 0.5F;
  const float center_y = static_cast<float>(y) + 0.5F;
  Pixel pixel;
  for (int sample = 0; sample < count; ++sample) {
    float px = center_x;
    float py = center_y;
    if (count > 1) {
      const SampleOffset offset = sample_offset(
          static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(sample),
          static_cast<std::uint32_t>(count), settings.seed, settings.filter == PixelFilter::tent);
      px = center_x + offset.x;
      py = center_y + offset.y;
    }
    ++rays.primary;
    Hit hit;
    const Vec3 color =
        ray_trace(*job.scene, *job.finder, camera_ray(job.camera, px, py), settings, rays, hit);
    pixel.color = count == 1 ? color : pixel.color + color;
    if (sample == 0) pixel.first_hit = hit;
  }
  if (count > 1) pixel.color = pixel.color * (1.0F / static_cast<float>(count));
  return pixel;
}

RayCounts render_row(const Job& job, int y, Frame& frame) {
  RayCounts rays;
  for (int x = 0; x < frame.width; ++x) {
    const Pixel pixel = render_pixel(job, x, y, rays);
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x);
    frame.rgb[3 * i] = pixel.color.x;
    frame.rgb[3 * i + 1] = pixel.color.y;
    frame.rgb[3 * i + 2] = pixel.color.z;
    frame.primitive[i] = pixel.first_hit.primitive;
  }
  return rays;
}

} // namespace

Frame render(const Scene& scene, const HitFinder& finder, const Camera& camera,
             const RenderSettings& settings) {
  check(settings);
  const Job job{&scene, &finder, &settings, make_camera_frame(camera, settings.width, settings.height)};
  Frame frame = black_frame(settings.width, settings.height);
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
