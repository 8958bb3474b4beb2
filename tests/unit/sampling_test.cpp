// SPDX-License-Identifier: Apache-2.0
#include "src/film/sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace fastrt {
namespace {

SampleOffset sample(std::uint32_t index, std::uint32_t count, bool tent, std::uint32_t seed = 0,
                    std::uint32_t x = 3, std::uint32_t y = 5) {
  return sample_offset(x, y, index, count, seed, tent);
}

TEST(Hash, IsOneToOneOnWhatItIsAsked) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < 100000; ++i) seen.insert(hash32(i));
  EXPECT_EQ(seen.size(), 100000U);
}

TEST(ReverseBits, TurnsTheWordAround) {
  EXPECT_EQ(reverse_bits(1), 0x80000000U);
  EXPECT_EQ(reverse_bits(0x80000000U), 1U);
  EXPECT_EQ(reverse_bits(0x00F0A001U), 0x80050F00U);
  for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(reverse_bits(reverse_bits(hash32(i))), hash32(i));
}

TEST(TentWarp, IsTheTentsInverse) {
  EXPECT_EQ(tent_warp(0.0F), -1.0F);
  EXPECT_EQ(tent_warp(0.5F), 0.0F);
  for (int i = 0; i < 1000; ++i) {
    const float u = static_cast<float>(i) / 1000;
    const float x = tent_warp(u);
    // The share of the tent's area left of x.
    const float area = x < 0 ? 0.5F * (1 + x) * (1 + x) : 1 - 0.5F * (1 - x) * (1 - x);
    EXPECT_NEAR(area, u, 1e-6F);
  }
}

TEST(BoxSamples, StayInTheirPixel) {
  for (const std::uint32_t count : {2U, 3U, 16U, 64U})
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t x = 0; x < 50; ++x) {
        const SampleOffset offset = sample(i, count, false, 1, x, 7 * x);
        EXPECT_GE(offset.x, -0.5F);
        EXPECT_LT(offset.x, 0.5F);
        EXPECT_GE(offset.y, -0.5F);
        EXPECT_LT(offset.y, 0.5F);
      }
}

TEST(TentSamples, StayWithinOnePixelOfTheCentre) {
  for (std::uint32_t i = 0; i < 16; ++i)
    for (std::uint32_t x = 0; x < 50; ++x) {
      const SampleOffset offset = sample(i, 16, true, 9, x, 3 * x);
      EXPECT_LE(std::fabs(offset.x), 1.0F);
      EXPECT_LE(std::fabs(offset.y), 1.0F);
    }
}

// Every row and every column of a 16-fold grid holds one sample, up to the wrap-around of the shift.
TEST(BoxSamples, AreSpreadOverRowsAndColumns) {
  constexpr std::uint32_t count = 16;
  std::vector<float> xs;
  std::vector<float> ys;
  for (std::uint32_t i = 0; i < count; ++i) {
    xs.push_back(sample(i, count, false).x);
    ys.push_back(sample(i, count, false).y);
  }
  for (std::vector<float>* values : {&xs, &ys}) {
    std::sort(values->begin(), values->end());
    for (std::size_t i = 1; i < count; ++i) EXPECT_NEAR((*values)[i] - (*values)[i - 1], 1.0F / count, 1e-6F);
  }
}

TEST(Samples, AverageToTheirCentre) {
  for (const bool tent : {false, true}) {
    double x = 0;
    double y = 0;
    for (std::uint32_t pixel = 0; pixel < 400; ++pixel)
      for (std::uint32_t i = 0; i < 16; ++i) {
        const SampleOffset offset = sample(i, 16, tent, 0, pixel % 20, pixel / 20);
        x += static_cast<double>(offset.x) / 6400;
        y += static_cast<double>(offset.y) / 6400;
      }
    EXPECT_NEAR(x, 0, 0.01);
    EXPECT_NEAR(y, 0, 0.01);
  }
}

TEST(Samples, DependOnPixelSeedAndIndexAlone) {
  const SampleOffset first = sample(3, 16, false);
  EXPECT_EQ(first.x, sample(3, 16, false).x);
  EXPECT_NE(first.x, sample(4, 16, false).x);
  EXPECT_NE(first.x, sample(3, 16, false, 1).x);
  EXPECT_NE(first.x, sample(3, 16, false, 0, 4, 5).x);
  EXPECT_NE(first.y, sample(3, 16, false, 0, 5, 3).y);
}

} // namespace
} // namespace fastrt
