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

TEST_P(RandomFrames, AreTheReferences) { expect_shots_to_match(any_shot, 100 * GetParam()); }

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFrames, testing::Range(0U, 8U));

} // namespace
} // namespace fastrt::test
