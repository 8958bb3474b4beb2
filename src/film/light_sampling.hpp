// SPDX-License-Identifier: Apache-2.0
// Where the samples of a light with a size lie on it: a function of (pixel, sample, bounce, light, index,
// seed) alone. Integers until the last steps, and those are additions, multiplications, divisions and square
// roots, so that every path gets the same bits.
#pragma once

#include "src/film/sampling.hpp"

namespace fastrt {

enum class LightShape : std::uint32_t { none, rectangle, disk, sphere };

// Which point of a picture asks.
struct LightQuestion {
  std::uint32_t x, y;   // pixel
  std::uint32_t sample; // of the pixel
  std::uint32_t depth;  // bounces of the ray
  std::uint32_t light;
  std::uint32_t seed;
};

// In units of the light's three half axes.
struct LightPlace {
  float x, y, z;
};

// Sample `index` of `count`: a Hammersley set, shifted at random (Cranley & Patterson 1976), so that every
// row and column of a count-fold grid on the light holds one.
[[gnu::always_inline]] static inline LightPlace light_place(LightShape shape, const LightQuestion& question,
                                                            std::uint32_t index, std::uint32_t count) {
  const std::uint32_t at = hash32(question.x + hash32(question.y + hash32(question.sample)));
  const std::uint32_t key =
      hash32(at + hash32(question.light + hash32(question.depth + hash32(question.seed))));
  const auto stratum = static_cast<std::uint32_t>((static_cast<std::uint64_t>(index) << 32U) / count);
  const std::uint32_t u_bits = stratum + key;
  const std::uint32_t v_bits = reverse_bits(index) + hash32(key);
  const float a = static_cast<float>(static_cast<std::int32_t>(u_bits >> 8U)) * 0x1p-23F - 1.0F;
  const float b = static_cast<float>(static_cast<std::int32_t>(v_bits >> 8U)) * 0x1p-23F - 1.0F;
  if (shape == LightShape::rectangle) return {a, b, 0.0F};
  const SampleOffset disk = disk_point(a, b);
  if (shape == LightShape::disk) return {disk.x, disk.y, 0.0F};
  // The disk to the sphere, areas to areas (Lambert's map).
  const float r2 = disk.x * disk.x + disk.y * disk.y;
  const float left = 1.0F - r2;
  const float scale = 2.0F * __builtin_sqrtf(left > 0.0F ? left : 0.0F);
  return {disk.x * scale, disk.y * scale, 1.0F - 2.0F * r2};
}

} // namespace fastrt
