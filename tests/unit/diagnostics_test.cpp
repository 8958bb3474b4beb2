// SPDX-License-Identifier: Apache-2.0
#include <fastrt/diagnostics.hpp>

#include <gtest/gtest.h>

#include <string>

namespace fastrt {
namespace {

TEST(Diagnostics, IsEmptyAtFirst) {
  const Diagnostics diagnostics;
  EXPECT_EQ(diagnostics.count(), 0U);
  EXPECT_TRUE(diagnostics.lines().empty());
}

TEST(Diagnostics, KeepsTenOfAKindAndCountsTheRest) {
  Diagnostics diagnostics;
  for (int i = 0; i < 10; ++i) diagnostics.warn("a", "a" + std::to_string(i));
  EXPECT_EQ(diagnostics.lines().size(), 10U);
  for (int i = 10; i < 25; ++i) diagnostics.warn("a", "a" + std::to_string(i));
  diagnostics.warn("b", "b0");
  EXPECT_EQ(diagnostics.count(), 26U);
  const auto lines = diagnostics.lines();
  ASSERT_EQ(lines.size(), 12U);
  EXPECT_EQ(lines[0], "a0");
  EXPECT_EQ(lines[9], "a9");
  EXPECT_EQ(lines[10], "b0");
  EXPECT_EQ(lines[11], "15 more: a");
}

TEST(Diagnostics, KeepsTheOrderOfDifferentKinds) {
  Diagnostics diagnostics;
  diagnostics.warn("b", "first");
  diagnostics.warn("a", "second");
  diagnostics.warn("b", "third");
  EXPECT_EQ(diagnostics.lines(), (std::vector<std::string>{"first", "second", "third"}));
}

} // namespace
} // namespace fastrt
