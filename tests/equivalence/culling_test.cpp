// SPDX-License-Identifier: Apache-2.0
// Without bounding volumes every ray meets every primitive, and pictures stay the same; and what is counted.
#include "tests/equivalence/random_instances.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

Frame rendered(const Shot& shot, Isa isa, bool culling) {
  TracerSettings settings;
  settings.isa = isa;
  settings.threads = 1;
  settings.culling = culling;
  return render(Tracer(Scene(shot.scene), settings), shot.camera, shot.settings);
}

void expect_same_without(const Shot& shot) {
  for (const Isa isa : available_isas())
    expect_equal(rendered(shot, isa, false), rendered(shot, isa, true), shot.name + ", " + isa_word(isa));
}

TEST(Culling, OffMakesTheSamePictures) {
  for (std::uint32_t seed = 0; seed < static_cast<std::uint32_t>(effort(12)); ++seed) {
    expect_same_without(any_shot(7000 + seed));
    expect_same_without(instance_shot(7000 + seed));
  }
}

// A ball of many triangles on a floor, all lit.
Shot ball_on_a_floor() {
  SceneBuilder builder;
  Material material;
  material.mirror = Vec3(0.5F);
  const std::uint32_t shiny = builder.add_material(material);
  add(builder, icosphere(2), shiny);
  add(builder, grid(8, {-4, -1, -4}, {0, 0, 8}, {8, 0, 0}), shiny);
  Light light;
  light.kind = LightKind::point;
  light.position = {2, 5, 3};
  builder.add_light(light);
  Shot shot{"ball", builder.build(), looking({0, 3, 5}, {0, 0, 0}), small_settings(24, 24)};
  shot.settings.max_depth = 2;
  return shot;
}

// How many primitives a ray was held against.
double per_ray(const TestCounts& tests, std::uint64_t rays) {
  return static_cast<double>(tests.primitives) / static_cast<double>(rays);
}

TEST(Culling, IsCounted) {
  const Shot shot = ball_on_a_floor();
  const auto primitives = static_cast<double>(shot.scene.primitive_count());
  for (const Isa isa : available_isas()) {
    const Frame all = rendered(shot, isa, false), few = rendered(shot, isa, true);
    if (isa == Isa::scalar) {
      EXPECT_EQ(few.tests.primary.boxes + few.tests.primary.primitives, 0U);
      continue;
    }
    SCOPED_TRACE(isa_word(isa));
    const std::uint64_t secondary = few.rays.reflected + few.rays.refracted;
    ASSERT_GT(secondary, 0U);
    // Every one, and the rows that fill up blocks of four.
    EXPECT_GE(per_ray(all.tests.primary, all.rays.primary), primitives);
    EXPECT_LE(per_ray(all.tests.primary, all.rays.primary), 1.5 * primitives);
    EXPECT_GE(per_ray(all.tests.secondary, secondary), primitives);
    EXPECT_LE(per_ray(all.tests.secondary, secondary), 1.5 * primitives);
    // One that is occluded is done before it met all.
    EXPECT_GE(per_ray(all.tests.shadow, all.rays.shadow), 0.7 * primitives);
    EXPECT_LE(per_ray(all.tests.shadow, all.rays.shadow), 1.3 * primitives);
    for (const Frame* frame : {&all, &few}) EXPECT_GT(frame->tests.primary.boxes, 0U);
    EXPECT_LE(per_ray(few.tests.primary, few.rays.primary), 10.0);
    EXPECT_LE(per_ray(few.tests.secondary, secondary), 40.0);
    EXPECT_GE(per_ray(few.tests.primary, few.rays.primary), 0.5);
    EXPECT_LT(few.tests.primary.boxes, all.tests.primary.boxes);
  }
}

// Without bounding volumes each ray that is counted meets every primitive, those of the centres that the
// forward integrator looks at and those of photons too.
TEST(Culling, IsCountedForPhotons) {
  Shot shot = ball_on_a_floor();
  const auto primitives = static_cast<double>(shot.scene.primitive_count());
  for (const Integrator integrator : {Integrator::forward, Integrator::whitted})
    for (const Isa isa : simd_isas()) {
      SCOPED_TRACE(isa_word(isa) + (integrator == Integrator::forward ? ", forward" : ", caustics"));
      shot.settings.integrator = integrator;
      shot.settings.photons = 800;
      shot.settings.caustic_photons = integrator == Integrator::whitted ? 800 : 0;
      const Frame frame = rendered(shot, isa, false);
      const std::uint64_t secondary = frame.rays.reflected + frame.rays.refracted;
      ASSERT_GT(frame.rays.primary, 24U * 24U);
      ASSERT_GT(secondary, 0U);
      for (const double met :
           {per_ray(frame.tests.primary, frame.rays.primary), per_ray(frame.tests.secondary, secondary)}) {
        EXPECT_GE(met, primitives);
        EXPECT_LE(met, 1.5 * primitives);
      }
      EXPECT_GT(frame.tests.shadow.primitives, 0U);
    }
}

} // namespace
} // namespace fastrt::test
