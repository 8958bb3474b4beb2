// SPDX-License-Identifier: Apache-2.0
#include "src/cli/scene_defaults.hpp"

#include "src/cli/light_option.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>

#include <optional>
#include <utility>

namespace fastrt::cli {
namespace {

template <class T>
void take(const Options& options, const char* name, const std::optional<T>& wish, T& target) {
  if (wish && !options.given.contains(name)) target = *wish;
}

// What the picture shows. The last word is the command line's: --fov is of perspective cameras without a
// window, --ortho of cameras without a lens.
void choose_view(const Options& options, const Aabb& bounds, float aspect, Camera& camera) {
  const auto given = [&](const char* name) { return options.given.contains(name); };
  if (given("--fov")) {
    camera.fov_degrees = options.fov_degrees;
    camera.projection = Projection::perspective;
  }
  if (given("--fov") || given("--ortho")) camera.window.reset();
  if (given("--window")) camera.window = options.window;
  if (given("--focal")) camera.focal_distance = options.focal_distance;
  if (given("--aperture")) camera.aperture_radius = options.aperture_radius;
  if (given("--focus")) camera.focus_distance = options.focus_distance;
  if (!options.orthographic) return;
  camera.projection = Projection::orthographic;
  camera.aperture_radius = 0;
  camera.view_height =
      options.view_height ? *options.view_height : orthographic_height(bounds, camera, aspect);
}

float aspect_of(const Options& options) {
  return static_cast<float>(options.width) / static_cast<float>(options.height);
}

// The scene's camera, which is where it shows all of the scene if the file does not say where it is.
Camera placed_camera(const Options& options, const Aabb& bounds, const SceneDesc& desc) {
  if (desc.camera && !desc.camera_place_is_chosen) return *desc.camera;
  Camera camera = desc.camera.value_or(Camera{});
  const bool shows_fov = !options.orthographic && !options.window;
  const float fov = shows_fov && options.given.contains("--fov") ? options.fov_degrees : camera.fov_degrees;
  const Vec3 up = options.given.contains("--up") ? options.up : camera.up;
  const Camera framed = frame_scene(bounds, fov, aspect_of(options), up);
  camera.eye = framed.eye;
  camera.look_at = framed.look_at;
  camera.fov_degrees = fov;
  return camera;
}

Camera camera_by_options(const Options& options, const Aabb& bounds, const SceneDesc& desc) {
  const float aspect = aspect_of(options);
  Camera camera = placed_camera(options, bounds, desc);
  if (options.eye) camera.eye = *options.eye;
  if (options.look_at) camera.look_at = *options.look_at;
  if (options.given.contains("--up")) camera.up = options.up;
  choose_view(options, bounds, aspect, camera);
  if (desc.camera_height_is_chosen && !options.orthographic && camera.projection == Projection::orthographic)
    camera.view_height = orthographic_height(bounds, camera, aspect);
  // Throws for a view that makes no sense, before the long work.
  make_camera_frame(camera, options.width, options.height);
  return camera;
}

// Whether the scene makes no sense of its camera even if nothing changes it.
bool has_bad_camera(const Options& options, const Aabb& bounds, const SceneDesc& desc) {
  try {
    const Camera camera =
        desc.camera ? *desc.camera : frame_scene(bounds, Camera{}.fov_degrees, aspect_of(options));
    make_camera_frame(camera, options.width, options.height);
    return false;
  } catch (const InputError&) {
    return true;
  }
}

} // namespace

void take_picture_settings(const SceneDesc& desc, Options& options) {
  if (!options.given.contains("--resolution") && desc.width != 0 && desc.height != 0) {
    options.width = desc.width;
    options.height = desc.height;
  }
  const PictureSettings& picture = desc.picture;
  take(options, "--spp", picture.samples_per_pixel, options.samples_per_pixel);
  take(options, "--filter", picture.filter, options.filter);
  take(options, "--adaptive", picture.adaptive, options.adaptive);
  take(options, "--seed", picture.seed, options.seed);
  take(options, "--max-depth", picture.max_depth, options.max_depth);
  take(options, "--min-contribution", picture.min_contribution, options.min_contribution);
  take(options, "--light-samples", picture.light_samples, options.light_samples);
  // Fewer than --spp make no sense: then the scene's number is forgotten.
  if (picture.most_samples && *picture.most_samples >= options.samples_per_pixel)
    take(options, "--max-spp", picture.most_samples, options.most_samples);
}

Camera choose_camera(const Options& options, const Aabb& bounds, const SceneDesc& desc) {
  try {
    return camera_by_options(options, bounds, desc);
  } catch (const InputError& error) {
    if (!has_bad_camera(options, bounds, desc)) throw;
    throw InputError(options.scene, 0, 0, error.what());
  }
}

void light_scene(const Options& options, const Aabb& bounds, const Camera& camera, SceneDesc& desc) {
  choose_lights(options.lights, bounds, camera, desc);
  if (options.ambient) desc.ambient = *options.ambient;
  if (options.background) desc.background = *options.background;
}

Scene checked_scene(const Options& options, SceneDesc desc) {
  try {
    return Scene(std::move(desc));
  } catch (const InputError& error) {
    throw InputError(options.scene, 0, 0, error.what());
  }
}

} // namespace fastrt::cli
