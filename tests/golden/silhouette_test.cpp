// SPDX-License-Identifier: Apache-2.0
// Where things are in the picture, and which of them is in front.
#include "tests/golden/pictures.hpp"

namespace fastrt::test {
namespace {

class Silhouette : public Picture {};

const Vec3 white{1.0F};
const Vec3 blue{0, 0, 0.5F};

Camera from_front(float distance, float fov) { return {{0, 0, distance}, {0, 0, 0}, {0, 1, 0}, fov}; }

TEST_P(Silhouette, SphereIsADiscOfTheRightSize) {
  SceneBuilder builder;
  builder.add_sphere({0, 0, 0}, 1, builder.add_material(glowing(white)));
  const Camera camera = from_front(5, 40);
  const RenderSettings settings = settings_of(161, 121);
  const Frame frame = render(builder, camera, settings);

  // The tangent cone of a sphere at distance 5 has the half angle asin(1/5).
  const double radius = std::tan(std::asin(1.0 / 5)) * Pinhole(camera, settings).focal();
  int area = 0;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const double from_center = std::hypot(x + 0.5 - 80.5, y + 0.5 - 60.5);
      const bool seen = primitive_at(frame, x, y) == 0;
      area += seen ? 1 : 0;
      if (std::fabs(from_center - radius) > 1e-3) {
        EXPECT_EQ(seen, from_center < radius) << x << " " << y;
      }
    }
  EXPECT_NEAR(area, std::numbers::pi * radius * radius, 2 * radius);
}

TEST_P(Silhouette, SpheresOffTheAxisAndTurnedCamera) {
  const std::vector<DSphere> spheres{{{1.5, 0.4, -2}, 0.7}, {{-1.2, -0.8, 1}, 0.5}, {{0.1, 1.4, 0}, 0.25}};
  SceneBuilder builder;
  builder.set_background(blue);
  const std::uint32_t material = builder.add_material(glowing(white));
  for (const DSphere& sphere : spheres)
    builder.add_sphere(Vec3(sphere.center), static_cast<float>(sphere.radius), material);
  const Camera camera{{3, 2, 6}, {0.2F, 0.1F, 0}, {0.3F, 1, 0.1F}, 55};
  const RenderSettings settings = settings_of(120, 160);
  const Pinhole pinhole(camera, settings);
  expect_pixels(render(builder, camera, settings), pinhole, 0, [&](const DVec3& direction) {
    double nearest = 1;
    for (const DSphere& sphere : spheres) nearest = std::min(nearest, gap(pinhole.eye(), direction, sphere));
    if (std::fabs(nearest) < 1e-4) return std::optional<Vec3>();
    return std::optional(nearest < 0 ? white : blue);
  });
}

TEST_P(Silhouette, QuadHasStraightEdges) {
  SceneBuilder builder;
  add_quad(builder, {-1, -0.5F, 0}, {1.5F, 0, 0}, {0, 1.25F, 0}, builder.add_material(glowing(white)));
  const Camera camera = from_front(4, 50);
  const RenderSettings settings = settings_of(150, 100);
  expect_pixels(render(builder, camera, settings), Pinhole(camera, settings), 0, [](const DVec3& direction) {
    const DVec3 point = DVec3(0, 0, 4) - direction * (4 / direction.z);
    const double outside = std::max({-1 - point.x, point.x - 0.5, -0.5 - point.y, point.y - 0.75});
    if (std::fabs(outside) < 1e-5) return std::optional<Vec3>();
    return std::optional(outside < 0 ? white : Vec3(0.0F));
  });
}

// The lecture notes' scene signature: each pixel says which object it sees.
TEST_P(Silhouette, SignatureNamesTheNearestObject) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  add_quad(builder, {-4, -4, -3}, {8, 0, 0}, {0, 8, 0}, material); // 0, 1: the wall behind
  add_box(builder, {-2, -1, -1}, {-1, 0, 0}, material);            // 2 .. 13
  builder.add_sphere({1.5F, 1, 0}, 0.5F, material);                // 14
  builder.add_sphere({1.5F, 1, 1}, 0.2F, material);                // 15, before 14
  builder.add_sphere({1.5F, 1, -1}, 0.2F, material);               // 16, hidden by 14
  builder.add_sphere({0, 0, 20}, 1, material);                     // 17, behind the camera
  const Camera camera = from_front(8, 60);
  const RenderSettings settings = settings_of(200, 200);
  const Pinhole pinhole(camera, settings);
  const Frame frame = render(builder, camera, settings);
  const auto seen_at = [&](const DVec3& point) {
    const auto [px, py] = pinhole.project(point);
    return primitive_at(frame, static_cast<int>(px), static_cast<int>(py));
  };
  EXPECT_EQ(seen_at({1.5, 1, 1}), 15);
  EXPECT_EQ(seen_at({1.5, 1.4, 0}), 14);
  EXPECT_EQ(seen_at({1.5, 0.6, 0}), 14);
  // The box's front is z = 0: vertices 4 to 7, so the triangles 2 + 2 and 2 + 3.
  EXPECT_EQ(seen_at({-1.8, -0.8, 0}), 4);
  EXPECT_EQ(seen_at({-1.2, -0.2, 0}), 5);
  EXPECT_EQ(seen_at({3, -2, -3}), 0);
  EXPECT_EQ(seen_at({-2, 3, -3}), 1);
  EXPECT_EQ(primitive_at(frame, 0, 0), no_primitive);
  EXPECT_EQ(std::count(frame.primitive.begin(), frame.primitive.end(), 16), 0);
  EXPECT_EQ(std::count(frame.primitive.begin(), frame.primitive.end(), 17), 0);
}

TEST_P(Silhouette, SamplesCoverAPixelEvenly) {
  SceneBuilder builder;
  builder.set_background(Vec3(0.25F));
  add_quad(builder, {-10, -10, 0}, {10, 0, 0}, {0, 20, 0}, builder.add_material(glowing(white)));
  RenderSettings settings = settings_of(5, 5);
  settings.samples_per_pixel = 64;
  settings.filter = PixelFilter::box;
  const Frame frame = render(builder, from_front(5, 40), settings);
  for (int y = 0; y < 5; ++y) {
    EXPECT_EQ(color_at(frame, 0, y), white);
    EXPECT_NEAR(color_at(frame, 2, y).x, 0.625F, 0.02F); // the edge goes through its middle
    EXPECT_EQ(color_at(frame, 4, y), Vec3(0.25F));
  }
  EXPECT_EQ(frame.rays.primary, 5U * 5U * 64U);
}

FASTRT_PICTURES(Silhouette);

} // namespace
} // namespace fastrt::test
