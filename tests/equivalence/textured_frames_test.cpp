// SPDX-License-Identifier: Apache-2.0
// Pictures of surfaces with textures, at random, of every ISA against the naive reference: every bit.
#include "tests/equivalence/random_textures.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

Shot textured_shot(std::uint32_t seed) {
  Random random(seed);
  SceneBuilder builder;
  const std::uint32_t textures = 1 + random.below(5), materials = 1 + random.below(4);
  for (std::uint32_t i = 0; i < textures; ++i) builder.add_texture(any_texture(random, i == 0));
  for (std::uint32_t i = 0; i < materials; ++i) builder.add_material(any_textured_material(random, textures));
  const std::uint32_t plain = builder.add_material(any_material(random));
  add_textured(builder, placed(icosphere(1), random.uniform(0.5F, 1.2F), random.in_cube()),
               random.below(materials), random);
  for (int i = 0; i < 2; ++i)
    add_textured(builder,
                 grid(2, {-3, static_cast<float>(i) - 1.5F, -3}, {6, random.uniform(-1, 1), 0}, {0, 0, 6}),
                 random.below(materials), random);
  builder.add_sphere(random.in_cube(), 0.6F, random.below(materials));
  builder.add_sphere(random.in_cube(), 0.4F, plain);
  for (std::uint32_t i = 1 + random.below(2); i != 0; --i) builder.add_light(any_light(random));
  builder.set_ambient(any_colour(random, 0.5F));
  builder.set_background(any_colour(random, 1));
  Shot shot{"textures " + std::to_string(seed), builder.build(), {}, {}};
  shot.camera =
      looking(random.uniform(2, 6) * random.direction(), 0.5F * random.in_cube(), random.uniform(20, 90));
  shot.settings = small_settings(33, 26, random.below(5) == 0 ? 3 : 1);
  shot.settings.max_depth = static_cast<int>(random.below(5));
  shot.settings.min_contribution = 0;
  if (seed % 4 == 1) shot.scene = with_gaps(shot.scene, random);
  return shot;
}

class TexturedFrames : public testing::TestWithParam<std::uint32_t> {};

TEST_P(TexturedFrames, AreTheReferences) {
  std::size_t seen = 0;
  RayCounts rays;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(effort(20)); ++i) {
    const Shot shot = textured_shot(100 * GetParam() + i);
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    seen += pixels_with_hits(expected);
    rays.refracted += expected.rays.refracted;
    rays.shadow += expected.rays.shadow;
    expect_every_isa_makes(expected, shot, {1});
  }
  if (slow_build) return;
  EXPECT_GT(seen, 500U);
  EXPECT_GT(rays.shadow, 100U);
  EXPECT_GT(rays.refracted, 100U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TexturedFrames, testing::Range(0U, 6U));

} // namespace
} // namespace fastrt::test
