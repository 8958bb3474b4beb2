// SPDX-License-Identifier: Apache-2.0
// Fading lights, spots and lights with a size against closed forms.
#include "tests/golden/pictures.hpp"

namespace fastrt::test {
namespace {

class LightKinds : public Picture {};

Material white() {
  Material material = black();
  material.diffuse = Vec3(1.0F);
  return material;
}

// The floor y = 0 from straight above.
const Camera from_above{{0, 6, 0}, {0, 0, 0}, {0, 0, -1}, 60};
DVec3 on_floor(const DVec3& direction) { return DVec3(0, 6, 0) - direction * (6 / direction.y); }

SceneBuilder floor_under(const Light& light) {
  SceneBuilder builder;
  builder.add_light(light);
  add_quad(builder, {-50, 0, -50}, {100, 0, 0}, {0, 0, 100}, builder.add_material(white()));
  return builder;
}

Light above(LightKind kind) {
  Light light;
  light.kind = kind;
  light.position = {0, 2, 0};
  light.direction = {0, -3, 0};
  return light;
}

TEST_P(LightKinds, LightFades) {
  Light light = above(LightKind::point);
  light.constant = 0.5F;
  light.linear = 0.25F;
  light.quadratic = 0.125F;
  SceneBuilder builder = floor_under(light);
  const RenderSettings settings = settings_of(40, 40);
  expect_pixels(render(builder, from_above, settings), Pinhole(from_above, settings), 1e-5,
                [](const DVec3& direction) {
                  const DVec3 way = DVec3(0, 2, 0) - on_floor(direction);
                  const double d = glm::length(way);
                  const double fade = 1 / (0.5 + 0.25 * d + 0.125 * d * d);
                  return std::optional(Vec3(static_cast<float>(fade * way.y / d)));
                });
}

TEST_P(LightKinds, AmbientLightOfALight) {
  Light light = above(LightKind::point);
  light.intensity = Vec3(0.0F);
  light.ambient = {0.25F, 0.5F, 0};
  SceneBuilder builder;
  builder.set_ambient({0.125F, 0, 0});
  builder.add_light(light);
  Material material = black();
  material.ambient = {1, 0.5F, 1};
  add_quad(builder, {-50, 0, -50}, {100, 0, 0}, {0, 0, 100}, builder.add_material(material));
  const RenderSettings settings = settings_of(8, 8);
  expect_pixels(render(builder, from_above, settings), Pinhole(from_above, settings), 0,
                [](const DVec3&) { return std::optional(Vec3(0.375F, 0.25F, 0)); });
}

// cone 40 degrees, of which the outer 15 are penumbra; cosine to the power of 3.
TEST_P(LightKinds, SpotFallsOff) {
  for (const float exponent : {0.0F, 3.0F}) {
    Light light = above(LightKind::spot);
    light.cone_degrees = 40;
    light.penumbra_degrees = 15;
    light.exponent = exponent;
    SceneBuilder builder = floor_under(light);
    const RenderSettings settings = settings_of(60, 60);
    expect_pixels(render(builder, from_above, settings), Pinhole(from_above, settings), 2e-5,
                  [&](const DVec3& direction) {
                    const DVec3 way = DVec3(0, 2, 0) - on_floor(direction);
                    const double x = way.y / glm::length(way);
                    const double rim = std::cos(40 * std::numbers::pi / 180);
                    const double inside = std::cos(25 * std::numbers::pi / 180);
                    const double y = std::clamp((x - rim) / (inside - rim), 0.0, 1.0);
                    const double spot = y * y * (3 - 2 * y) * std::pow(x, exponent);
                    return std::optional(Vec3(static_cast<float>(spot * x)));
                  });
  }
}

TEST_P(LightKinds, SpotWithoutAPenumbraHasARim) {
  Light light = above(LightKind::spot);
  light.cone_degrees = 30;
  light.penumbra_degrees = 0;
  SceneBuilder builder = floor_under(light);
  const RenderSettings settings = settings_of(60, 60);
  const double rim = 2 * std::tan(30 * std::numbers::pi / 180);
  expect_pixels(render(builder, from_above, settings), Pinhole(from_above, settings), 1e-5,
                [&](const DVec3& direction) -> std::optional<Vec3> {
                  const DVec3 p = on_floor(direction);
                  const double r = glm::length(p);
                  if (std::fabs(r - rim) < 1e-4) return std::nullopt;
                  return Vec3(r < rim ? static_cast<float>(2 / std::sqrt(r * r + 4)) : 0.0F);
                });
}

// A half plane at half the height hides the disk above a line; seen from a floor point that line crosses the
// disk at 2 * (edge) - x: what is left is a segment of the circle.
TEST_P(LightKinds, SoftShadowOfADisk) {
  Light light = above(LightKind::disk);
  light.position = {0, 4, 0};
  light.radius = 1;
  SceneBuilder builder = floor_under(light);
  add_quad(builder, {0, 2, -50}, {50, 0, 0}, {0, 0, 100}, builder.add_material(black())); // x > 0
  const Camera camera{{0, 1.5F, 0}, {0, 0, 0}, {0, 0, -1}, 90}; // from below the half plane
  RenderSettings settings = settings_of(24, 24);
  settings.light_samples = 1024;
  expect_pixels(render(builder, camera, settings), Pinhole(camera, settings), 6e-3,
                [&](const DVec3& direction) -> std::optional<Vec3> {
                  const DVec3 p = DVec3(0, 1.5, 0) - direction * (1.5 / direction.y);
                  // What of the disk lies at x < -p.x is seen: the rest is behind the half plane.
                  const double cut = std::clamp(-p.x, -1.0, 1.0);
                  // The mean over that part of the cosine of its points, summed up in small squares.
                  double sum = 0;
                  const int n = 200;
                  for (int i = 0; i < n; ++i)
                    for (int k = 0; k < n; ++k) {
                      const double x = (i + 0.5) * 2 / n - 1, z = (k + 0.5) * 2 / n - 1;
                      if (x * x + z * z > 1 || x > cut) continue;
                      sum += 4 / std::sqrt((x - p.x) * (x - p.x) + 16 + (z - p.z) * (z - p.z));
                    }
                  return Vec3(static_cast<float>(sum * (4.0 / n / n) / std::numbers::pi));
                });
}

TEST_P(LightKinds, NoiseFollowsTheSeed) {
  const auto noise = [&](std::uint32_t seed) {
    Light light = above(LightKind::disk);
    light.position = {0, 4, 0};
    light.radius = 1;
    SceneBuilder builder = floor_under(light);
    add_quad(builder, {0, 2, -50}, {50, 0, 0}, {0, 0, 100}, builder.add_material(black()));
    RenderSettings settings = settings_of(24, 24);
    settings.light_samples = 2;
    settings.seed = seed;
    return render(builder, Camera{{0, 1.5F, 0}, {0, 0, 0}, {0, 0, -1}, 90}, settings).rgb;
  };
  const auto first = noise(1);
  EXPECT_TRUE(first == noise(1));
  EXPECT_FALSE(first == noise(2));
}

// Far away, each kind of light with a size is a point light.
TEST_P(LightKinds, SmallAndFarIsAPoint) {
  for (const LightKind kind : {LightKind::rectangle, LightKind::disk, LightKind::sphere}) {
    Light light = above(kind);
    light.position = {0, 100, 0};
    light.half_u = {0.01F, 0, 0};
    light.half_v = {0, 0, 0.01F};
    light.radius = 0.01F;
    SceneBuilder builder = floor_under(light);
    const RenderSettings settings = settings_of(16, 16);
    expect_pixels(render(builder, from_above, settings), Pinhole(from_above, settings), 1e-4,
                  [](const DVec3& direction) {
                    const DVec3 way = DVec3(0, 100, 0) - on_floor(direction);
                    return std::optional(Vec3(static_cast<float>(way.y / glm::length(way))));
                  });
  }
}

// A tiny ball under a sphere of light: what its top gets is the mean of cos / d^2 over the sphere.
TEST_P(LightKinds, SphereIsEvenlyCovered) {
  Light light = above(LightKind::sphere);
  light.radius = 1.5F;
  light.constant = 0;
  light.quadratic = 1;
  SceneBuilder builder;
  builder.add_light(light);
  builder.add_sphere({0, 0, 0}, 1e-3F, builder.add_material(white()));
  const Camera camera{{0, 5e-3F, 0}, {0, 0, 0}, {0, 0, -1}, 1};
  RenderSettings settings = settings_of(4, 4);
  settings.light_samples = 1024;
  const double n = 400;
  double sum = 0; // of cos / d^2 over the sphere's height, each as likely as the other
  for (int i = 0; i < n; ++i) {
    const double z = (i + 0.5) * 2 / n - 1, y = 2 + 1.5 * z, r2 = 1.5 * 1.5 * (1 - z * z);
    const double d2 = y * y + r2;
    sum += y / std::sqrt(d2) / d2 / n;
  }
  expect_pixels(render(builder, camera, settings), Pinhole(camera, settings), 4e-3 * sum,
                [&](const DVec3&) { return std::optional(Vec3(static_cast<float>(sum))); });
}

FASTRT_PICTURES(LightKinds);

} // namespace
} // namespace fastrt::test
