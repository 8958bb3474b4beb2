// SPDX-License-Identifier: Apache-2.0
#include "src/write/png_filter.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace fastrt {

namespace {

constexpr std::ptrdiff_t pixel = 3; // bytes

enum Filter : unsigned char { sub = 1, up = 2, paeth = 4 };

std::uint32_t size_of(unsigned char difference) {
  return static_cast<std::uint32_t>(std::abs(static_cast<int>(static_cast<signed char>(difference))));
}

// The loops below have no branches and no dependence between bytes, so that compilers make them SIMD.
std::uint32_t filter_sub(const unsigned char* row, std::ptrdiff_t count, unsigned char* out) {
  std::uint32_t sum = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    out[i] = static_cast<unsigned char>(row[i] - row[i - pixel]);
    sum += size_of(out[i]);
  }
  return sum;
}

std::uint32_t filter_up(const unsigned char* row, const unsigned char* above, std::ptrdiff_t count,
                        unsigned char* out) {
  std::uint32_t sum = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    out[i] = static_cast<unsigned char>(row[i] - above[i]);
    sum += size_of(out[i]);
  }
  return sum;
}

std::uint32_t filter_paeth(const unsigned char* row, const unsigned char* above, std::ptrdiff_t count,
                           unsigned char* out) {
  std::uint32_t sum = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto a = static_cast<std::int16_t>(row[i - pixel]);
    const auto b = static_cast<std::int16_t>(above[i]);
    const auto c = static_cast<std::int16_t>(above[i - pixel]);
    const auto from_a = static_cast<std::int16_t>(b - c), from_b = static_cast<std::int16_t>(a - c);
    const auto to_a = static_cast<std::int16_t>(from_a < 0 ? -from_a : from_a);
    const auto to_b = static_cast<std::int16_t>(from_b < 0 ? -from_b : from_b);
    const auto from_c = static_cast<std::int16_t>(from_a + from_b);
    const auto to_c = static_cast<std::int16_t>(from_c < 0 ? -from_c : from_c);
    const std::int16_t b_or_c = to_b <= to_c ? b : c;
    const std::int16_t nearest = to_a <= std::min(to_b, to_c) ? a : b_or_c;
    out[i] = static_cast<unsigned char>(row[i] - nearest);
    sum += size_of(out[i]);
  }
  return sum;
}

} // namespace

void filter_row(const unsigned char* row, const unsigned char* above, std::size_t count,
                unsigned char* scratch, unsigned char* out) noexcept {
  const auto n = static_cast<std::ptrdiff_t>(count);
  out[0] = up;
  std::uint32_t best = filter_up(row, above, n, out + 1);
  const auto keep_if_smaller = [&](std::uint32_t sum, Filter filter) {
    if (sum >= best) return;
    best = sum;
    out[0] = filter;
    std::copy_n(scratch, count, out + 1);
  };
  if (best == 0) return;
  keep_if_smaller(filter_sub(row, n, scratch), sub);
  if (best == 0) return;
  keep_if_smaller(filter_paeth(row, above, n, scratch), paeth);
}

} // namespace fastrt
