// SPDX-License-Identifier: Apache-2.0
// The table against the curve itself, in long double.
#include "src/film/srgb.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace fastrt {
namespace {

int oracle(float linear) {
  if (!(linear > 0.0F)) return 0;
  if (linear >= 1.0F) return 255;
  const long double x = linear;
  const long double y = x <= 0.0031308L ? 12.92L * x : 1.055L * powl(x, 1.0L / 2.4L) - 0.055L;
  return static_cast<int>(floorl(255.0L * y + 0.5L));
}

int code(float linear) {
  unsigned char byte = 0;
  to_srgb8(&linear, 1, &byte);
  return byte;
}

// A half float's value; the numbers of this format that are infinite or none become floats of the same kind.
float half(std::uint32_t bits) {
  const std::uint32_t sign = (bits & 0x8000U) << 16U, exponent = (bits >> 10U) & 31U, mantissa = bits & 1023U;
  if (exponent == 31) return std::bit_cast<float>(sign | 0x7F800000U | mantissa << 13U);
  const float size = exponent == 0
                         ? std::ldexp(static_cast<float>(mantissa), -24)
                         : std::ldexp(static_cast<float>(mantissa + 1024), static_cast<int>(exponent) - 25);
  return sign != 0 ? -size : size;
}

TEST(Srgb, EveryHalfFloat) {
  for (std::uint32_t bits = 0; bits < 65536; ++bits) EXPECT_EQ(code(half(bits)), oracle(half(bits))) << bits;
}

TEST(Srgb, AroundEveryStep) {
  for (int step = 1; step <= 255; ++step) {
    const double y = (step - 0.5) / 255;
    const double x = y <= 0.04045 ? y / 12.92 : std::pow((y + 0.055) / 1.055, 2.4);
    const std::uint32_t middle = std::bit_cast<std::uint32_t>(static_cast<float>(x));
    int seen = 0;
    for (std::uint32_t bits = middle - 200; bits <= middle + 200; ++bits) {
      const float linear = std::bit_cast<float>(bits);
      ASSERT_EQ(code(linear), oracle(linear)) << step << ' ' << linear;
      if (code(linear) == step) ++seen;
    }
    EXPECT_GT(seen, 0) << step;
    EXPECT_LT(seen, 401) << step;
  }
}

TEST(Srgb, RandomFloats) {
  std::mt19937 random(7);
  std::vector<float> linear(300000);
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = i % 3 == 0 ? std::bit_cast<float>(static_cast<std::uint32_t>(random()))
                           : static_cast<float>(random() >> 8U) * 0x1p-24F;
  std::vector<unsigned char> codes(linear.size());
  to_srgb8(linear.data(), linear.size(), codes.data());
  for (std::size_t i = 0; i < linear.size(); ++i) ASSERT_EQ(codes[i], oracle(linear[i])) << linear[i];
}

TEST(Srgb, RunsOfOneColour) {
  std::mt19937 random(11);
  for (const std::size_t other : {0U, 1U, 2U, 3U, 200U, 254U, 255U, 300U, 1022U}) {
    std::vector<float> linear(1024, 0.0F);
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = 0.1F + 0.3F * static_cast<float>(i % 3);
    linear[other] = static_cast<float>(random() >> 8U) * 0x1p-24F;
    std::vector<unsigned char> codes(linear.size());
    to_srgb8(linear.data(), linear.size(), codes.data());
    for (std::size_t i = 0; i < linear.size(); ++i)
      ASSERT_EQ(codes[i], oracle(linear[i])) << other << ' ' << i;
  }
}

TEST(Srgb, WhatLiesOutside) {
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(code(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(code(-inf), 0);
  EXPECT_EQ(code(-1.0F), 0);
  EXPECT_EQ(code(-0.0F), 0);
  EXPECT_EQ(code(std::numeric_limits<float>::denorm_min()), 0);
  EXPECT_EQ(code(1.0F), 255);
  EXPECT_EQ(code(1e30F), 255);
  EXPECT_EQ(code(inf), 255);
  EXPECT_EQ(code(0.18F), 118);
}

} // namespace
} // namespace fastrt
