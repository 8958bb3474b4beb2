// SPDX-License-Identifier: Apache-2.0
// A picture for each feature of the shading, so that a difference has a name.
#pragma once

#include "tests/equivalence/frames.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <vector>

namespace fastrt::test {

inline Light point_light(const Vec3& position, const Vec3& intensity, bool casts_shadows = true) {
  return {LightKind::point, position, {0, -1, 0}, intensity, casts_shadows};
}
inline Light directional_light(const Vec3& direction, const Vec3& intensity) {
  return {LightKind::directional, Vec3(0.0F), direction, intensity, true};
}

inline Material matte(const Vec3& colour) {
  Material m;
  m.ambient = m.diffuse = colour;
  return m;
}
inline Material shiny(SpecularModel model, float shininess) {
  Material m = matte({0.3F, 0.4F, 0.5F});
  m.specular = {0.9F, 0.8F, 0.7F};
  m.specular_model = model;
  m.shininess = shininess;
  return m;
}
inline Material mirror(const Vec3& weight, Fresnel fresnel = Fresnel::none) {
  Material m = matte(Vec3(0.1F));
  m.mirror = weight;
  m.fresnel = fresnel;
  m.ior = 1.5F;
  return m;
}
inline Material glass(float ior, const Vec3& colour, const Vec3& absorption = Vec3(0.0F)) {
  Material m = matte(Vec3(0.05F));
  m.opacity = 0.1F;
  m.mirror = Vec3(1);
  m.fresnel = Fresnel::dielectric;
  m.transmission = colour;
  m.ior = ior;
  m.absorption = absorption;
  return m;
}

// A floor in two colours, a wall behind, and two lights; what is shown stands on it around the origin.
class Stage {
public:
  Stage() {
    const std::uint32_t grey = builder.add_material(matte(Vec3(0.6F)));
    const std::uint32_t red = builder.add_material(matte({0.8F, 0.2F, 0.1F}));
    add(builder, grid(3, {-4, -1, 4}, {8, 0, 0}, {0, 0, -8}), grey);
    add(builder, grid(2, {-4, -1.5F, -3}, {8, 0.3F, 0}, {0, 5, -0.2F}), red);
    builder.set_ambient(Vec3(0.2F));
    builder.set_background({0.1F, 0.2F, 0.4F});
  }
  void light_up() {
    builder.add_light(point_light({3, 5, 4}, {0.9F, 0.8F, 0.7F}));
    builder.add_light(directional_light({0.5F, -1, -0.4F}, {0.2F, 0.3F, 0.4F}));
  }
  void ball(const Vec3& center, float radius, const Material& material, bool smooth) {
    const Mesh unit = icosphere(1);
    const Mesh mesh = placed(unit, radius, center);
    const std::uint32_t id = builder.add_material(material);
    if (smooth)
      builder.add_mesh(mesh.positions, mesh.indices, id, unit.positions);
    else
      builder.add_mesh(mesh.positions, mesh.indices, id);
  }
  void sphere(const Vec3& center, float radius, const Material& material) {
    builder.add_sphere(center, radius, builder.add_material(material));
  }
  // A square across the view.
  void plate(float z, const Material& material) {
    add(builder, grid(1, {-1.5F, -0.9F, z}, {3, 0.1F, 0}, {0.1F, 2, 0.2F}), builder.add_material(material));
  }
  Shot shot(const char* name, int width = 64, int height = 48, int samples = 1) {
    return {name, builder.build(), looking({0.3F, 1.2F, 5.5F}, {0, 0, 0}),
            small_settings(width, height, samples)};
  }

  SceneBuilder builder;
};

inline Shot highlights(SpecularModel model, const char* name) {
  Stage stage;
  stage.light_up();
  stage.builder.add_light(point_light({-4, 2, 2}, {0.3F, 0.3F, 0.9F}, false));
  stage.sphere({-1.3F, 0, 0}, 0.8F, shiny(model, 1));
  stage.ball({0.2F, 0, 0}, 0.7F, shiny(model, 10), true);
  stage.ball({1.6F, 0, 0}, 0.7F, shiny(model, 1000), false);
  return stage.shot(name);
}

inline Shot mirrors(const char* name, int depth, float min_contribution) {
  Stage stage;
  stage.light_up();
  stage.sphere({-1.4F, 0, 0}, 0.8F, mirror(Vec3(0.9F)));
  stage.ball({0.3F, 0, 0.5F}, 0.7F, mirror({0.9F, 0.5F, 0.2F}), true);
  stage.sphere({1.8F, 0.2F, 0}, 0.8F, mirror({0.1F, 0.05F, 0.02F}, Fresnel::schlick));
  stage.ball({0.2F, 1.5F, -1}, 0.6F, mirror(Vec3(0.8F), Fresnel::dielectric), false);
  Shot shot = stage.shot(name);
  shot.settings.max_depth = depth;
  shot.settings.min_contribution = min_contribution;
  return shot;
}

// Two mirrors face each other: a path that ends at the limit alone.
inline Shot endless(const char* name, int depth) {
  SceneBuilder builder;
  const std::uint32_t id = builder.add_material(mirror(Vec3(1)));
  add(builder, grid(2, {-3, -3, -2}, {6, 0, 0}, {0, 6, 0.1F}), id);
  add(builder, grid(2, {-3, -3, 7}, {6, 0.1F, 0}, {0, 6, 0}), id);
  builder.add_sphere({0.4F, 0.2F, 0}, 0.5F, id);
  builder.add_light(point_light({1, 2, 3}, Vec3(1)));
  builder.set_ambient(Vec3(0.1F));
  Shot shot{name, builder.build(), looking({0.3F, 0.2F, 5}, {0, 0, 0}), small_settings(40, 30)};
  shot.settings.max_depth = depth;
  shot.settings.min_contribution = 0;
  return shot;
}

inline Shot refraction() {
  Stage stage;
  stage.light_up();
  stage.sphere({-1.5F, 0, 0.5F}, 0.9F, glass(1.5F, {0.9F, 1, 0.9F}));
  stage.ball({0.4F, 0, 0.5F}, 0.8F, glass(1.33F, Vec3(1), {0.8F, 0.2F, 0}), true);
  stage.ball({2, 0, 0}, 0.7F, glass(2.4F, Vec3(0.9F)), false);
  Material thin = glass(1.5F, {0.5F, 0.7F, 1});
  thin.thin = true;
  stage.plate(1.8F, thin);
  return stage.shot("refraction");
}

// Glass in water in glass ... more deeply than the list of media goes.
inline Shot nested_media() {
  Stage stage;
  stage.light_up();
  for (int i = 0; i < 7; ++i) {
    const auto shell = static_cast<float>(i);
    stage.sphere({0.1F * shell, 0.05F * shell, 0}, 1.6F - 0.2F * shell,
                 glass(i % 2 == 0 ? 1.1F + 0.1F * shell : 1.05F, Vec3(0.98F), Vec3(0.05F * shell)));
  }
  Shot shot = stage.shot("nested_media", 48, 37);
  shot.settings.max_depth = 12;
  shot.settings.min_contribution = 0.02F;
  return shot;
}

inline Shot coloured_shadows() {
  Stage stage;
  stage.light_up();
  stage.builder.add_light(point_light({-2, 6, 2}, Vec3(0.5F)));
  for (const float z : {0.0F, 0.0F, 0.6F}) { // two in the same place
    Material pane = matte({0.2F, 0.1F, 0.3F});
    pane.opacity = 0.4F;
    pane.transmission = {1, 0.3F + z, 0.2F};
    stage.plate(z, pane);
  }
  stage.sphere({0.5F, 0.8F, 1.2F}, 0.6F, glass(1.3F, {0.2F, 0.9F, 0.4F}));
  Material black_glass = matte(Vec3(0.5F));
  black_glass.opacity = 0.5F;
  black_glass.transmission = Vec3(0);
  stage.ball({-1.5F, 0, 1}, 0.5F, black_glass, false);
  return stage.shot("coloured_shadows");
}

inline Shot own_light(const char* name, bool ambient) {
  Stage stage;
  Material glow = matte({0.2F, 0.3F, 0.1F});
  glow.emission = {0.7F, 0.1F, 0.3F};
  stage.sphere({-1, 0, 0}, 0.8F, glow);
  glow.unlit = true;
  stage.ball({1, 0, 0}, 0.8F, glow, true);
  if (!ambient) stage.builder.set_ambient(Vec3(0));
  return stage.shot(name);
}

inline Shot many_lights() {
  Stage stage;
  Random random(5);
  for (int i = 0; i < 14; ++i) {
    const Vec3 at = Vec3(0, 3, 2) + 4.0F * random.in_cube();
    stage.builder.add_light(i % 3 == 0 ? directional_light(at * -1.0F, Vec3(0.06F))
                                       : point_light(at, {0.1F, 0.12F, 0.05F}, i % 4 != 0));
  }
  stage.sphere({-1, 0, 0}, 0.8F, shiny(SpecularModel::phong, 30));
  stage.ball({1, 0, 0}, 0.9F, mirror(Vec3(0.3F)), true);
  return stage.shot("many_lights");
}

inline Shot sampled(const char* name, int samples, PixelFilter filter, std::uint32_t seed) {
  Stage stage;
  stage.light_up();
  stage.sphere({0, 0, 0}, 1, shiny(SpecularModel::blinn, 50));
  Shot shot = stage.shot(name, 37, 21, samples);
  shot.settings.filter = filter;
  shot.settings.seed = seed;
  return shot;
}

inline Shot seen_by(const char* name, const Camera& like, int samples, float adaptive = 0) {
  Stage stage;
  stage.light_up();
  stage.sphere({-1, 0, 0}, 1, mirror(Vec3(0.5F)));
  stage.sphere({1.2F, 0, -1}, 1, shiny(SpecularModel::blinn, 50));
  Shot shot = stage.shot(name, 45, 31, samples);
  shot.camera.projection = like.projection;
  shot.camera.view_height = like.view_height;
  shot.camera.window = like.window;
  shot.camera.aperture_radius = like.aperture_radius;
  shot.settings.adaptive = adaptive;
  return shot;
}

inline std::vector<Shot> views() {
  Camera parallel, lens, window;
  parallel.projection = Projection::orthographic;
  parallel.view_height = 4;
  lens.aperture_radius = 0.3F;
  window.window = Window{-0.4F, 0.1F, -0.2F, 0.3F};
  return {seen_by("parallel_rays", parallel, 1),
          seen_by("parallel_rays_4", parallel, 4),
          seen_by("lens", lens, 5),
          seen_by("lens_adaptive", lens, 2, 0.05F),
          seen_by("window", window, 1),
          seen_by("adaptive", {}, 1, 0.02F)};
}

inline Shot sized(const char* name, int width, int height) {
  Stage stage;
  stage.light_up();
  stage.sphere({0, 0, 0}, 1.4F, mirror(Vec3(0.5F)));
  return stage.shot(name, width, height);
}

inline std::vector<Shot> designed_shots() {
  SceneBuilder empty;
  empty.set_background({0.3F, 0.5F, 0.7F});
  std::vector<Shot> shots = {
      {"nothing", empty.build(), looking({0, 0, 5}, {0, 0, 0}), small_settings(20, 20)},
      highlights(SpecularModel::phong, "phong"),
      highlights(SpecularModel::blinn, "blinn"),
      mirrors("mirrors", 8, 1.0F / 256),
      mirrors("mirrors_depth_0", 0, 0),
      mirrors("mirrors_depth_1", 1, 0),
      mirrors("mirrors_bright_alone", 8, 0.4F),
      endless("endless_to_64", 64),
      endless("endless_to_5", 5),
      refraction(),
      nested_media(),
      coloured_shadows(),
      own_light("emission_and_unlit", true),
      own_light("no_light_at_all", false),
      many_lights(),
      sampled("box_3", 3, PixelFilter::box, 0),
      sampled("tent_3", 3, PixelFilter::tent, 0),
      sampled("box_16", 16, PixelFilter::box, 7),
      sampled("tent_16", 16, PixelFilter::tent, 0xFFFFFFFFU),
      sized("one_pixel", 1, 1),
      sized("narrow", 1, 50),
      sized("low", 50, 1),
      sized("no_multiple_of_16", 17, 33),
      sampled("gaussian_5", 5, PixelFilter::gaussian, 1),
      sampled("mitchell_2", 2, PixelFilter::mitchell, 2),
      sampled("mitchell_19", 19, PixelFilter::mitchell, 3),
      sized("whole_tiles", 96, 64)};
  for (Shot& shot : views()) shots.push_back(std::move(shot));
  return shots;
}

} // namespace fastrt::test
