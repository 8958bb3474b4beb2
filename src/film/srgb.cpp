// SPDX-License-Identifier: Apache-2.0
#include "src/film/srgb.hpp"

#include "src/scene/srgb_curve.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace fastrt {

namespace {

// The floats from 2^-13 to 1 fall into buckets by their exponent and the first seven bits of their mantissa.
// The curve is so flat that no bucket holds more than one step from a code to the next.
constexpr float least = 0x1p-13F;      // still code 0
constexpr float most = 0x1.FFFFFEp-1F; // the largest number below 1, code 255
constexpr unsigned shift = 16;
constexpr std::uint32_t first_bucket = std::bit_cast<std::uint32_t>(least) >> shift;
constexpr std::uint32_t bucket_count = (std::bit_cast<std::uint32_t>(most) >> shift) - first_bucket + 1;

double srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

std::uint32_t code_of(float linear) {
  return static_cast<std::uint32_t>(std::floor(255.0 * srgb(static_cast<double>(linear)) + 0.5));
}

// The smallest float whose code is `code`, 1..255.
std::uint32_t first_bits_of(std::uint32_t code) {
  std::uint32_t low = std::bit_cast<std::uint32_t>(least), high = std::bit_cast<std::uint32_t>(1.0F);
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (code_of(std::bit_cast<float>(middle)) >= code ? high : low) = middle;
  }
  return high;
}

// A bucket's entry, plus the low half of a number's bits, has the number's code in its high half: the low
// half overflows from the step on.
std::array<std::uint32_t, bucket_count> make_table() {
  std::array<std::uint32_t, bucket_count> table{};
  std::uint32_t code = 1, step = first_bits_of(1);
  for (std::uint32_t bucket = 0; bucket < bucket_count; ++bucket) {
    table[bucket] = (code - 1) << shift;
    if (code > 255 || (step >> shift) != bucket + first_bucket) continue;
    table[bucket] += 0x10000U - (step & 0xFFFFU);
    if (++code <= 255) step = first_bits_of(code);
  }
  return table;
}

constexpr std::size_t channels = 3;
constexpr std::size_t block_size = 85 * channels;

void convert(const std::uint32_t* entries, const float* linear, std::size_t count, unsigned char* codes) {
  std::array<std::uint32_t, block_size> bits; // clamped in a loop of its own, which compilers make SIMD
  for (std::size_t i = 0; i < count; ++i) {
    float x = linear[i];
    x = x > least ? x : least; // NaN too
    x = x < most ? x : most;
    bits[i] = std::bit_cast<std::uint32_t>(x);
  }
  for (std::size_t i = 0; i < count; ++i)
    codes[i] = static_cast<unsigned char>(
        (entries[(bits[i] >> shift) - first_bucket] + (bits[i] & 0xFFFFU)) >> shift);
}

// Whether all pixels are the first one, as in much of a background.
bool repeats(const float* linear, std::size_t count) {
  return count > channels && std::memcmp(linear, linear + channels, (count - channels) * sizeof(float)) == 0;
}

} // namespace

void to_srgb8(const float* linear, std::size_t count, unsigned char* codes) noexcept {
  static const std::array<std::uint32_t, bucket_count> table = make_table();
  for (std::size_t begin = 0; begin < count; begin += block_size) {
    const std::size_t n = std::min(block_size, count - begin);
    unsigned char* const out = codes + begin;
    if (repeats(linear + begin, n)) {
      convert(table.data(), linear + begin, channels, out);
      for (std::size_t i = channels; i < n; ++i) out[i] = out[i - channels];
    } else {
      convert(table.data(), linear + begin, n, out);
    }
  }
}

float linear_of_srgb8(unsigned char code) noexcept {
  return static_cast<float>(linear_of_srgb(code / 255.0));
}

} // namespace fastrt
