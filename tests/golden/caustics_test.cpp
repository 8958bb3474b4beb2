// SPDX-License-Identifier: Apache-2.0
// What mirrors and glass do to light, by photons of the forward tracer and of caustics, against optics.
#include "tests/golden/pictures.hpp"

#include <fastrt/load.hpp>

namespace fastrt::test {
namespace {

class CausticPictures : public Picture {
protected:
  // Both ways to see bent light; the second has no light that bounces off diffuse surfaces.
  Frame by_photons(const Scene& scene, const Camera& camera, RenderSettings settings, bool forward,
                   int photons) const {
    if (forward) settings.integrator = Integrator::forward;
    (forward ? settings.photons : settings.caustic_photons) = photons;
    return GetParam().render(scene, camera, settings);
  }
};

// So dark that what it scatters is not worth following.
Material dark_matt() {
  Material material = black();
  material.diffuse = Vec3(0.01F);
  return material;
}

Light beam(const Vec3& direction) {
  Light light;
  light.kind = LightKind::directional;
  light.direction = direction;
  return light;
}

// Mean of what the middle of the picture shows of the light, per Kd.
double light_in_the_middle(const Frame& frame) {
  double sum = 0;
  int count = 0;
  for (int y = frame.height / 4; y < 3 * frame.height / 4; ++y)
    for (int x = frame.width / 4; x < 3 * frame.width / 4; ++x, ++count)
      sum += static_cast<double>(color_at(frame, x, y).y);
  return sum / count / 0.01;
}

RenderSettings settings_for_optics() {
  RenderSettings settings = settings_of(16, 16);
  settings.min_contribution = 0.02F;
  settings.max_depth = 20;
  return settings;
}

// Light along the floor meets a mirror at 45 degrees and falls straight down. shown: whether the mirror is
// an instance of something that is none.
Scene mirror_over_floor(bool shown) {
  SceneBuilder builder;
  builder.add_light(beam({-1, 0, 0}));
  add_quad(builder, {-0.5F, 0, -0.5F}, {1, 0, 0}, {0, 0, 1}, builder.add_material(dark_matt()));
  const std::uint32_t shining = builder.add_material(mirror(0.75F));
  if (!shown) {
    add_quad(builder, {-0.5F, 1.5F, -0.5F}, {1, 1, 0}, {0, 0, 1}, shining);
    return builder.build();
  }
  const std::uint32_t dark = builder.add_material(black());
  builder.begin_prototype();
  add_quad(builder, {0, 0, 0}, {0, 2, 0}, {2, 0, 0}, dark);
  builder.add_instance(builder.end_prototype(),
                       {{0, 0, 0.5F}, {0.5F, 0.5F, 0}, {1, -1, 0}, {-0.5F, 1.5F, -0.5F}}, shining);
  return builder.build();
}

TEST_P(CausticPictures, Mirror) {
  const Camera camera{{2.5F, 1, 0}, {0, 0, 0}, {0, 1, 0}, 10};
  for (const bool shown : {false, true})
    for (const bool forward : {true, false}) {
      const Frame frame = by_photons(mirror_over_floor(shown), camera, settings_for_optics(), forward,
                                     forward ? 150000 : 20000);
      EXPECT_NEAR(light_in_the_middle(frame), 0.75, 0.02) << forward << shown;
    }
}

// A plane has no bounds; photons are kept there too, as far as four times the scene's size beside it.
TEST_P(CausticPictures, MirrorOverAPlane) {
  SceneBuilder builder;
  builder.add_light(beam({-1, 0, 0}));
  builder.add_plane({0, 0, 0}, {0, 1, 0}, builder.add_material(dark_matt()));
  add_quad(builder, {-0.5F, 1.5F, -0.5F}, {1, 1, 0}, {0, 0, 1}, builder.add_material(mirror(0.75F)));
  const Camera camera{{2.5F, 1, 0}, {0, 0, 0}, {0, 1, 0}, 10};
  const Frame frame = by_photons(builder.build(), camera, settings_for_optics(), false, 20000);
  EXPECT_NEAR(light_in_the_middle(frame), 0.75, 0.02);
}

// A lamp that is a mesh, beside a mirror at x = 0.5 or beside its own image.
Scene lamp_and_image(bool mirrored) {
  SceneBuilder builder;
  Light light;
  light.kind = LightKind::mesh;
  light.material = builder.add_material(glowing(Vec3(2.0F)));
  builder.add_light(light);
  add_quad(builder, {-0.5F, 0, -0.5F}, {1, 0, 0}, {0, 0, 1}, builder.add_material(dark_matt()));
  add_quad(builder, {-0.8F, 0.6F, -0.2F}, {0.2F, 0.3F, 0}, {0, 0, 0.4F}, light.material);
  if (mirrored)
    add_quad(builder, {0.5F, 0, -2}, {0, 3, 0}, {0, 0, 4}, builder.add_material(mirror(1)));
  else
    add_quad(builder, {1.8F, 0.6F, -0.2F}, {-0.2F, 0.3F, 0}, {0, 0, 0.4F}, light.material);
  return builder.build();
}

// The image lights the floor as a lamp does that stands there.
TEST_P(CausticPictures, LampInAMirror) {
  Camera camera{{0, 2, 0}, {0, 0, 0}, {0, 0, -1}};
  camera.projection = Projection::orthographic;
  camera.view_height = 0.8F;
  RenderSettings settings = settings_for_optics();
  settings.light_samples = 64;
  const double expected = light_in_the_middle(GetParam().render(lamp_and_image(false), camera, settings));
  for (const bool forward : {true, false}) {
    const Frame frame = by_photons(lamp_and_image(true), camera, settings, forward, 200000);
    EXPECT_NEAR(light_in_the_middle(frame), expected, 0.03 * expected) << forward;
  }
}

// A plate of glass lets (1 - F) / (1 + F) through, of light that falls on it straight; F = 0.04.
TEST_P(CausticPictures, PlateOfGlass) {
  SceneBuilder builder;
  builder.add_light(beam({0, -1, 0}));
  Material glass = clear(1.5F);
  glass.mirror = Vec3(1.0F);
  glass.fresnel = Fresnel::dielectric;
  add_quad(builder, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, builder.add_material(dark_matt()));
  add_box(builder, {-1, 1, -1}, {1, 1.25F, 1}, builder.add_material(glass));
  const Scene scene = builder.build();
  const Camera camera{{2, 0.8F, 0}, {0, 0, 0}, {0, 1, 0}, 18};
  RenderSettings settings = settings_for_optics();
  settings.min_contribution = 1e-4F;
  for (const bool forward : {true, false}) {
    const Frame frame = by_photons(scene, camera, settings, forward, forward ? 60000 : 20000);
    // Of the forward picture: what the floor scatters and the plate sends back is at most 1 % of it.
    EXPECT_NEAR(light_in_the_middle(frame), 0.96 / 1.04, 0.02) << forward;
  }
}

// The plate throws no second light: shadow rays end on glass, but not on a thin pane.
TEST_P(CausticPictures, LightIsNotCountedTwice) {
  for (const bool thin : {false, true}) {
    SceneBuilder builder;
    builder.add_light(beam({0, -1, 0}));
    Material glass = clear(1.0F, Vec3(0.5F));
    glass.thin = thin;
    add_quad(builder, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, builder.add_material(dark_matt()));
    add_quad(builder, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, builder.add_material(glass));
    const Scene scene = builder.build();
    const Camera camera{{2, 0.8F, 0}, {0, 0, 0}, {0, 1, 0}, 18};
    const Frame frame = by_photons(scene, camera, settings_for_optics(), false, 20000);
    EXPECT_NEAR(light_in_the_middle(frame), 0.5, 0.01) << thin;
  }
}

// Water whose surface is a plane above all that has bounds: half of the sun's light goes through it. A roof
// there keeps all of it off.
TEST_P(CausticPictures, SunOverAnEndlessSurface) {
  for (const bool roof : {false, true}) {
    SceneBuilder builder;
    builder.add_light(beam({0.1F, -1, 0}));
    add_quad(builder, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, builder.add_material(dark_matt()));
    builder.add_plane({0, 5, 0}, {0, 1, 0}, builder.add_material(roof ? black() : clear(1.333F, Vec3(0.5F))));
    const Scene scene = builder.build();
    const Camera camera{{2, 0.8F, 0}, {0, 0, 0}, {0, 1, 0}, 18};
    const double expected = roof ? 0 : 0.5 / std::sqrt(1.01);
    for (const bool forward : {true, false}) {
      const Frame frame = by_photons(scene, camera, settings_for_optics(), forward, 60000);
      EXPECT_NEAR(light_in_the_middle(frame), expected, 0.02) << roof << forward;
    }
  }
}

// A lamp 1 below the face of a medium: on a ceiling 1 above it, light that spreads by angles of a in the
// medium and of 1.5 a above it is (1 + 1.5)^2 / (1 + 1)^2 thinner. The medium takes its part of the way in
// it.
TEST_P(CausticPictures, LampInAMedium) {
  SceneBuilder builder;
  Light light;
  light.kind = LightKind::spot;
  light.position = Vec3(0.0F);
  light.direction = {0, 1, 0};
  light.cone_degrees = 12;
  light.penumbra_degrees = 0;
  builder.add_light(light);
  Material medium = clear(1.5F);
  medium.absorption = Vec3(0.3F);
  add_box(builder, {-3, -3, -3}, {3, 1, 3}, builder.add_material(medium));
  builder.add_disk({0, 2, 0}, {0, 1, 0}, 0.4F, builder.add_material(dark_matt()));
  const Scene scene = builder.build();
  Camera camera{{0, 1.5F, 0}, {0, 2, 0}, {0, 0, -1}};
  camera.projection = Projection::orthographic;
  camera.view_height = 0.4F;
  const double expected = std::exp(-0.3) / (1.25 * 1.25);
  for (const bool forward : {true, false}) {
    const Frame frame = by_photons(scene, camera, settings_for_optics(), forward, 60000);
    EXPECT_NEAR(light_in_the_middle(frame), expected, 0.03 * expected) << forward;
  }
}

// How wide the light on a floor is that a ball of glass throws from a narrow beam: the root of its mean
// square distance from the axis, and how much light there is.
struct Spot {
  double width, light;
};

// The floor is `distance` below the ball's middle; a screen with a hole of radius 0.1 is above the ball.
Scene ball_lens(float distance) {
  SceneBuilder builder;
  builder.add_light(beam({0, -1, 0}));
  builder.add_sphere({0, 0, 0}, 1, builder.add_material(clear(1.5F)));
  builder.add_disk({0, -distance, 0}, {0, 1, 0}, 0.5F, builder.add_material(dark_matt()));
  const float h = 1.1F;
  std::vector<Vec3> hole;
  for (int i = 0; i < 64; ++i) {
    const double angle = i * std::numbers::pi / 32;
    hole.emplace_back(0.1 * std::cos(angle), h, 0.1 * std::sin(angle));
  }
  const std::vector<std::vector<Vec3>> screen{
      {{-1.5F, h, -1.5F}, {1.5F, h, -1.5F}, {1.5F, h, 1.5F}, {-1.5F, h, 1.5F}}, hole};
  builder.add_polygon(screen, builder.add_material(black()));
  return builder.build();
}

// Seen from the side, under the ball: rows are foreshortened, columns are not.
Camera under_the_ball(float distance) {
  Camera camera{{3, 0.9F - distance, 0}, {0, -distance, 0}, {0, 1, 0}};
  camera.projection = Projection::orthographic;
  camera.view_height = 0.24F;
  return camera;
}

Spot measure(const Frame& frame) {
  Spot spot{0, 0};
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const double across = ((x + 0.5) / frame.width - 0.5) * 0.24;
      const double light = static_cast<double>(color_at(frame, x, y).y) / 0.01;
      spot.light += light;
      spot.width += light * across * across;
    }
  spot.width = std::sqrt(spot.width / spot.light);
  // A pixel's area of the floor.
  spot.light *= std::pow(0.24 / frame.height, 2) / (0.9 / std::hypot(3, 0.9));
  return spot;
}

// Paraxial light meets n r / (2 (n - 1)) = 1.5 radii behind the ball's middle, and before and behind it the
// spot is as wide as the distance to there. All that goes through the hole arrives.
TEST_P(CausticPictures, BallLensHasItsFocus) {
  for (const float distance : {1.25F, 1.5F, 1.75F}) {
    RenderSettings settings = settings_for_optics();
    settings.width = settings.height = 48;
    const Frame frame = by_photons(ball_lens(distance), under_the_ball(distance), settings, true, 600000);
    const Spot spot = measure(frame);
    const double paraxial =
        0.05 * std::fabs(static_cast<double>(distance) - 1.5) / 1.5; // of a disk: radius / 2
    EXPECT_NEAR(spot.width, paraxial, 0.0025) << distance;
    EXPECT_NEAR(spot.light, 0.01 * std::numbers::pi, 0.0015) << distance;
  }
}

FASTRT_PICTURES(CausticPictures);

double mean(const Frame& frame, const Crop& part) {
  double sum = 0;
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x) sum += static_cast<double>(color_at(frame, x, y).y);
  return sum / ((part.x1 - part.x0) * (part.y1 - part.y0));
}

// The glass ball of scenes/caustic.nff: both integrators agree on what it gathers, in the middle and around
// it, and on the floor beside its shadow.
TEST(CausticScene, BothIntegratorsAgree) {
  Diagnostics diagnostics;
  SceneDesc desc = load_scene(std::string(FASTRT_SOURCE_DIR) + "/scenes/caustic.nff", {}, diagnostics);
  const Camera camera = desc.camera.value();
  const Tracer tracer{Scene(std::move(desc))};
  RenderSettings settings;
  settings.width = 320;
  settings.height = 180;
  settings.crop = Crop{70, 95, 150, 145};
  settings.samples_per_pixel = 64; // the focus is smaller than a pixel
  settings.filter = PixelFilter::box;
  settings.caustic_photons = 200000;
  const Frame whitted = render(tracer, camera, settings);
  settings.samples_per_pixel = 1;
  settings.caustic_photons = 0;
  settings.integrator = Integrator::forward;
  settings.photons = 4000000;
  const Frame forward = render(tracer, camera, settings);
  const Crop middle{59, 7, 71, 15}, below{56, 16, 74, 20}, floor{0, 20, 20, 50};
  EXPECT_GT(mean(whitted, middle), 4 * mean(whitted, floor));
  EXPECT_LT(mean(whitted, below), mean(whitted, floor));
  for (const Crop& part : {middle, below, floor})
    EXPECT_NEAR(mean(forward, part), mean(whitted, part), 0.1 * mean(whitted, part)) << part.x0;
}

} // namespace
} // namespace fastrt::test
