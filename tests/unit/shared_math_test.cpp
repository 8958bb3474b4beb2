// SPDX-License-Identifier: Apache-2.0
// The functions that both paths share, against the C library's in double.
#include "src/simd/shared_turn.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

using baseline::ScalarOps;

float pow_of(float x, float y) { return baseline::shared_pow<ScalarOps>(x, y); }
float exp_of(float x) { return baseline::shared_exp<ScalarOps>(x); }

// The error that shared_math.hpp states, relative to `truth`.
double allowed(double truth) { return 3e-6 * std::max(1.0, std::fabs(std::log2(truth))) * truth; }

TEST(SharedPow, IsAsAccurateAsItSays) {
  Random random(1);
  int compared = 0;
  for (int i = 0; i < 500000; ++i) {
    const float x = random.uniform() + 0x1p-24F;
    const float y = std::exp(random.uniform(0, 7));
    const double truth = std::pow(static_cast<double>(x), static_cast<double>(y));
    if (truth < 1e-37) continue;
    ++compared;
    ASSERT_NEAR(pow_of(x, y), truth, allowed(truth)) << x << "^" << y;
  }
  EXPECT_GT(compared, 200000);
}

TEST(SharedPow, OfOneIsOneWithinThatError) {
  for (const float y : {1.0F, 2.0F, 10.0F, 1000.0F}) EXPECT_NEAR(pow_of(1.0F, y), 1.0F, 3e-6F) << y;
}

TEST(SharedPow, OfSmallNumbersVanishes) {
  EXPECT_EQ(pow_of(0.5F, 200), 0.0F);
  EXPECT_EQ(pow_of(1e-30F, 10), 0.0F);
}

TEST(SharedExp, IsAsAccurateAsItSays) {
  Random random(2);
  for (int i = 0; i < 500000; ++i) {
    const float x = random.uniform(-87, 87);
    const double truth = std::exp(static_cast<double>(x));
    ASSERT_NEAR(exp_of(x), truth, allowed(truth)) << x;
  }
}

TEST(SharedExp, NeverGrowsWithDistance) {
  float last = exp_of(0.0F);
  EXPECT_NEAR(last, 1.0F, 3e-6F);
  for (int i = 1; i < 20000; ++i) {
    const float next = exp_of(-0.005F * static_cast<float>(i));
    EXPECT_LE(next, last * (1 + 3e-6F)) << i;
    last = next;
  }
  EXPECT_EQ(last, 0.0F);
}

TEST(SharedExp, EndsWellAtBothEnds) {
  EXPECT_EQ(exp_of(-infinity), 0.0F);
  EXPECT_EQ(exp_of(-1e30F), 0.0F);
  EXPECT_GT(exp_of(1e30F), 1e38F);
  EXPECT_LT(exp_of(1e30F), infinity);
}

TEST(SharedTurn, IsAsAccurateAsItSays) {
  Random random(3);
  const auto turn_of = [](float y, float x) { return baseline::shared_turn<ScalarOps>(y, x); };
  for (int i = 0; i < 500000; ++i) {
    const float x = random.uniform(-1, 1) * std::exp(random.uniform(-9, 9));
    const float y = random.uniform(-1, 1);
    ASSERT_NEAR(turn_of(y, x), std::atan2(static_cast<double>(y), static_cast<double>(x)) / 6.283185307179586,
                2e-7)
        << y << ", " << x;
  }
  EXPECT_EQ(turn_of(0, 0), 0.0F);
  EXPECT_EQ(turn_of(0, 3), 0.0F);
  EXPECT_EQ(turn_of(2, 0), 0.25F);
  EXPECT_EQ(turn_of(0, -1), 0.5F);
  EXPECT_EQ(turn_of(-2, 0), -0.25F);
}

} // namespace
} // namespace fastrt::test
