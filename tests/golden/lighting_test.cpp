// SPDX-License-Identifier: Apache-2.0
// Lights, shadows and the Phong model: every pixel against the closed form.
#include "tests/golden/pictures.hpp"

namespace fastrt::test {
namespace {

class Lighting : public Picture {};

Light point_light(const Vec3& position) {
  Light light;
  light.position = position;
  return light;
}
Light sunlight(const Vec3& direction) {
  Light light;
  light.kind = LightKind::directional;
  light.direction = direction;
  return light;
}

Material matte(float diffuse) {
  Material material = black();
  material.ambient = Vec3(1.0F);
  material.diffuse = Vec3(diffuse);
  return material;
}

const DSphere ball{{0.4, 1.2, -0.3}, 0.5};
const Camera above_floor{{0, 3, 7}, {0, 0, 0}, {0, 1, 0}, 40};

// A floor y = 0 of diffuse 0.5 and ambient 0.125, and the ball above it, glowing.
SceneBuilder floor_with_ball(const Light& light) {
  SceneBuilder builder;
  builder.set_ambient(Vec3(0.125F));
  builder.add_light(light);
  builder.add_sphere(Vec3(ball.center), 0.5F, builder.add_material(glowing({1, 0, 0})));
  add_quad(builder, {-100, 0, -100}, {200, 0, 0}, {0, 0, 200}, builder.add_material(matte(0.5F)));
  return builder;
}

// The floor's colour when `to_light` is where the light is, seen from a floor point.
Prediction floor_prediction(const Pinhole& pinhole, const std::function<DVec3(const DVec3&)>& to_light) {
  return [=](const DVec3& direction) -> std::optional<Vec3> {
    const double direct = gap(pinhole.eye(), direction, ball);
    if (std::fabs(direct) < 1e-3) return std::nullopt;
    if (direct < 0) return Vec3(1, 0, 0);
    if (direction.y > -0.04) return std::nullopt;
    const DVec3 point = pinhole.eye() - direction * (pinhole.eye().y / direction.y);
    const DVec3 way = glm::normalize(to_light(point));
    const double shadow = gap(point, way, ball);
    if (std::fabs(shadow) < 1e-3) return std::nullopt;
    return Vec3(shadow < 0 ? 0.125F : static_cast<float>(0.125 + 0.5 * way.y));
  };
}

TEST_P(Lighting, BallShadowOfAPointLight) {
  SceneBuilder builder = floor_with_ball(point_light({-1, 4, 1}));
  const RenderSettings settings = settings_of(150, 100);
  const Pinhole pinhole(above_floor, settings);
  const Frame frame = render(builder, above_floor, settings);
  expect_pixels(frame, pinhole, 1e-5,
                floor_prediction(pinhole, [](const DVec3& point) { return DVec3(-1, 4, 1) - point; }));
  EXPECT_GT(frame.rays.shadow, 0U);
}

// All of it 2^27 times as large.
TEST_P(Lighting, LargeBallsThrowShadowsOfDistantLights) {
  constexpr float size = 0x1p27F;
  const Vec3 lamp(-2048, 8192, 1024);
  SceneBuilder builder;
  builder.set_ambient(Vec3(0.125F));
  builder.add_light(point_light(size * lamp));
  builder.add_sphere(size * Vec3(ball.center), size * 0.5F, builder.add_material(glowing({1, 0, 0})));
  add_quad(builder, size * Vec3(-100, 0, -100), {200 * size, 0, 0}, {0, 0, 200 * size},
           builder.add_material(matte(0.5F)));
  Camera camera = above_floor;
  camera.eye *= size;
  const RenderSettings settings = settings_of(150, 100);
  const Pinhole pinhole(above_floor, settings);
  expect_pixels(render(builder, camera, settings), pinhole, 1e-5,
                floor_prediction(pinhole, [&](const DVec3& point) { return DVec3(lamp) - point; }));
}

TEST_P(Lighting, BallShadowOfTheSun) {
  SceneBuilder builder = floor_with_ball(sunlight({2, -5, -1}));
  const RenderSettings settings = settings_of(150, 100);
  const Pinhole pinhole(above_floor, settings);
  expect_pixels(render(builder, above_floor, settings), pinhole, 1e-5,
                floor_prediction(pinhole, [](const DVec3&) { return DVec3(-2, 5, 1); }));
}

TEST_P(Lighting, LightsWithoutShadowsPassThroughThings) {
  Light light = sunlight({0, -1, 0});
  light.casts_shadows = false;
  SceneBuilder builder = floor_with_ball(light);
  const RenderSettings settings = settings_of(60, 60);
  const Pinhole pinhole(above_floor, settings);
  const Frame frame = render(builder, above_floor, settings);
  expect_pixels(frame, pinhole, 1e-5, [&](const DVec3& direction) -> std::optional<Vec3> {
    const double direct = gap(pinhole.eye(), direction, ball);
    if (std::fabs(direct) < 1e-3) return std::nullopt;
    return direct < 0 ? Vec3(1, 0, 0) : Vec3(0.625F);
  });
  EXPECT_EQ(frame.rays.shadow, 0U);
}

// Only what lies between the surface and a point light stands in its way.
TEST_P(Lighting, NothingBehindAPointLightShadows) {
  SceneBuilder builder;
  builder.add_light(point_light({0, 2, 0}));
  add_quad(builder, {-99, 0, -99}, {198, 0, 0}, {0, 0, 198}, builder.add_material(matte(1)));
  add_quad(builder, {-99, 2.5F, -99}, {198, 0, 0}, {0, 0, 198}, builder.add_material(matte(1)));
  const Camera camera{{0, 1, 5}, {0, 0, 2}, {0, 1, 0}, 20};
  const RenderSettings settings = settings_of(40, 40);
  const Pinhole pinhole(camera, settings);
  expect_pixels(render(builder, camera, settings), pinhole, 1e-5, [&](const DVec3& direction) {
    const DVec3 point = pinhole.eye() - direction * (1 / direction.y);
    return std::optional(Vec3(static_cast<float>(2 / glm::length(DVec3(0, 2, 0) - point))));
  });
}

// A wall's top edge at height 1 under a sun at 45 degrees: its shadow ends at distance 1.
TEST_P(Lighting, WallShadowEndsAtALine) {
  SceneBuilder builder;
  builder.add_light(sunlight({1, -1, 0}));
  const std::uint32_t material = builder.add_material(matte(1));
  add_quad(builder, {-50, 0, -50}, {100, 0, 0}, {0, 0, 100}, material);
  add_quad(builder, {-1, 0, -50}, {0, 1, 0}, {0, 0, 100}, material);
  const Camera camera{{1.5F, 5, 0}, {1.5F, 0, 0}, {0, 0, -1}, 30};
  const RenderSettings settings = settings_of(61, 40);
  const Pinhole pinhole(camera, settings);
  expect_pixels(render(builder, camera, settings), pinhole, 1e-5,
                [&](const DVec3& direction) -> std::optional<Vec3> {
                  const double x = 1.5 - direction.x * (5 / direction.y);
                  if (std::fabs(x) < 1e-3) return std::nullopt;
                  return Vec3(x < 0 ? 0.0F : std::sqrt(0.5F));
                });
}

// Light through two coloured filters takes both colours; an opaque ball behind them takes the rest.
TEST_P(Lighting, FiltersColourTheShadow) {
  SceneBuilder builder;
  builder.add_light(sunlight({0, -1, 0}));
  Material filter = clear(1, {0.5F, 1, 0.25F});
  filter.thin = true;
  const std::uint32_t first = builder.add_material(filter);
  filter.transmission = {1, 0.5F, 0.5F};
  filter.opacity = 0.5F;
  const std::uint32_t second = builder.add_material(filter);
  add_quad(builder, {-50, 0, -50}, {100, 0, 0}, {0, 0, 100}, builder.add_material(matte(1)));
  add_quad(builder, {-50, 2, -50}, {50, 0, 0}, {0, 0, 100}, first);  // x < 0
  add_quad(builder, {-50, 3, -50}, {100, 0, 0}, {0, 0, 50}, second); // z < 0
  const Camera camera{{0, 1.5F, 0}, {0, 0, 0}, {0, 0, -1}, 60};
  const RenderSettings settings = settings_of(40, 40);
  expect_pixels(render(builder, camera, settings), Pinhole(camera, settings), 1e-6,
                [](const DVec3& direction) {
                  Vec3 light(1.0F);
                  if (direction.x < 0) light *= Vec3(0.5F, 1, 0.25F);
                  if (direction.z < 0) light *= Vec3(0.5F, 0.25F, 0.25F);
                  return std::optional(light);
                });
}

// E = Ke + g (Ka Ia + I (Kd cos + Ks x^n)), the highlight by the mirrored light or by the half vector.
TEST_P(Lighting, PhongModelOfAWall) {
  for (const SpecularModel model : {SpecularModel::phong, SpecularModel::blinn}) {
    Material material;
    material.ambient = {0.5F, 0.25F, 0};
    material.diffuse = {0.25F, 0.5F, 0.75F};
    material.specular = {1, 0.5F, 0.25F};
    material.emission = {0, 0, 0.125F};
    material.shininess = 20;
    material.specular_model = model;
    SceneBuilder builder;
    builder.set_ambient(Vec3(0.25F));
    Light light = point_light({1, 2, 4});
    light.intensity = {1, 0.5F, 2};
    builder.add_light(light);
    add_quad(builder, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, builder.add_material(material));
    const Camera camera{{-1, 0, 5}, {0, 0, 0}, {0, 1, 0}, 50};
    const RenderSettings settings = settings_of(48, 48);
    const Pinhole pinhole(camera, settings);
    expect_pixels(render(builder, camera, settings), pinhole, 2e-4, [&](const DVec3& direction) {
      const DVec3 point = pinhole.eye() - direction * (pinhole.eye().z / direction.z);
      const DVec3 s = glm::normalize(DVec3(light.position) - point);
      const DVec3 mirrored(-s.x, -s.y, s.z);
      const double x = model == SpecularModel::phong ? std::max(0.0, glm::dot(-direction, mirrored))
                                                     : glm::normalize(s - direction).z;
      const DVec3 reflected = DVec3(material.diffuse) * s.z + DVec3(material.specular) * std::pow(x, 20);
      return std::optional(material.emission + 0.25F * material.ambient +
                           Vec3(DVec3(light.intensity) * reflected));
    });
  }
}

TEST_P(Lighting, EmissionAndUnlitNeedNoLight) {
  SceneBuilder builder;
  builder.set_background({0.25F, 0, 0});
  Material lamp = black();
  lamp.emission = {3, 2, 1};
  Material card;
  card.diffuse = {0.5F, 0.25F, 0.125F};
  card.emission = {0, 0.5F, 0};
  card.mirror = Vec3(1.0F);
  card.unlit = true;
  builder.add_light(point_light({0, 0, 9}));
  add_quad(builder, {-2, -1, 0}, {1, 0, 0}, {0, 2, 0}, builder.add_material(lamp));
  add_quad(builder, {1, -1, 0}, {1, 0, 0}, {0, 2, 0}, builder.add_material(card));
  const Camera camera{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40};
  const Frame frame = render(builder, camera, settings_of(90, 60));
  const Pinhole pinhole(camera, settings_of(90, 60));
  const auto seen_at = [&](const DVec3& point) {
    const auto [px, py] = pinhole.project(point);
    return color_at(frame, static_cast<int>(px), static_cast<int>(py));
  };
  EXPECT_EQ(seen_at({-1.5, 0, 0}), Vec3(3, 2, 1));
  EXPECT_EQ(seen_at({1.5, 0, 0}), Vec3(0.5F, 0.75F, 0.125F));
  EXPECT_EQ(seen_at({0, 0, 0}), Vec3(0.25F, 0, 0));
  EXPECT_EQ(frame.rays.reflected, 0U);
}

FASTRT_PICTURES(Lighting);

} // namespace
} // namespace fastrt::test
