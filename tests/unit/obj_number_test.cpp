// SPDX-License-Identifier: Apache-2.0
#include "src/load/number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

namespace fastrt {
namespace {

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

// Both ways to read `text` against std::from_chars. Returns whether the fast one took it.
bool check(const std::string& text) {
  float expected = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, expected);
  EXPECT_EQ(parsed.ptr, end) << text;
  const std::string padded = text + " 000000000000000000000000";
  const char* p = padded.data();
  float fast = 0;
  const bool taken = take_float(p, fast);
  if (taken) {
    EXPECT_EQ(bits(fast), bits(expected)) << text;
    EXPECT_EQ(p, padded.data() + text.size()) << text;
    EXPECT_EQ(parsed.ec, std::errc{}) << text;
  } else {
    EXPECT_EQ(p, padded.data());
  }
  const Number careful = parse_number(text);
  if (parsed.ec == std::errc{}) {
    EXPECT_EQ(bits(careful.value), bits(expected)) << text;
    EXPECT_EQ(careful.fault, NumberFault::none) << text;
  }
  return taken;
}

TEST(ObjNumber, FixedNotationEqualsFromChars) {
  std::mt19937_64 random(1);
  int taken = 0;
  constexpr int count = 1'000'000;
  for (int i = 0; i < count; ++i) {
    const auto whole_digits = random() % 7, fraction_digits = random() % 12;
    std::string text = random() % 2 == 0 ? "-" : "";
    for (std::uint64_t k = 0; k <= whole_digits; ++k) text += static_cast<char>('0' + random() % 10);
    if (random() % 8 != 0) text += '.';
    if (text.find('.') != std::string::npos)
      for (std::uint64_t k = 0; k < fraction_digits; ++k) text += static_cast<char>('0' + random() % 10);
    taken += check(text) ? 1 : 0;
  }
  EXPECT_GT(taken, count * 9 / 10);
}

TEST(ObjNumber, ExponentsEqualFromChars) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 500'000; ++i) {
    char text[64];
    const double mantissa = static_cast<double>(random() % 100'000'000) / 1e7;
    const int exponent = static_cast<int>(random() % 60) - 30;
    std::snprintf(text, sizeof text, "%.*fe%+03d", static_cast<int>(random() % 9), mantissa, exponent);
    check(text);
  }
}

// Decimal texts next to the middle between two floats, where rounding twice goes wrong.
TEST(ObjNumber, HalfwayCasesEqualFromChars) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 300'000; ++i) {
    const auto low = static_cast<std::uint32_t>(random() % 0x7F000000U);
    const double middle = 0.5 * (static_cast<double>(std::bit_cast<float>(low)) +
                                 static_cast<double>(std::bit_cast<float>(low + 1)));
    char text[512];
    for (const int digits : {9, 15, 16, 17, 18, 19, 25}) {
      std::snprintf(text, sizeof text, "%.*e", digits - 1, middle);
      check(text);
    }
    if (middle > 1e-4 && middle < 1e9) {
      std::snprintf(text, sizeof text, "%.30f", middle);
      check(text);
    }
  }
}

TEST(ObjNumber, WholeNumbersAroundTheFloatsPrecision) {
  for (std::uint64_t i = (1U << 24U) - 50; i < (1U << 24U) + 2000; ++i) check(std::to_string(i));
  for (std::uint64_t i = 0; i < 2000; ++i) check(std::to_string((std::uint64_t{1} << 53U) - 1000 + i));
}

TEST(ObjNumber, TakesSignsAndBarePoints) {
  for (const auto& [text, value] : {std::pair{"+2.5", 2.5F},
                                    {".5", 0.5F},
                                    {"-.5", -0.5F},
                                    {"5.", 5.0F},
                                    {"+.25e1", 2.5F},
                                    {"1E2", 100.0F},
                                    {"1e+2", 100.0F},
                                    {"007", 7.0F}}) {
    const Number number = parse_number(text);
    EXPECT_EQ(number.fault, NumberFault::none) << text;
    EXPECT_EQ(number.value, value) << text;
    const std::string padded = std::string(text) + "\n               ";
    const char* p = padded.data();
    float fast = 0;
    ASSERT_EQ(take_float(p, fast), text[0] != '+') << text;
    if (text[0] == '+') continue;
    EXPECT_EQ(fast, value);
    EXPECT_EQ(*p, '\n');
  }
  EXPECT_TRUE(std::signbit(parse_number("-0").value));
}

TEST(ObjNumber, RefusesWhatIsNoNumber) {
  for (const char* text : {"",     "a",     "-",   "+",   ".",  "e5",     "1e",     "1e+", "1,5", "0x1p3",
                           "0x10", "1.2.3", "--1", "+-1", "1f", "1.#INF", "3.1+e2", "1 ",  "1_0", "infx"})
    EXPECT_EQ(parse_number(text).fault, NumberFault::not_a_number) << text;
  for (const char* text : {"nan", "NaN", "-nan", "inf", "-inf", "+inf", "Infinity", "nan(1)"})
    EXPECT_EQ(parse_number(text).fault, NumberFault::not_finite) << text;
  for (const char* text :
       {"1e999", "-1e39", "3.5e38", "1e99999999999999999999", "1000000000000000000000000000000000000000"})
    EXPECT_EQ(parse_number(text).fault, NumberFault::out_of_range) << text;
}

TEST(ObjNumber, AcceptsUnderflow) {
  for (const char* text :
       {"1e-50", "-1e-999", "1e-40", "0.00000000000000000000000000000000000000000000000001",
        "1e-99999999999999999999"}) {
    const Number number = parse_number(text);
    EXPECT_EQ(number.fault, NumberFault::none) << text;
    EXPECT_TRUE(number.underflow) << text;
    EXPECT_LT(std::abs(number.value), std::numeric_limits<float>::min()) << text;
    const std::string padded = std::string(text) + "                ";
    const char* p = padded.data();
    float fast = 0;
    EXPECT_FALSE(take_float(p, fast)) << text;
  }
  for (const char* text : {"0", "-0.000", "0e99", "0e-99", "1e-37"})
    EXPECT_FALSE(parse_number(text).underflow) << text;
}

TEST(ObjNumber, TakesIndices) {
  for (const std::uint64_t value : {0ULL, 7ULL, 12ULL, 1234567ULL, 12345678ULL, 123456789ULL, 999999999ULL}) {
    const std::string text = std::to_string(value) + "/1               ";
    const char* p = text.data();
    std::uint32_t index = 0;
    ASSERT_TRUE(take_index(p, index));
    EXPECT_EQ(index, value);
    EXPECT_EQ(*p, '/');
  }
  for (const char* text : {"/1                ", "1000000000          ", "99999999999         "}) {
    const char* p = text;
    std::uint32_t index = 0;
    EXPECT_FALSE(take_index(p, index)) << text;
  }
}

// All bytes around the digits, so that the eight-at-a-time test of digits is seen to be right.
TEST(ObjNumber, StopsAtEveryOtherByte) {
  for (int byte = 0; byte < 256; ++byte) {
    if (byte >= '0' && byte <= '9') continue;
    for (std::size_t count = 0; count < 8; ++count) {
      std::string text = std::string(count, '7') + static_cast<char>(byte) + "1111111111";
      const DigitRun run = take_digits(text.data());
      EXPECT_EQ(run.count, static_cast<int>(count));
      EXPECT_EQ(run.value, count == 0 ? 0U : static_cast<unsigned>(std::stoul(std::string(count, '7'))));
    }
  }
}

} // namespace
} // namespace fastrt
