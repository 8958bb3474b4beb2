// SPDX-License-Identifier: Apache-2.0
// Forward pictures: noisy, so means over regions are held against closed forms and against Whitted pictures.
#include "tests/golden/pictures.hpp"

namespace fastrt::test {
namespace {

class Forward : public Picture {};

Material matt(float albedo) {
  Material material = black();
  material.diffuse = Vec3(albedo);
  return material;
}

RenderSettings forward_settings(int side, std::int64_t photons) {
  RenderSettings settings = settings_of(side, side);
  settings.integrator = Integrator::forward;
  settings.photons = photons;
  return settings;
}

// Of the green channel.
double mean(const Frame& frame) {
  double sum = 0;
  for (std::size_t i = 1; i < frame.rgb.size(); i += 3) sum += static_cast<double>(frame.rgb[i]);
  return 3 * sum / static_cast<double>(frame.rgb.size());
}

Light lamp(LightKind kind) {
  Light light;
  light.kind = kind;
  light.position = {0.5F, 2, 0.25F};
  light.direction = {-0.2F, -2, 0.1F};
  light.intensity = {0.5F, 1, 2};
  light.cone_degrees = 50;
  light.penumbra_degrees = 20;
  light.exponent = 2;
  return light;
}

// A lamp of two triangles over the floor, outside of the picture, that shines to both sides.
void add_mesh_lamp(SceneBuilder& builder, Light& light) {
  Material shining = black();
  shining.emission = {0.25F, 2, 1};
  light.material = builder.add_material(shining);
  add_quad(builder, {0.8F, 1.6F, -0.3F}, {0.4F, -0.4F, 0}, {0, 0, 0.6F}, light.material);
}

// Light that comes straight is the Whitted picture's, whatever the light and however it fades.
TEST_P(Forward, DirectLightIsWhitteds) {
  const Camera camera{{0, 3, 0.01F}, {0, 0, 0}, {0, 0, -1}, 30};
  for (const LightKind kind : {LightKind::point, LightKind::directional, LightKind::spot,
                               LightKind::rectangle, LightKind::disk, LightKind::sphere, LightKind::mesh})
    for (const bool fades : {false, true}) {
      Light light = lamp(kind);
      if (fades) light.constant = 0.5F, light.linear = 0.3F, light.quadratic = 0.2F;
      SceneBuilder builder;
      if (kind == LightKind::mesh) add_mesh_lamp(builder, light);
      builder.add_light(light);
      add_quad(builder, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, builder.add_material(matt(0.5F)));
      const Scene scene = builder.build();
      const RenderSettings settings = forward_settings(8, 30000);
      RenderSettings whitted = settings_of(8, 8);
      whitted.samples_per_pixel = 4;
      whitted.filter = PixelFilter::box;
      const double seen = mean(GetParam().render(scene, camera, settings));
      const double expected = mean(GetParam().render(scene, camera, whitted));
      EXPECT_NEAR(seen, expected, 0.015 * expected)
          << "light " << static_cast<int>(kind) << " fades " << fades;
    }
}

// Lamp, floor and eye in water: light fades from the lamp to the floor and from there to the eye, as the
// Whitted picture shows it. Dry, all is brighter.
TEST_P(Forward, WaterTakesItsPart) {
  Camera camera{{0, 3, 0.01F}, {0, 0, 0}, {0, 0, -1}, 30};
  for (const bool orthographic : {false, true}) {
    camera.projection = orthographic ? Projection::orthographic : Projection::perspective;
    camera.view_height = 1.6F;
    for (const LightKind kind : {LightKind::point, LightKind::disk, LightKind::mesh}) {
      const auto brightness = [&](const RenderSettings& settings, float absorption) {
        Light light = lamp(kind);
        SceneBuilder builder;
        if (kind == LightKind::mesh) add_mesh_lamp(builder, light);
        builder.add_light(light);
        add_quad(builder, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, builder.add_material(matt(0.5F)));
        Material water = clear(1.33F);
        water.absorption = Vec3(absorption);
        add_box(builder, {-5, -5, -5}, {5, 5, 5}, builder.add_material(water));
        return mean(render(builder, camera, settings));
      };
      RenderSettings settings = forward_settings(8, 30000);
      settings.max_depth = 0; // what the water's faces reflect is no matter here
      RenderSettings whitted = settings_of(8, 8);
      whitted.samples_per_pixel = 4;
      whitted.filter = PixelFilter::box;
      const double seen = brightness(settings, 0.3F);
      const double expected = brightness(whitted, 0.3F);
      EXPECT_NEAR(seen, expected, 0.015 * expected) << static_cast<int>(kind) << orthographic;
      EXPECT_LT(seen, 0.4 * brightness(settings, 0)) << static_cast<int>(kind) << orthographic;
    }
  }
}

// Pixel by pixel: parallel light through a picture of parallel rays, with a ball's shadow.
TEST_P(Forward, ShadowsAreWhereTheyBelong) {
  SceneBuilder builder;
  Light light = lamp(LightKind::directional);
  light.direction = {1, -1, 0};
  light.intensity = Vec3(1.0F);
  builder.add_light(light);
  add_quad(builder, {-2, 0, -2}, {4, 0, 0}, {0, 0, 4}, builder.add_material(matt(0.5F)));
  builder.add_sphere({-1, 1, 0}, 0.5F, builder.add_material(black()));
  Camera camera{{0, 3, 0}, {0, 0, 0}, {0, 0, -1}};
  camera.projection = Projection::orthographic;
  camera.view_height = 2;
  const Frame frame = render(builder, camera, forward_settings(16, 400000));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const double px = (x + 0.5) / 8 - 1, pz = (y + 0.5) / 8 - 1;
      // The shadow of the ball: its axis meets the floor at x = 0.
      const double gap = std::hypot(px * std::sqrt(0.5), pz) - 0.5;
      if (std::fabs(gap) < 0.1 || px < -0.45) continue; // the ball hides some of the floor
      EXPECT_NEAR(double(color_at(frame, x, y).y), gap < 0 ? 0.0 : 0.5 * std::sqrt(0.5), gap < 0 ? 0.0 : 0.08)
          << x << ", " << y;
    }
}

// Inside of a diffuse sphere all of it is equally bright: light that fades by the square of the distance
// gives E = I / R^2 from its middle, and what bounces makes 1 / (1 - albedo) of it.
TEST_P(Forward, IntegratingSphere) {
  for (const float albedo : {0.0F, 0.5F, 0.75F}) {
    SceneBuilder builder;
    Light light;
    light.position = Vec3(0.0F);
    light.constant = 0;
    light.quadratic = 1;
    builder.add_light(light);
    builder.add_sphere({0, 0, 0}, 2, builder.add_material(matt(albedo)));
    RenderSettings settings = forward_settings(8, 20000);
    settings.max_depth = 64;
    const Camera camera{{0, 0.5F, 0.3F}, {1, 0, 0}, {0, 1, 0}, 90};
    const double expected = static_cast<double>(albedo) / (1 - static_cast<double>(albedo)) / 4;
    EXPECT_NEAR(mean(render(builder, camera, settings)), expected, 0.02 * expected) << albedo;
  }
}

// A red wall and a white floor: colour bleeds, by the form factor of two squares at a right angle (0.20004).
TEST_P(Forward, ColourBleeds) {
  SceneBuilder builder;
  Light light = lamp(LightKind::directional);
  light.direction = {-1, 0, 0}; // along the floor
  light.intensity = Vec3(1.0F);
  builder.add_light(light);
  Material red = black();
  red.diffuse = {1, 0, 0};
  add_quad(builder, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, builder.add_material(red));
  add_quad(builder, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, builder.add_material(matt(1)));
  Camera camera{{0.5F, 3, 0.5F}, {0.5F, 0, 0.5F}, {0, 0, -1}};
  camera.projection = Projection::orthographic;
  camera.view_height = 1;
  RenderSettings settings = forward_settings(4, 60000);
  settings.max_depth = 1;
  const Frame frame = render(builder, camera, settings);
  double red_light = 0;
  for (std::size_t i = 0; i < frame.rgb.size(); i += 3) red_light += static_cast<double>(frame.rgb[i]) / 16;
  EXPECT_NEAR(red_light, 0.20004, 0.005);
  EXPECT_EQ(mean(frame), 0.0);
}

// Where a pixel's centre sees nothing there is the background; mirrors, glass and what glows are dark.
TEST_P(Forward, ShowsLightOnDiffuseSurfacesAlone) {
  SceneBuilder builder;
  builder.set_background({0.25F, 0.5F, 0.75F});
  builder.set_ambient(Vec3(1.0F));
  builder.add_light(lamp(LightKind::point));
  builder.add_sphere({-2, 0, 0}, 0.5F, builder.add_material(mirror(1)));
  builder.add_sphere({0, 0, 0}, 0.5F, builder.add_material(clear(1.5F)));
  builder.add_sphere({2, 0, 0}, 0.5F, builder.add_material(glowing({1, 1, 1})));
  Camera camera{{0, 0, 9}, {0, 0, 0}, {0, 1, 0}, 45};
  camera.projection = Projection::orthographic;
  camera.view_height = 2;
  RenderSettings settings = forward_settings(10, 2000);
  settings.width = 30;
  const Frame frame = render(builder, camera, settings);
  for (const int x : {5, 15, 25}) EXPECT_EQ(color_at(frame, x, 5), Vec3(0.0F));
  for (const int x : {10, 20}) EXPECT_EQ(color_at(frame, x, 5), Vec3(0.25F, 0.5F, 0.75F));
}

FASTRT_PICTURES(Forward);

} // namespace
} // namespace fastrt::test
