// SPDX-License-Identifier: Apache-2.0
// The naive forward tracer: each photon that meets a surface is seen by the eye, or is not.
#include "src/film/light_film.hpp"
#include "src/film/photon_sampling.hpp"
#include "src/reference/arithmetic.hpp"
#include "src/reference/photons.hpp"
#include "src/reference/render.hpp"
#include "src/reference/shading.hpp"
#include "src/scene/eye_projection.hpp"

#include <atomic>

namespace fastrt::reference {
namespace {

// A surface in the picture.
struct Sighting {
  float x = 0, y = 0, z = 0;
  bool inside = false;
  float pixels = 0; // that a unit of its area takes
};

Sighting see(const EyeProjection& eye, const Crop& part, const Surface& surface) {
  const Vec3 q = surface.point - eye.origin;
  const Vec3& normal = surface.geometric_normal;
  Sighting seen{glm::dot(q, eye.u), glm::dot(q, eye.v), glm::dot(q, eye.w)};
  const float facing = -glm::dot(normal, eye.orthographic ? eye.direction : q);
  if (!eye.orthographic) {
    const float inverse = 1.0F / seen.z;
    seen.x = seen.x * inverse;
    seen.y = seen.y * inverse;
  }
  seen.inside = seen.x >= static_cast<float>(part.x0) && seen.x < static_cast<float>(part.x1) &&
                seen.y >= static_cast<float>(part.y0) && seen.y < static_cast<float>(part.y1) &&
                seen.z > 0.0F && facing > 0.0F;
  const float spread = eye.orthographic ? facing : facing / ((seen.z * seen.z) * seen.z);
  seen.pixels = spread * eye.inverse_area;
  return seen;
}

Ray sight_ray(const EyeProjection& eye, const Surface& surface, float z) {
  Ray ray;
  ray.excluded = surface.planar;
  ray.excluded_instance = surface.instance;
  if (eye.orthographic) {
    ray.origin = surface.point + offset_for(surface.magnitude) * surface.geometric_normal;
    ray.direction = -eye.direction;
    ray.t_max = z;
  } else {
    const float reached = largest_magnitude(eye.origin) * surface.growth;
    const float offset = offset_for(max(surface.magnitude, reached));
    ray.origin = eye.origin;
    ray.direction = (surface.point + offset * surface.geometric_normal) - eye.origin;
    ray.t_max = 1.0F;
  }
  return ray;
}

void expose(std::int64_t& sum, float light) {
  if (!(light > 0.0F)) return;
  const auto units = static_cast<std::int64_t>(min(light, film_most) * film_scale);
  std::atomic_ref(sum).fetch_add(units, std::memory_order_relaxed);
}

} // namespace

Frame render_forward(const Scene& scene, const HitFinder& finder, const Camera& camera,
                     const RenderSettings& settings) {
  check(settings);
  const CameraFrame camera_frame = make_camera_frame(camera, settings.width, settings.height);
  const EyeProjection eye = make_eye_projection(camera_frame);
  Frame frame = render(scene, finder, camera, center_settings(settings));
  if (!frame.complete) return frame;
  keep_background(scene.background(), frame);

  const Crop part = part_of(settings);
  const PhotonPlan plan = plan_forward_photons(scene, settings.photons);
  const std::vector<PhotonChunk> chunks = photon_chunks(plan);
  const Surroundings around = surroundings_of(scene, finder, camera_frame, settings.width, settings.height);
  LightFilm film(frame);
  const auto show = [&](const Arrival& arrival, RayCounts& rays) {
    const Sighting seen = see(eye, part, arrival.surface);
    if (!seen.inside) return;
    ++rays.shadow;
    const Vec3 arrived = arrival.photon.weight * arrival.strength;
    const Vec3 light = ((arrived * arrival.albedo) * arrival.light->flux) * seen.pixels;
    const Vec3 left =
        let_through(scene, finder, sight_ray(eye, arrival.surface, seen.z), around.camera, true);
    const int column = static_cast<int>(seen.x) - part.x0, row = static_cast<int>(seen.y) - part.y0;
    std::int64_t* const sums = film.sums() + 3 * (static_cast<std::ptrdiff_t>(row) * frame.width + column);
    for (int c = 0; c < 3; ++c) expose(sums[c], light[c] * left[c]);
  };
  FrameProgress progress(settings, static_cast<int>(chunks.size()));
  trace_photons(scene, finder, around, plan, chunks, settings, true, show, progress);
  const RayCounts centers = frame.rays;
  progress.finish(frame);
  frame.rays += centers;
  film.develop(plan.count, frame);
  return frame;
}

} // namespace fastrt::reference
