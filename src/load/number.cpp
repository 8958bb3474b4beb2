// SPDX-License-Identifier: Apache-2.0
#include "src/load/number.hpp"

#include "src/load/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace fastrt {

namespace {

bool names_non_finite(std::string_view word) {
  const std::string lower = lower_case(word);
  return lower == "nan" || lower == "inf" || lower == "infinity" || lower.starts_with("nan(");
}

// Whether a number out of range is too large, not too small: the decimal place of its first digit that is not
// 0.
bool is_large(std::string_view word) {
  const std::size_t mark = word.find_first_of("eE");
  const std::string_view mantissa = word.substr(0, mark);
  std::int64_t exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view tail = word.substr(mark + 1);
    if (tail.starts_with('+')) tail.remove_prefix(1);
    const auto parsed = std::from_chars(tail.data(), tail.data() + tail.size(), exponent);
    if (parsed.ec != std::errc{}) return !tail.starts_with('-');
  }
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first = mantissa.find_first_not_of("0.");
  const auto place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  // Bounded first: an exponent of 19 digits must not overflow.
  constexpr std::int64_t far = std::int64_t{1} << 40U;
  return place + std::max(-far, std::min(exponent, far)) > 0;
}

bool has_nonzero_digit(std::string_view word) {
  return word.substr(0, word.find_first_of("eE")).find_first_of("123456789") != std::string_view::npos;
}

} // namespace

const char* take_exponent(const char* p, Decimal decimal, float& value) {
  ++p;
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  const DigitRun run = take_digits(p);
  if (run.count == 0 || run.count > 3) return nullptr;
  const auto written = static_cast<int>(run.value);
  const int exponent = decimal.exponent + (negative ? -written : written);
  if (exponent < -22 || exponent > 22) return nullptr; // beyond, powers of ten are not exact
  const auto exact = static_cast<double>(static_cast<std::int64_t>(decimal.mantissa));
  const double scaled = exponent < 0 ? exact / exact_powers_of_ten[static_cast<std::size_t>(-exponent)]
                                     : exact * exact_powers_of_ten[static_cast<std::size_t>(exponent)];
  const bool normal =
      scaled >= static_cast<double>(std::numeric_limits<float>::min()) || decimal.mantissa == 0;
  const bool finite = scaled < static_cast<double>(std::numeric_limits<float>::max());
  return normal && finite && round_to_float(scaled, decimal.negative, value) ? p + run.count : nullptr;
}

Number parse_number(std::string_view word) {
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  if (names_non_finite(word)) return {0, NumberFault::not_finite};
  // from_chars takes a sign, "nan" and "inf" as well: only digits and a point may begin a number here.
  if (word.empty() || !(is_digit(word.front()) || word.front() == '.')) return {0, NumberFault::not_a_number};
  const char* end = word.data() + word.size();
  float value = 0;
  auto parsed = std::from_chars(word.data(), end, value);
  if (parsed.ptr != end || parsed.ec == std::errc::invalid_argument) return {0, NumberFault::not_a_number};
  if (parsed.ec == std::errc::result_out_of_range) {
    if (is_large(word)) return {0, NumberFault::out_of_range};
    value = 0;
  }
  const bool underflow = !std::isnormal(value) && has_nonzero_digit(word);
  return {negative ? -value : value, NumberFault::none, underflow};
}

const char* describe(NumberFault fault) {
  switch (fault) {
  case NumberFault::not_finite:
    return "non-finite number";
  case NumberFault::out_of_range:
    return "number out of range";
  default:
    return "not a number:";
  }
}

} // namespace fastrt
