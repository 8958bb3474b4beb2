// SPDX-License-Identifier: Apache-2.0
#include "src/reference/render.hpp"
#include "src/trace/scalar_bvh.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <stdexcept>

namespace fastrt::test {
namespace {

// A bit of everything: a mesh, glass, a mirror, a filter, two kinds of light.
Scene showcase() {
  SceneBuilder builder;
  builder.set_ambient({0.1F, 0.1F, 0.2F});
  builder.set_background({0.2F, 0.3F, 0.5F});
  Material plastic;
  plastic.specular = Vec3(0.5F);
  plastic.shininess = 30;
  plastic.mirror = Vec3(0.25F);
  Material glass;
  glass.diffuse = Vec3(0.0F);
  glass.opacity = 0.1F;
  glass.ior = 1.5F;
  glass.mirror = Vec3(1.0F);
  glass.fresnel = Fresnel::dielectric;
  glass.absorption = {0.1F, 0.5F, 0.5F};
  Material filter;
  filter.opacity = 0.5F;
  filter.transmission = {0.5F, 1, 0.5F};
  filter.thin = true;
  const std::uint32_t plastic_id = builder.add_material(plastic);
  Random random(11);
  add(builder, placed(jittered(icosphere(1), 0.05F, random), 0.8F, {-1, 0.8F, 0}), plastic_id);
  add(builder, grid(3, {-4, 0, -4}, {8, 0, 0}, {0, 0, 8}), plastic_id);
  add(builder, grid(1, {-0.5F, 2, -2}, {1.5F, 0.2F, 0}, {0, 0.1F, 2}), builder.add_material(filter));
  builder.add_sphere({1, 0.7F, 0.5F}, 0.6F, builder.add_material(glass));
  Light lamp;
  lamp.position = {1, 5, 3};
  builder.add_light(lamp);
  Light sun;
  sun.kind = LightKind::directional;
  sun.direction = {-1, -2, -0.5F};
  sun.intensity = Vec3(0.5F);
  builder.add_light(sun);
  return builder.build();
}

const Camera camera{{0, 2, 6}, {0, 0.5F, 0}, {0, 1, 0}, 40};

RenderSettings small_picture() {
  RenderSettings settings;
  settings.width = 48;
  settings.height = 36;
  return settings;
}

void expect_same(const Frame& a, const Frame& b) {
  ASSERT_EQ(a.rgb.size(), b.rgb.size());
  EXPECT_EQ(std::memcmp(a.rgb.data(), b.rgb.data(), a.rgb.size() * sizeof(float)), 0);
  EXPECT_EQ(a.primitive, b.primitive);
  EXPECT_EQ(a.rays.total(), b.rays.total());
}

TEST(ReferenceRender, DoesNotDependOnThreadsOrOnTheFinder) {
  const Scene scene = showcase();
  RenderSettings settings = small_picture();
  settings.threads = 1;
  const Frame alone = render_reference(scene, camera, settings);
  settings.threads = 4;
  expect_same(alone, render_reference(scene, camera, settings));
  expect_same(alone, reference::render(scene, ScalarBvh(scene), camera, settings));
  settings.samples_per_pixel = 3;
  expect_same(render_reference(scene, camera, settings),
              reference::render(scene, ScalarBvh(scene), camera, settings));
}

TEST(ReferenceRender, CountsRays) {
  const Scene scene = showcase();
  const RenderSettings settings = small_picture();
  const Frame frame = render_reference(scene, camera, settings);
  EXPECT_EQ(frame.rays.primary, 48U * 36U);
  EXPECT_GT(frame.rays.shadow, frame.rays.primary);
  EXPECT_GT(frame.rays.reflected, 0U);
  EXPECT_GT(frame.rays.refracted, 0U);
  RenderSettings local = settings;
  local.max_depth = 0;
  const Frame without = render_reference(scene, camera, local);
  EXPECT_EQ(without.rays.reflected + without.rays.refracted, 0U);
  EXPECT_EQ(without.primitive, frame.primitive);
}

TEST(ReferenceRender, SeedAndFilterMoveTheSamples) {
  const Scene scene = showcase();
  RenderSettings settings = small_picture();
  settings.samples_per_pixel = 4;
  const Frame first = render_reference(scene, camera, settings);
  settings.seed = 1;
  EXPECT_NE(first.rgb, render_reference(scene, camera, settings).rgb);
  settings.seed = 0;
  settings.filter = PixelFilter::box;
  EXPECT_NE(first.rgb, render_reference(scene, camera, settings).rgb);
}

TEST(ReferenceRender, ReportsProgressUpToOne) {
  const Scene scene = showcase();
  RenderSettings settings = small_picture();
  settings.threads = 4;
  double last = 0;
  int calls = 0;
  settings.progress = [&](double share) {
    EXPECT_GT(share, last);
    last = share;
    ++calls;
  };
  EXPECT_TRUE(render_reference(scene, camera, settings).complete);
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(calls, 36);
}

TEST(ReferenceRender, StopsWhenCancelled) {
  const Scene scene = showcase();
  RenderSettings settings = small_picture();
  settings.threads = 1;
  std::atomic<bool> cancelled = false;
  settings.cancelled = &cancelled;
  settings.progress = [&](double share) { cancelled = share > 0.49; };
  const Frame frame = render_reference(scene, camera, settings);
  EXPECT_FALSE(frame.complete);
  EXPECT_EQ(frame.rays.primary, 48U * 18U);
  for (std::size_t i = frame.rgb.size() / 2; i < frame.rgb.size(); ++i) EXPECT_EQ(frame.rgb[i], 0.0F);
}

TEST(ReferenceRender, PassesOnWhatProgressThrows) {
  const Scene scene = showcase();
  RenderSettings settings = small_picture();
  settings.progress = [](double) { throw std::runtime_error("enough"); };
  EXPECT_THROW(render_reference(scene, camera, settings), std::runtime_error);
}

TEST(ReferenceRender, RefusesSettingsOutOfRange) {
  const Scene scene = showcase();
  for (const auto& spoil : {+[](RenderSettings& settings) { settings.width = 0; },
                            +[](RenderSettings& settings) { settings.height = 65537; },
                            +[](RenderSettings& settings) { settings.samples_per_pixel = 0; }}) {
    RenderSettings settings = small_picture();
    spoil(settings);
    EXPECT_THROW(render_reference(scene, camera, settings), UsageError);
  }
}

TEST(ReferenceRender, AnEmptySceneIsBackground) {
  SceneBuilder builder;
  builder.set_background({0.25F, 0.5F, 1});
  const Frame frame = render_reference(builder.build(), camera, small_picture());
  for (std::size_t i = 0; i < frame.primitive.size(); ++i) {
    EXPECT_EQ(frame.primitive[i], no_primitive);
    EXPECT_EQ(Vec3(frame.rgb[3 * i], frame.rgb[3 * i + 1], frame.rgb[3 * i + 2]), Vec3(0.25F, 0.5F, 1));
  }
}

TEST(ReferenceRender, AsManyBouncesAsAreAskedFor) {
  SceneBuilder builder;
  Material mirror;
  mirror.ambient = mirror.diffuse = Vec3(0.0F);
  mirror.mirror = Vec3(1.0F);
  builder.add_sphere({0, 0, 0}, 1, builder.add_material(mirror));
  RenderSettings settings = small_picture();
  settings.width = settings.height = 1;
  settings.max_depth = 64;
  const Frame frame =
      render_reference(builder.build(), {{0, 0, 0.5F}, {1, 0.3F, 0}, {0, 1, 0}, 40}, settings);
  EXPECT_EQ(frame.rays.reflected, 64U);
}

} // namespace
} // namespace fastrt::test
