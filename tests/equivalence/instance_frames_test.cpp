// SPDX-License-Identifier: Apache-2.0
// Pictures of instances at random, of every ISA against the naive reference: every bit.
#include "tests/equivalence/random_instances.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

class InstanceFrames : public testing::TestWithParam<std::uint32_t> {};

TEST_P(InstanceFrames, AreTheReferences) { expect_shots_to_match(instance_shot, 100 * GetParam()); }

INSTANTIATE_TEST_SUITE_P(Seeds, InstanceFrames, testing::Range(0U, 5U));

} // namespace
} // namespace fastrt::test
