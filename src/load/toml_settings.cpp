// SPDX-License-Identifier: Apache-2.0
// The tables [camera] and [picture].
#include "src/load/toml_scene.hpp"
#include "src/scene/picture_limits.hpp"

#include <fastrt/error.hpp>

namespace fastrt {
namespace {

constexpr TomlRange share{0, 1};

// What says the same in two ways.
void refuse_both(const TomlFields& fields, const char* one, const char* other) {
  if (fields.has(one) && fields.has(other))
    fields.fail(fields.place(other), std::string("[camera] has both '") + one + "' and '" + other + '\'');
}

void check_projection(const TomlFields& fields, const Camera& camera) {
  const bool is_orthographic = camera.projection == Projection::orthographic;
  for (const std::string_view key : {"fov", "focal", "aperture", "focus"})
    if (is_orthographic && fields.has(key))
      fields.fail(fields.place(key), "[camera]: orthographic cameras have no '" + std::string(key) + '\'');
  if (!is_orthographic && fields.has("height"))
    fields.fail(fields.place("height"), "[camera]: only orthographic cameras have a 'height'");
}

void read_view(const TomlFields& fields, Camera& camera) {
  fields.read("fov", camera.fov_degrees, {0, 180, true, true});
  fields.read("height", camera.view_height, positive);
  if (fields.has("fov") || fields.has("height")) camera.window.reset();
  if (const auto window = fields.find("window")) {
    float edges[4];
    window->numbers(edges);
    if (edges[0] == edges[1] || edges[2] == edges[3]) window->fail("it has no area");
    camera.window = Window{edges[0], edges[1], edges[2], edges[3]};
  }
  fields.read("focal", camera.focal_distance, positive);
  fields.read("aperture", camera.aperture_radius, not_negative);
  fields.read("focus", camera.focus_distance, positive);
}

template <class T>
void read_count(const TomlFields& fields, const char* key, std::int64_t least, std::int64_t most,
                std::optional<T>& target) {
  if (const auto value = fields.find(key)) target = static_cast<T>(value->integer(least, most));
}

} // namespace

void read_toml_camera(const TomlFile& file, const TomlNode& node, TomlScene& scene) {
  static constexpr std::string_view keys[] = {"eye",    "look_at", "up",    "projection", "fov",
                                              "height", "window",  "focal", "aperture",   "focus"};
  static constexpr std::string_view projections[] = {"perspective", "orthographic"};
  const TomlFields fields(file.name, node, "[camera]", keys);
  refuse_both(fields, "fov", "window");
  refuse_both(fields, "height", "window");
  Camera camera = scene.desc.camera.value_or(Camera{});
  if (fields.has("eye") != fields.has("look_at") && !scene.knows_eye)
    fields.need(fields.has("eye") ? "look_at" : "eye");
  scene.knows_eye = scene.knows_eye || fields.has("eye");
  fields.read_vector("eye", camera.eye);
  fields.read_vector("look_at", camera.look_at);
  fields.read_direction("up", camera.up);
  if (const auto projection = fields.find("projection"))
    camera.projection = static_cast<Projection>(projection->choice(projections));
  check_projection(fields, camera);
  scene.knows_height = scene.knows_height || fields.has("height") || fields.has("window");
  read_view(fields, camera);
  scene.desc.camera = camera;
  scene.camera_file = file.name;
  scene.camera_place = node.place;
}

void finish_toml_camera(TomlScene& scene) {
  SceneDesc& desc = scene.desc;
  if (scene.camera_file.empty()) return;
  Camera& camera = *desc.camera;
  desc.camera_place_is_chosen = !scene.knows_eye;
  desc.camera_height_is_chosen = !scene.knows_height && camera.projection == Projection::orthographic;
  const bool has_size = desc.width != 0;
  const int width = has_size ? desc.width : 4, height = has_size ? desc.height : 3;
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  try {
    if (desc.camera_place_is_chosen) {
      const Camera framed = frame_scene(bounds_of(desc), camera.fov_degrees, aspect, camera.up);
      camera.eye = framed.eye;
      camera.look_at = framed.look_at;
    }
    if (desc.camera_height_is_chosen)
      camera.view_height = orthographic_height(bounds_of(desc), camera, aspect);
    make_camera_frame(camera, width, height);
  } catch (const InputError& error) {
    toml_fail(scene.camera_file, scene.camera_place, error.what());
  }
}

void read_toml_picture(const TomlFile& file, const TomlNode& node, TomlScene& scene) {
  static constexpr std::string_view keys[] = {
      "width", "height",   "spp",       "max_spp",          "filter",
      "seed",  "adaptive", "max_depth", "min_contribution", "light_samples"};
  static constexpr std::string_view filters[] = {"box", "tent", "gaussian", "mitchell"};
  const TomlFields fields(file.name, node, "[picture]", keys);
  if (fields.has("width") || fields.has("height")) {
    scene.desc.width = static_cast<int>(fields.need("width").integer(1, most_pixels_a_side));
    scene.desc.height = static_cast<int>(fields.need("height").integer(1, most_pixels_a_side));
  }
  PictureSettings& picture = scene.desc.picture;
  read_count(fields, "spp", 1, most_samples_a_pixel, picture.samples_per_pixel);
  read_count(fields, "max_spp", 1, most_adaptive_samples, picture.most_samples);
  read_count(fields, "light_samples", 1, most_light_samples, picture.light_samples);
  read_count(fields, "max_depth", 0, most_bounces, picture.max_depth);
  read_count(fields, "seed", 0, std::numeric_limits<std::uint32_t>::max(), picture.seed);
  if (const auto filter = fields.find("filter"))
    picture.filter = static_cast<PixelFilter>(filter->choice(filters));
  if (const auto adaptive = fields.find("adaptive")) picture.adaptive = adaptive->number(share);
  if (const auto least = fields.find("min_contribution")) picture.min_contribution = least->number(share);
  if (picture.most_samples && *picture.most_samples < picture.samples_per_pixel.value_or(1))
    fields.fail(fields.place("max_spp"), "[picture]: 'max_spp' is less than 'spp'");
}

} // namespace fastrt
