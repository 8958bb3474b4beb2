// SPDX-License-Identifier: Apache-2.0
// Where the samples of a pixel lie. Integers until the last step, so that every path gets the same bits.
#pragma once

#include <cstdint>

namespace fastrt {

// A well-mixed 32-bit hash of one word (Wellons' "lowbias32" constants).
[[gnu::always_inline]] static inline std::uint32_t hash32(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x7FEB352DU;
  x ^= x >> 15U;
  x *= 0x846CA68BU;
  x ^= x >> 16U;
  return x;
}

[[gnu::always_inline]] static inline std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x >> 16U) | (x << 16U);
  x = (x & 0xFF00FF00U) >> 8U | (x & 0x00FF00FFU) << 8U;
  x = (x & 0xF0F0F0F0U) >> 4U | (x & 0x0F0F0F0FU) << 4U;
  x = (x & 0xCCCCCCCCU) >> 2U | (x & 0x33333333U) << 2U;
  return (x & 0xAAAAAAAAU) >> 1U | (x & 0x55555555U) << 1U;
}

// The square root is correctly rounded everywhere, so this stays exact.
[[gnu::always_inline]] static inline float tent_warp(float u) {
  return u < 0.5F ? __builtin_sqrtf(2.0F * u) - 1.0F : 1.0F - __builtin_sqrtf(2.0F - 2.0F * u);
}

struct SampleOffset {
  float x, y; // from the pixel's centre, in pixels
};

// Sample `index` of `count` >= 2 of pixel (x, y): a Hammersley set, shifted per pixel (Cranley & Patterson
// 1976), so every row and column of a count-fold grid holds one sample. tent: spread as a tent filter two
// pixels wide, each sample with equal weight (filter importance sampling, Ernst et al. 2006); otherwise over
// the pixel's square.
[[gnu::always_inline]] static inline SampleOffset sample_offset(std::uint32_t x, std::uint32_t y,
                                                                std::uint32_t index, std::uint32_t count,
                                                                std::uint32_t seed, bool tent) {
  const std::uint32_t pixel = hash32(x + hash32(y + hash32(seed)));
  const auto stratum = static_cast<std::uint32_t>((static_cast<std::uint64_t>(index) << 32U) / count);
  const std::uint32_t u_bits = stratum + pixel;
  const std::uint32_t v_bits = reverse_bits(index) + hash32(pixel);
  const float u = static_cast<float>(u_bits >> 8U) * 0x1p-24F;
  const float v = static_cast<float>(v_bits >> 8U) * 0x1p-24F;
  if (tent) return {tent_warp(u), tent_warp(v)};
  return {u - 0.5F, v - 0.5F};
}

} // namespace fastrt
