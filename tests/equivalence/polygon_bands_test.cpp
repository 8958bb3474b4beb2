// SPDX-License-Identifier: Apache-2.0
// Polygons with so many edges that kernels look at them by height, of every ISA against the naive reference;
// and what a cancelled picture looks like.
#include "tests/equivalence/frames.hpp"
#include "tests/unit/shape_scenes.hpp"

#include <algorithm>
#include <atomic>

namespace fastrt::test {
namespace {

// Teeth from top to bottom, each as high as the whole: no band can leave an edge out.
std::vector<Vec3> comb(int teeth, float half) {
  std::vector<Vec3> contour;
  for (int i = 0; i <= 2 * teeth; ++i) {
    const float x = half * (static_cast<float>(i) / static_cast<float>(teeth) - 1.0F);
    contour.emplace_back(x, i % 2 == 0 ? -half : half, 0.0F);
  }
  contour.emplace_back(half, -1.1F * half, 0.0F);
  contour.emplace_back(-half, -1.1F * half, 0.0F);
  return contour;
}

Shot shot_of(const std::string& name, const std::vector<std::vector<Vec3>>& contours) {
  SceneBuilder builder;
  Material material;
  material.mirror = Vec3(0.3F);
  const std::uint32_t some = builder.add_material(material);
  builder.add_polygon(contours, some);
  builder.add_disk({0, 0, -1}, {0.2F, 0.1F, 1}, 2, some);
  Light light;
  light.kind = LightKind::point;
  light.position = {1, 2, 5};
  builder.add_light(light);
  return {name, builder.build(), looking({0.3F, 0.2F, 3}, {0, 0, 0}), small_settings(75, 61)};
}

void expect_same(const Shot& shot) {
  const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
  EXPECT_GT(pixels_with_hits(expected), 500U) << shot.name;
  expect_every_isa_makes(expected, shot, {1, 2});
}

TEST(PolygonBands, MakeTheSamePictures) {
  const Vec3 middle(0), front(0, 0, 1), tilted(0.2F, -0.4F, 1);
  expect_same(shot_of("wheel", {star(middle, front, 1, 150, 0.9F), star(middle, front, 0.5F, 9, 0.7F)}));
  expect_same(shot_of("star", {star(middle, tilted, 1, 60, 0.1F, 0.3F)}));
  expect_same(shot_of("comb", {comb(40, 1)}));
}

// In one plane every ray meets them at equal t, in the tree's order: the smallest id counts.
TEST(CoplanarPolygons, ShowTheFirstOfThem) {
  Random random(91);
  SceneBuilder builder;
  const std::uint32_t some = builder.add_material({});
  for (int i = 0; i < 60; ++i) {
    const Vec3 middle(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    const std::vector<std::vector<Vec3>> contours{
        star(middle, {0, 0, 1}, random.uniform(0.3F, 0.6F), i % 2 == 0 ? 3 : 20, 0.8F)};
    builder.add_polygon(contours, some);
  }
  const Shot shot{"coplanar", builder.build(), looking({0.3F, 0.2F, 3}, {0, 0, 0}), small_settings(75, 61)};
  expect_same(shot);
}

TEST(CancelledFrame, IsBlackWhereNobodyCame) {
  const Shot shot = shot_of("wheel", {star(Vec3(0), Vec3(0, 0, 1), 3, 50, 0.9F)});
  for (const Isa isa : simd_isas()) {
    std::atomic<bool> cancelled = false;
    RenderSettings settings = small_settings(128, 64);
    settings.threads = 1;
    settings.cancelled = &cancelled;
    settings.progress = [&](double share) { cancelled = share > 0.49; };
    const Frame frame = render(make_tracer(shot.scene, isa), shot.camera, settings);
    EXPECT_FALSE(frame.complete);
    EXPECT_EQ(frame.rays.primary, 128U * 32U);
    const auto half = static_cast<std::ptrdiff_t>(frame.primitive.size() / 2);
    EXPECT_EQ(std::count(frame.primitive.begin() + half, frame.primitive.end(), no_primitive), half);
    EXPECT_EQ(std::count(frame.rgb.begin() + 3 * half, frame.rgb.end(), 0.0F), 3 * half);
    EXPECT_LT(std::count(frame.primitive.begin(), frame.primitive.begin() + half, no_primitive), half);
  }
}

} // namespace
} // namespace fastrt::test
