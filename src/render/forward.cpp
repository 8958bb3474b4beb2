// SPDX-License-Identifier: Apache-2.0
// The forward tracer's driver: what the pixels' centres see, then photons onto a film.
#include "src/render/forward.hpp"

#include "src/film/light_film.hpp"
#include "src/render/photon_pass.hpp"
#include "src/scene/eye_projection.hpp"
#include "src/trace/point_media.hpp"

#include <algorithm>

namespace fastrt {
namespace {

EyeView view_of(const EyeProjection& eye, const Crop& part) {
  EyeView view{};
  copy(eye.origin, view.origin);
  copy(eye.u, view.u);
  copy(eye.v, view.v);
  copy(eye.w, view.w);
  copy(eye.direction, view.direction);
  view.inverse_area = eye.inverse_area;
  const Vec3 size = glm::abs(eye.origin);
  view.largest_coordinate = std::max(size.x, std::max(size.y, size.z));
  view.orthographic = eye.orthographic;
  view.x_begin = part.x0;
  view.y_begin = part.y0;
  view.x_end = part.x1;
  view.y_end = part.y1;
  return view;
}

} // namespace

Frame render_forward(const Tracer& tracer, const Camera& camera, const RenderSettings& settings) {
  check(settings);
  const CameraFrame camera_frame = make_camera_frame(camera, settings.width, settings.height);
  const EyeProjection eye = make_eye_projection(camera_frame);
  const Tracer::Parts& parts = tracer.parts();
  Frame frame = render(tracer, camera, center_settings(settings));
  if (!frame.complete) return frame;
  keep_background(parts.scene.background(), frame);

  const PhotonScene scene(parts);
  const PhotonPlan plan = plan_forward_photons(parts.scene, settings.photons);
  const std::vector<PhotonChunk> chunks = photon_chunks(plan);
  PhotonPass pass = make_photon_pass(parts, scene, plan, chunks, settings);
  LightFilm film(frame);
  pass.job.film = film.sums();
  pass.job.eye = view_of(eye, part_of(settings));
  media_around(parts, camera_frame, settings.width, settings.height, pass.job.eye.media);
  FrameProgress progress(settings, static_cast<int>(chunks.size()) + 1);
  progress.part_done(frame.rays, frame.tests); // the centres
  trace_photons(pass, progress);
  progress.finish(frame);
  film.develop(plan.count, frame);
  return frame;
}

} // namespace fastrt
