// SPDX-License-Identifier: Apache-2.0
// Cameras, lights and surfaces in media within media, at random, of every ISA against the naive reference.
#include "tests/equivalence/random_media.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

Shot drowned_shot(std::uint32_t seed) {
  Random random(seed);
  SceneBuilder builder;
  const std::uint32_t media = 1 + random.below(6);
  for (std::uint32_t i = 0; i < media; ++i) builder.add_material(any_medium(random));
  const std::uint32_t solid = builder.add_material(any_material(random));
  for (std::uint32_t i = 1 + random.below(3); i != 0; --i) add_tank(builder, random.below(media), random);
  for (std::uint32_t i = random.below(6); i != 0; --i)
    builder.add_sphere(0.7F * random.in_cube(), random.uniform(0.2F, 3), random.below(media));
  if (random.below(3) == 0) add_any_plane(builder, random.below(media), random);
  add_plane(builder, solid, random);
  add_ball(builder, solid, random);
  for (std::uint32_t i = 1 + random.below(3); i != 0; --i) {
    Light light = any_light(random);
    light.position = random.uniform(0, 3) * random.direction();
    light.casts_shadows = true;
    if (random.below(4) == 0) light.kind = LightKind::disk;
    builder.add_light(light);
  }
  builder.set_background(any_colour(random, 1));
  Shot shot{"media " + std::to_string(seed), builder.build(), {}, {}};
  shot.camera = looking(random.uniform(0.1F, 4) * random.direction(), 0.3F * random.in_cube(), 70);
  shot.settings = small_settings(21, 17, random.below(4) == 0 ? 2 : 1);
  shot.settings.light_samples = 2;
  shot.settings.max_depth = 4;
  any_view(random, shot.camera, shot.settings);
  return shot;
}

class MediaFrames : public testing::TestWithParam<std::uint32_t> {};

TEST_P(MediaFrames, AreTheReferences) {
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(effort(12)); ++i) {
    const Shot shot = drowned_shot(100 * GetParam() + i);
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    expect_every_isa_makes(expected, shot, {1});
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MediaFrames, testing::Range(0U, 5U));

} // namespace
} // namespace fastrt::test
