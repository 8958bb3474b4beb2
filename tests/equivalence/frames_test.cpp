// SPDX-License-Identifier: Apache-2.0
// Whole pictures of every ISA, with 1, 2 and 8 threads, against the naive reference: every bit of every
// channel, every id, every count of rays.
#include "tests/equivalence/designed_shots.hpp"
#include "tests/equivalence/random_shots.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

class DesignedFrames : public testing::TestWithParam<Shot> {};

TEST_P(DesignedFrames, AreTheReferences) {
  const Shot& shot = GetParam();
  const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
  if (shot.name != "nothing" && shot.name != "low") {
    EXPECT_GT(pixels_with_hits(expected) * 4, expected.primitive.size());
  }
  expect_every_isa_makes(expected, shot, {1, 2, 8});
}

struct ShotName {
  std::string operator()(const testing::TestParamInfo<Shot>& info) const { return info.param.name; }
};
INSTANTIATE_TEST_SUITE_P(Shots, DesignedFrames, testing::ValuesIn(designed_shots()), ShotName());

class RandomFrames : public testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomFrames, AreTheReferences) {
  std::size_t seen = 0;
  RayCounts rays;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(effort(20)); ++i) {
    const Shot shot = any_shot(100 * GetParam() + i);
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    seen += pixels_with_hits(expected);
    rays.shadow += expected.rays.shadow;
    rays.reflected += expected.rays.reflected;
    rays.refracted += expected.rays.refracted;
    expect_every_isa_makes(expected, shot, {1});
  }
  if (slow_build) return;
  EXPECT_GT(seen, 500U);
  EXPECT_GT(rays.shadow, 100U);
  EXPECT_GT(rays.reflected, 100U);
  EXPECT_GT(rays.refracted, 100U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFrames, testing::Range(0U, 8U));

} // namespace
} // namespace fastrt::test
