// SPDX-License-Identifier: Apache-2.0
// Pictures lit by spots, fading lights, lights with a size and meshes, at random, of every ISA against the
// naive reference: every bit, every AOV, every count.
#include "tests/equivalence/random_shots.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

Light any_kind_of_light(Random& random) {
  Light light = any_light(random);
  light.kind = static_cast<LightKind>(random.below(7));
  light.casts_shadows = random.below(6) != 0;
  if (random.below(2) == 0) light.constant = random.uniform(), light.quadratic = random.uniform(0.01F, 0.3F);
  if (random.below(2) == 0) light.linear = random.uniform();
  if (random.below(4) == 0) light.ambient = any_colour(random, 0.2F);
  light.direction = random.uniform(0.1F, 3) * (random.in_cube() * 0.5F - light.position);
  light.cone_degrees = random.below(5) == 0 ? 180.0F : random.uniform(5, 90);
  light.penumbra_degrees = random.below(3) == 0 ? 0.0F : random.uniform() * light.cone_degrees;
  if (random.below(2) == 0) light.exponent = random.uniform(0, 40);
  light.half_u = random.uniform(0, 2) * random.direction();
  light.half_v = random.uniform(0, 2) * random.direction();
  light.radius = random.uniform(0.1F, 2);
  return light;
}

Shot lit_shot(std::uint32_t seed) {
  Random random(seed);
  SceneBuilder builder;
  const std::uint32_t materials = 1 + random.below(4);
  for (std::uint32_t i = 0; i < materials; ++i) {
    Material material = any_material(random);
    if (seed % 2 == 0) material.opacity = 1; // shadows without colours
    builder.add_material(material);
  }
  Material shining = any_material(random);
  shining.emission = {random.uniform(0.1F, 3), random.uniform(), 0};
  const std::uint32_t lamp = builder.add_material(shining);
  add_ball(builder, lamp, random);
  if (random.below(2) == 0) add_plane(builder, lamp, random);
  add_ball(builder, random.below(materials), random);
  add_plane(builder, random.below(materials), random);
  add_plane(builder, random.below(materials), random);
  for (std::uint32_t i = random.below(4); i != 0; --i)
    builder.add_sphere(1.5F * random.in_cube(), random.uniform(0.2F, 1), random.below(materials));
  for (std::uint32_t i = 1 + random.below(4); i != 0; --i) {
    Light light = any_kind_of_light(random);
    light.material = lamp;
    builder.add_light(light);
  }
  builder.set_ambient(any_colour(random, 0.3F));
  Shot shot{"lights " + std::to_string(seed), builder.build(), {}, {}};
  shot.camera =
      looking(random.uniform(2, 6) * random.direction(), 0.5F * random.in_cube(), random.uniform(30, 90));
  shot.settings = small_settings(33, 21, random.below(3) == 0 ? 2 : 1);
  if (shot.settings.samples_per_pixel > 1 && random.below(2) == 0) {
    shot.settings.adaptive = 0.02F;
    shot.settings.most_samples = 8;
  }
  shot.settings.max_depth = static_cast<int>(random.below(4));
  shot.settings.min_contribution = 0.01F;
  shot.settings.seed = random.word();
  constexpr int counts[] = {1, 2, 5, 9};
  shot.settings.light_samples = counts[random.below(4)];
  if (random.below(2) == 0) shot.settings.aovs = {Aov::shadow, Aov::cost};
  return shot;
}

class LightFrames : public testing::TestWithParam<std::uint32_t> {};

TEST_P(LightFrames, AreTheReferences) {
  RayCounts rays;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(effort(20)); ++i) {
    const Shot shot = lit_shot(100 * GetParam() + i);
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    rays.shadow += expected.rays.shadow;
    expect_every_isa_makes(expected, shot, {1});
  }
  EXPECT_GT(rays.shadow, slow_build ? 0U : 10000U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LightFrames, testing::Range(0U, 5U));

} // namespace
} // namespace fastrt::test
