// SPDX-License-Identifier: Apache-2.0
// Cameras against closed forms: parallel rays, the lecture's window, a thin lens, parts of pictures.
#include "src/film/adaptive.hpp"
#include "tests/golden/pictures.hpp"

#include <fastrt/error.hpp>

namespace fastrt::test {
namespace {

const Vec3 white(1.0F);

class Cameras : public Picture {};

Camera parallel(float height) {
  Camera camera;
  camera.projection = Projection::orthographic;
  camera.view_height = height;
  return camera;
}

SceneBuilder one_ball(const Vec3& center, float radius) {
  SceneBuilder builder;
  builder.add_sphere(center, radius, builder.add_material(glowing(white)));
  return builder;
}

// Far or near, a ball's silhouette is a circle of its own radius.
TEST_P(Cameras, OrthographicSilhouetteIsTheBallsOwn) {
  for (const float z : {0.0F, -40.0F}) {
    SceneBuilder builder = one_ball({0.25F, -0.125F, z}, 1.5F);
    const Frame frame = render(builder, parallel(4), settings_of(200, 160));
    int seen = 0;
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 200; ++x) {
        const double px = (x + 0.5 - 100) / 40 - 0.25, py = (80 - y - 0.5) / 40 + 0.125;
        const double gap = std::hypot(px, py) - 1.5;
        const bool hit = primitive_at(frame, x, y) == 0;
        seen += hit ? 1 : 0;
        EXPECT_TRUE(std::fabs(gap) < 1e-4 || hit == (gap < 0)) << x << ',' << y;
      }
    EXPECT_NEAR(seen / 1600.0, std::numbers::pi * 1.5 * 1.5, 0.02); // pixels of 1/40
  }
}

// Only what is before the eye is seen.
TEST_P(Cameras, OrthographicRaysStartAtTheEye) {
  SceneBuilder builder = one_ball({0, 0, 7}, 1);
  EXPECT_EQ(primitive_at(render(builder, parallel(4), settings_of(9, 9)), 4, 4), no_primitive);
}

TEST_P(Cameras, OrthographicDepthIsTheDistanceOfThePlanes) {
  SceneBuilder builder;
  add_quad(builder, {-5, -5, -3}, {10, 0, 0}, {0, 10, 0}, builder.add_material({}));
  RenderSettings settings = settings_of(33, 20);
  settings.aovs = {Aov::depth};
  const Frame frame = render(builder, parallel(3), settings);
  for (const float depth : frame.find(Aov::depth)->values) EXPECT_FLOAT_EQ(depth, 8);
}

// The lecture's pixel (i, j) sees the point (wl + i du, wt + j dv) of a wall at the focal distance.
TEST_P(Cameras, WindowShowsItsPointsOfTheViewPlane) {
  SceneBuilder builder;
  add_quad(builder, {-50, -50, 2}, {100, 0, 0}, {0, 100, 0}, builder.add_material({}));
  Camera camera;                          // at z = 5
  camera.window = Window{0.5F, 2, -3, 1}; // off the centre
  camera.focal_distance = 3;
  RenderSettings settings = settings_of(7, 5);
  settings.aovs = {Aov::position};
  const Frame frame = render(builder, camera, settings);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 7; ++i) {
      const float* p = &frame.find(Aov::position)->values[static_cast<std::size_t>(3 * (7 * j + i))];
      EXPECT_NEAR(p[0], 0.5 + i * 1.5 / 6, 1e-5);
      EXPECT_NEAR(p[1], 1 - j * 4.0 / 4, 1e-5);
      EXPECT_NEAR(p[2], 2, 1e-5);
    }
}

// A small glowing ball off the focus is a disk: at z, of the radius R |1 / F - 1 / z| on the plane at
// distance 1, and as much light as the sharp one.
TEST_P(Cameras, CircleOfConfusion) {
  constexpr double focus = 4, radius = 0.125, ball = 0.02;
  for (const double z : {2.0, 4.0, 16.0}) {
    SceneBuilder builder = one_ball({0, 0, 5 - static_cast<float>(z)}, static_cast<float>(ball * z));
    Camera camera;
    camera.fov_degrees = 12;
    camera.aperture_radius = static_cast<float>(radius);
    camera.focus_distance = static_cast<float>(focus);
    RenderSettings settings = settings_of(64, 64);
    settings.samples_per_pixel = 64;
    settings.filter = PixelFilter::box;
    const Pinhole pinhole(camera, settings);
    const Frame frame = render(builder, camera, settings);
    double farthest = 0, light = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const double value = static_cast<double>(color_at(frame, x, y).x);
        light += value;
        if (value > 0) farthest = std::max(farthest, std::hypot(x + 0.5 - 32, y + 0.5 - 32));
      }
    const double edge = pinhole.focal() * (radius * std::fabs(1 / focus - 1 / z) + ball);
    EXPECT_NEAR(farthest, edge, 1) << z; // a pixel: half its diagonal, and what samples may miss
    const double sharp = std::numbers::pi * std::pow(pinhole.focal() * ball, 2);
    EXPECT_NEAR(light / sharp, 1, 0.02) << z;
  }
}

TEST_P(Cameras, OneSampleGoesThroughTheMiddleOfTheLens) {
  SceneBuilder builder = one_ball({0.3F, 0.2F, 1}, 0.7F), same = one_ball({0.3F, 0.2F, 1}, 0.7F);
  Camera camera;
  const Frame pinhole = render(builder, camera, settings_of(40, 30));
  camera.aperture_radius = 0.5F;
  EXPECT_TRUE(compare(render(same, camera, settings_of(40, 30)), pinhole).equal());
}

SceneBuilder some_scene() {
  SceneBuilder builder;
  builder.set_background({0.1F, 0.2F, 0.4F});
  builder.set_ambient(Vec3(0.3F));
  Material shiny;
  shiny.mirror = Vec3(0.4F);
  const std::uint32_t material = builder.add_material(shiny);
  add_quad(builder, {-3, -1, -3}, {6, 0, 0}, {0, 0, -6}, material);
  builder.add_sphere({-0.8F, 0, 0}, 1, material);
  builder.add_sphere({1, 0.3F, -1}, 1, builder.add_material(clear(1.5F)));
  Light light;
  light.kind = LightKind::point;
  light.position = {2, 4, 5};
  builder.add_light(light);
  return builder;
}

// Every bit of a part is the whole picture's.
TEST_P(Cameras, CropIsThatPartOfThePicture) {
  const auto with = [](auto change) {
    std::pair<Camera, RenderSettings> shot{Camera{}, settings_of(53, 37)};
    shot.second.threads = 1;
    for (std::size_t i = 0; i < aov_count; ++i) shot.second.aovs.push_back(static_cast<Aov>(i));
    change(shot.first, shot.second);
    return shot;
  };
  const std::vector<std::pair<Camera, RenderSettings>> shots = {
      with([](Camera&, RenderSettings&) {}), with([](Camera& c, RenderSettings& s) {
        c.aperture_radius = 0.2F;
        s.samples_per_pixel = 3;
        s.filter = PixelFilter::mitchell;
      }),
      with([](Camera& c, RenderSettings&) { c.projection = Projection::orthographic; }),
      with([](Camera& c, RenderSettings&) {
        c.window = Window{-0.3F, 0.2F, -0.1F, 0.2F};
      }),
      with([](Camera&, RenderSettings& s) {
        s.samples_per_pixel = 2;
        s.adaptive = 0.03F;
        s.most_samples = 11;
      })};
  for (const auto& [camera, settings] : shots) {
    SceneBuilder builder = some_scene();
    const Frame whole = render(builder, camera, settings);
    for (const Crop& crop :
         {Crop{0, 0, 53, 37}, Crop{5, 3, 6, 4}, Crop{17, 11, 41, 37}, Crop{30, 0, 53, 9}}) {
      RenderSettings part = settings;
      part.crop = crop;
      SceneBuilder again = some_scene();
      const Frame frame = render(again, camera, part);
      ASSERT_EQ(frame.width, crop.x1 - crop.x0);
      ASSERT_EQ(frame.height, crop.y1 - crop.y0);
      EXPECT_TRUE(compare(frame, cut_out(whole, {0, 0, 53, 37}, crop)).equal());
      EXPECT_EQ(frame.samples, cut_out(whole, {0, 0, 53, 37}, crop).samples);
    }
  }
}

TEST_P(Cameras, CropOutsideOfThePictureIsRefused) {
  for (const Crop& crop : {Crop{0, 0, 9, 8}, Crop{-1, 0, 4, 4}, Crop{3, 3, 3, 5}, Crop{0, 5, 4, 4}}) {
    SceneBuilder builder = some_scene();
    RenderSettings settings = settings_of(8, 8);
    settings.crop = crop;
    EXPECT_THROW(render(builder, Camera{}, settings), UsageError);
  }
}

FASTRT_PICTURES(Cameras);

} // namespace
} // namespace fastrt::test
