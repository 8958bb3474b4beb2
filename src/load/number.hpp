// SPDX-License-Identifier: Apache-2.0
// Decimal text to numbers: a fast way for what exporters write, and a careful one that says what is wrong.
// Both give the correctly rounded float. The fast functions read up to 8 bytes past what they take.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace fastrt {

static_assert(std::endian::native == std::endian::little, "eight digits are read as one integer");

inline std::uint64_t load_eight(const char* p) {
  std::uint64_t text = 0;
  std::memcpy(&text, p, sizeof text);
  return text;
}

// The value of eight digits, each a number in a byte, the first one lowest.
[[gnu::always_inline]] inline std::uint32_t value_of_digits(std::uint64_t x) {
  x = x * 10 + (x >> 8U);
  constexpr std::uint64_t pairs = 0x000000FF000000FFU;
  x = ((x & pairs) * 0x000F424000000064U + ((x >> 16U) & pairs) * 0x0000271000000001U) >> 32U;
  return static_cast<std::uint32_t>(x);
}

// The digits at the start of eight characters: how many, and their value.
struct DigitRun {
  int count;
  std::uint32_t value;
};

[[gnu::always_inline]] inline DigitRun take_digits(const char* p) {
  const std::uint64_t text = load_eight(p);
  const std::uint64_t digits = text - 0x3030303030303030U;
  // The high bit of a byte ends up set if it is below '0' or above '9'; a borrow only spoils later bytes.
  const std::uint64_t others = ((text + 0x4646464646464646U) | digits | text) & 0x8080808080808080U;
  const int count = std::countr_zero(others) / 8;
  const unsigned half_shift = 32U - 4U * static_cast<unsigned>(count); // in two steps: 64 at once is too far
  return {count, value_of_digits((digits << half_shift) << half_shift)};
}

// p + count, by branches: the processor guesses the usual counts and goes on without waiting for the digits.
[[gnu::always_inline]] inline const char* step_over(const char* p, int count) {
  switch (count) {
  case 4:
    return p + 4;
  case 5:
    return p + 5;
  case 6:
    return p + 6;
  case 7:
    return p + 7;
  default:
    return p + count;
  }
}

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

inline constexpr std::array<double, 23> exact_powers_of_ten = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
inline constexpr std::array<std::uint32_t, 9> small_powers_of_ten = {
    1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

// A number as digits times a power of ten.
struct Decimal {
  std::uint64_t mantissa;
  int exponent;
  bool negative;
};

// Goes on at the "e" behind a number. Returns where it ends; null if it needs parse_number.
const char* take_exponent(const char* p, Decimal decimal, float& value);

// A product of two exact numbers, rounded once, as a float. Rounding a second time to float is right too,
// unless the double lies half-way between two floats: then the digits that were rounded away decide, and this
// is false.
[[gnu::always_inline]] inline bool round_to_float(double scaled, bool negative, float& value) {
  constexpr std::uint64_t below_float = (std::uint64_t{1} << 29U) - 1;
  constexpr std::uint64_t half = std::uint64_t{1} << 28U;
  if ((std::bit_cast<std::uint64_t>(scaled) & below_float) == half) return false;
  const std::uint32_t sign = negative ? 0x80000000U : 0U; // by bits: signs are hard to predict
  value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(scaled)) | sign);
  return true;
}

// Takes a number at p. False, and p unchanged, if there is none or if it needs parse_number. What follows it
// is for the caller to check.
[[gnu::always_inline]] inline bool take_float(const char*& p, float& value) {
  const bool negative = *p == '-';
  const char* const first = p + (negative ? 1 : 0);
  const char* q = first;
  std::uint64_t mantissa = 0;
  for (; is_digit(*q); ++q) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*q - '0');
  auto digits = q - first;
  int decimals = 0;
  if (*q == '.') {
    ++q;
    const DigitRun run = take_digits(q);
    mantissa = mantissa * small_powers_of_ten[static_cast<std::size_t>(run.count)] + run.value;
    q = step_over(q, run.count);
    decimals = run.count;
    if (run.count == 8)
      for (; is_digit(*q); ++q, ++decimals) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*q - '0');
    digits += decimals;
  }
  // Up to 15 digits the mantissa and the power are exact in double, and the value fits a float.
  if (digits < 1 || digits > 15) return false;
  if ((*q | 0x20) == 'e') {
    q = take_exponent(q, {mantissa, -decimals, negative}, value);
    if (q == nullptr) return false;
  } else {
    const double scaled = static_cast<double>(static_cast<std::int64_t>(mantissa)) /
                          exact_powers_of_ten[static_cast<std::size_t>(decimals)];
    if (!round_to_float(scaled, negative, value)) return false;
  }
  p = q;
  return true;
}

// Takes the digits at p. False if there is none, or more than nine.
[[gnu::always_inline]] inline bool take_index(const char*& p, std::uint32_t& value) {
  const DigitRun run = take_digits(p);
  const char* q = step_over(p, run.count);
  std::uint32_t sum = run.value;
  if (run.count == 8) {
    if (is_digit(*q)) sum = sum * 10 + static_cast<std::uint32_t>(*q++ - '0');
    if (is_digit(*q)) return false;
  }
  p = q;
  value = sum;
  return run.count != 0;
}

enum class NumberFault { none, not_a_number, not_finite, out_of_range };

struct Number {
  float value = 0;
  NumberFault fault = NumberFault::none;
  bool underflow = false; // not 0 as written, but too small for a normal float
};

// The whole of a word as a number.
Number parse_number(std::string_view word);

// What to say about a number that can't be taken.
const char* describe(NumberFault fault);

} // namespace fastrt
