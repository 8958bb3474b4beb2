// SPDX-License-Identifier: Apache-2.0
// Mirrors and glass: every pixel against the law of reflection and Snell's law.
#include "tests/golden/pictures.hpp"

namespace fastrt::test {
namespace {

class SecondaryRays : public Picture {};

const Vec3 red{1, 0.25F, 0};
const Vec3 sky{0, 0.25F, 1};

std::optional<Vec3> unless_close(double gap, const Vec3& inside, const Vec3& outside) {
  if (std::fabs(gap) < 1e-3) return std::nullopt;
  return gap < 0 ? inside : outside;
}

TEST_P(SecondaryRays, MirrorShowsThingsBehindIt) {
  const DSphere ball{{0.5, 1.5, -1}, 0.6};
  const DSphere image{{0.5, -1.5, -1}, 0.6};
  SceneBuilder builder;
  builder.set_background(sky);
  builder.add_sphere(Vec3(ball.center), 0.6F, builder.add_material(glowing(red)));
  add_quad(builder, {-100, 0, -100}, {200, 0, 0}, {0, 0, 200}, builder.add_material(mirror(0.5F)));
  const Camera camera{{0, 2, 6}, {0, -0.5F, 0.5F}, {0, 1, 0}, 50};
  const RenderSettings settings = settings_of(120, 120);
  const Pinhole pinhole(camera, settings);
  const Frame frame = render(builder, camera, settings);
  expect_pixels(frame, pinhole, 1e-6, [&](const DVec3& direction) {
    const double direct = gap(pinhole.eye(), direction, ball);
    const double mirrored = gap(pinhole.eye(), direction, image);
    // The quad's far rim is just below the horizon.
    if (std::fabs(direct) < 1e-3 || std::fabs(direction.y) < 0.022) return std::optional<Vec3>();
    if (direct < 0) return std::optional(red);
    return direction.y > 0 ? std::optional(sky) : unless_close(mirrored, 0.5F * red, 0.5F * sky);
  });
  const auto [px, py] = pinhole.project(image.center);
  EXPECT_EQ(color_at(frame, static_cast<int>(px), static_cast<int>(py)), 0.5F * red);
}

// Where a ray leaves a slab 0 > z > -thickness of glass, and goes on in its old direction.
DVec3 behind_slab(const DVec3& origin, const DVec3& direction, double ior, double thickness) {
  const DVec3 entry = origin - direction * (origin.z / direction.z);
  const double sine = std::hypot(direction.x, direction.y);
  if (sine == 0) return entry - DVec3(0, 0, thickness);
  const double refracted_tangent = (sine / ior) / std::sqrt(1 - sine * sine / (ior * ior));
  const DVec3 sideways = DVec3(direction.x, direction.y, 0) / sine;
  return entry + (thickness * refracted_tangent) * sideways - DVec3(0, 0, thickness);
}

TEST_P(SecondaryRays, GlassSlabMovesWhatIsBehindIt) {
  constexpr double ior = 1.5;
  constexpr double thickness = 2;
  const DSphere ball{{1.5, 0.5, -4}, 0.4};
  SceneBuilder builder;
  builder.set_background(sky);
  builder.add_sphere(Vec3(ball.center), 0.4F, builder.add_material(glowing(red)));
  add_box(builder, {-30, -30, -2}, {30, 30, 0}, builder.add_material(clear(1.5F)));
  const Camera camera{{-1, 0, 4}, {-1, 0, 0}, {0, 1, 0}, 60};
  const RenderSettings settings = settings_of(140, 120);
  const Pinhole pinhole(camera, settings);
  const Frame frame = render(builder, camera, settings);
  expect_pixels(frame, pinhole, 1e-6, [&](const DVec3& direction) {
    const DVec3 exit = behind_slab(pinhole.eye(), direction, ior, thickness);
    return unless_close(gap(exit, direction, ball), red, sky);
  });
  // Without the slab the ball would be elsewhere: the test can tell.
  const auto [px, py] = pinhole.project(ball.center - DVec3(0.35, 0, 0));
  EXPECT_EQ(color_at(frame, static_cast<int>(px), static_cast<int>(py)), sky);
}

TEST_P(SecondaryRays, GlassBallTurnsThePictureUpsideDown) {
  SceneBuilder builder;
  builder.add_sphere({0, 0, 0}, 1, builder.add_material(clear(1.5F)));
  add_quad(builder, {-50, 0, -10}, {100, 0, 0}, {0, 50, 0}, builder.add_material(glowing(red)));
  add_quad(builder, {-50, -50, -10}, {100, 0, 0}, {0, 50, 0}, builder.add_material(glowing(sky)));
  const Camera camera{{0, 0, 6}, {0, 0, 0}, {0, 1, 0}, 30};
  const Frame frame = render(builder, camera, settings_of(100, 100));
  EXPECT_EQ(color_at(frame, 50, 2), red);
  EXPECT_EQ(color_at(frame, 50, 97), sky);
  EXPECT_EQ(color_at(frame, 50, 40), sky); // through the ball
  EXPECT_EQ(color_at(frame, 50, 60), red);
}

// Into a medium of index 2/3, light passes within asin(2/3) of the normal and is reflected as a whole beyond.
TEST_P(SecondaryRays, TotalReflectionBeginsAtTheCriticalAngle) {
  SceneBuilder builder;
  builder.set_background(sky);
  add_quad(builder, {-1e3F, -1e3F, 0}, {2e3F, 0, 0}, {0, 2e3F, 0}, builder.add_material(clear(2.0F / 3)));
  add_quad(builder, {-1e5F, -1e5F, -1}, {2e5F, 0, 0}, {0, 2e5F, 0}, builder.add_material(glowing(red)));
  const Camera camera{{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 110};
  const RenderSettings settings = settings_of(128, 128);
  const Pinhole pinhole(camera, settings);
  const double critical_radius = pinhole.focal() * std::tan(std::asin(2.0 / 3));
  EXPECT_NEAR(critical_radius, 40.08, 0.02);
  expect_pixels(render(builder, camera, settings), pinhole, 1e-6, [&](const DVec3& direction) {
    const double radius = pinhole.focal() * std::hypot(direction.x, direction.y) / -direction.z;
    return unless_close(radius - critical_radius, red, sky);
  });
}

// A prism's long side meets the ray at 45 degrees, beyond the 41.8 of glass: the light goes up, three times
// weighed by the prism's colour.
TEST_P(SecondaryRays, PrismSendsLightAroundTheCorner) {
  SceneBuilder builder;
  const std::vector<Vec3> positions{{-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}};
  const std::vector<std::uint32_t> indices{0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2,
                                           0, 2, 5, 0, 5, 3, 0, 1, 2, 3, 5, 4};
  builder.add_mesh(positions, indices, builder.add_material(clear(1.5F, {0.5F, 1, 0.25F})));
  add_quad(builder, {-5, 9, -5}, {10, 0, 0}, {0, 0, 10}, builder.add_material(glowing({1, 2, 4})));
  const Camera camera{{0.1F, 0.1F, 8}, {0.1F, 0.1F, 0}, {0, 1, 0}, 2};
  const RenderSettings settings = settings_of(9, 9);
  const Frame frame = render(builder, camera, settings);
  expect_pixels(frame, Pinhole(camera, settings), 1e-6,
                [](const DVec3&) { return std::optional(Vec3(0.125F, 2, 0.0625F)); });
  EXPECT_EQ(frame.rays.refracted, 2U * 81U);
  EXPECT_EQ(frame.rays.reflected, 81U);
}

TEST_P(SecondaryRays, ThinFilterColoursWithoutBending) {
  SceneBuilder builder;
  builder.set_ambient({1, 0.5F, 0.25F});
  Material filter = black();
  filter.ambient = Vec3(0.5F);
  filter.opacity = 0.25F;
  filter.transmission = {0.75F, 0.5F, 0.25F};
  filter.ior = 1.5F;
  filter.thin = true;
  const DSphere ball{{0.3, 0.2, -3}, 0.5};
  add_quad(builder, {-30, -30, 0}, {60, 0, 0}, {0, 60, 0}, builder.add_material(filter));
  builder.add_sphere(Vec3(ball.center), 0.5F, builder.add_material(glowing(Vec3(1.0F))));
  const Camera camera{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 45};
  const RenderSettings settings = settings_of(64, 64);
  const Pinhole pinhole(camera, settings);
  const Vec3 own = 0.25F * (0.5F * Vec3(1, 0.5F, 0.25F));
  const Vec3 through = 0.75F * filter.transmission;
  expect_pixels(render(builder, camera, settings), pinhole, 1e-6, [&](const DVec3& direction) {
    return unless_close(gap(pinhole.eye(), direction, ball), own + through, own);
  });
}

TEST_P(SecondaryRays, LightFadesWithTheWayThroughAMedium) {
  Material fog = clear(1, {1, 0.5F, 1});
  fog.absorption = {0.5F, 0, 1.25F};
  SceneBuilder builder;
  builder.set_background(Vec3(2.0F));
  add_box(builder, {-30, -30, -2}, {30, 30, 0}, builder.add_material(fog));
  const Camera camera{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 80};
  const RenderSettings settings = settings_of(50, 50);
  expect_pixels(render(builder, camera, settings), Pinhole(camera, settings), 2e-5,
                [](const DVec3& direction) {
                  const double way = 2 / -direction.z;
                  return std::optional(Vec3(DVec3(2 * std::exp(-0.5 * way), 0.5, 2 * std::exp(-1.25 * way))));
                });
}

// A dielectric at normal incidence reflects ((n - 1) / (n + 1))^2 and lets the rest through.
TEST_P(SecondaryRays, FresnelSharesAddUpAtNormalIncidence) {
  Material glass = clear(1.5F);
  glass.fresnel = Fresnel::dielectric;
  glass.mirror = Vec3(1.0F);
  SceneBuilder builder;
  builder.set_background({1, 0, 0});
  add_quad(builder, {-30, -30, 0}, {60, 0, 0}, {0, 60, 0}, builder.add_material(glass));
  add_quad(builder, {-30, -30, -1}, {60, 0, 0}, {0, 60, 0}, builder.add_material(glowing({0, 1, 0})));
  const Camera camera{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 1};
  const RenderSettings settings = settings_of(3, 3);
  expect_pixels(render(builder, camera, settings), Pinhole(camera, settings), 1e-5,
                [](const DVec3&) { return std::optional(Vec3(0.04F, 0.96F, 0)); });
}

class MirrorHall : public SecondaryRays {
protected:
  // Between two glowing mirrors that give back half: 1 + 1/2 + 1/4 ..., without any rounding.
  Frame hall(int max_depth, float min_contribution) const {
    SceneBuilder builder;
    Material material = mirror(0.5F);
    material.emission = Vec3(1.0F);
    const std::uint32_t glass = builder.add_material(material);
    add_quad(builder, {-1e4F, -1e4F, -1}, {2e4F, 0, 0}, {0, 2e4F, 0}, glass);
    add_quad(builder, {-1e4F, -1e4F, 1}, {2e4F, 0, 0}, {0, 2e4F, 0}, glass);
    RenderSettings settings = settings_of(8, 8);
    settings.max_depth = max_depth;
    settings.min_contribution = min_contribution;
    return render(builder, {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 30}, settings);
  }
};

TEST_P(MirrorHall, DepthEndsTheReflections) {
  double expected = 1;
  for (int depth = 0; depth <= 10; ++depth) {
    const Frame frame = hall(depth, 0);
    for (const float value : frame.rgb) EXPECT_EQ(value, static_cast<float>(expected)) << depth;
    EXPECT_EQ(frame.rays.reflected, static_cast<std::uint64_t>(64 * depth));
    expected += std::ldexp(1.0, -(depth + 1));
  }
}

TEST_P(MirrorHall, SmallContributionsAreNotTraced) {
  const Frame at_an_eighth = hall(64, 0.125F);
  for (const float value : at_an_eighth.rgb) EXPECT_EQ(value, 1.875F);
  EXPECT_EQ(at_an_eighth.rays.reflected, 64U * 3U);
  const Frame above_an_eighth = hall(64, 0.1251F);
  for (const float value : above_an_eighth.rgb) EXPECT_EQ(value, 1.75F);
}

FASTRT_PICTURES(SecondaryRays);
FASTRT_PICTURES(MirrorHall);

} // namespace
} // namespace fastrt::test
