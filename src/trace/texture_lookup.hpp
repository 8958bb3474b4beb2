// SPDX-License-Identifier: Apache-2.0
// Looking up a texture at one point (docs/numerics.md, "Textures"). The lanes are a pixel's four channels:
// where in memory a pixel lies is a question for each point alone.
#pragma once

#include "src/kernels/vec3.hpp"
#include "src/simd/shared_math.hpp"
#include "src/trace/texture_view.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

using Rgba = Floats<4>;

// A point of a surface as textures see it.
struct TextureSite {
  float u, v;
  float density; // area of (u, v) per area of the surface
  float point[3];
};

// A point of a texture, and the mip level of the footprint there.
struct TexturePlace {
  float s, t, level;
};

FASTRT_INLINE TexturePlace place_on(const TextureRow& row, const TextureSite& site, float footprint) {
  float u = site.u, v = site.v, density = site.density;
  if (row.planar != 0) {
    const float* p = site.point;
    u = (p[0] * row.plane_u[0] + p[1] * row.plane_u[1]) + p[2] * row.plane_u[2];
    v = (p[0] * row.plane_v[0] + p[1] * row.plane_v[1]) + p[2] * row.plane_v[2];
    density = row.plane_density;
  }
  TexturePlace place;
  place.s = u * row.scale[0] + row.offset[0];
  place.t = v * row.scale[1] + row.offset[1];
  place.level = 0.0F;
  if (row.levels == nullptr) return place;
  const float pixels = (footprint * density) * row.pixels;
  if (pixels > 1.0F) {
    const float level = 0.5F * shared_log2<ScalarOps>(pixels);
    place.level = level < row.last_level ? level : row.last_level;
  }
  return place;
}

// Into 0..1: held there, or its fraction. What is no number becomes 0.
FASTRT_INLINE float into_unit(float x, bool clamp) {
  if (clamp) return x > 0.0F ? (x < 1.0F ? x : 1.0F) : 0.0F;
  const float fraction = x - __builtin_floorf(x);
  return fraction >= 0.0F && fraction <= 1.0F ? fraction : 0.0F;
}

// A pixel's index that may be one outside.
FASTRT_INLINE std::int32_t inside(std::int32_t i, std::int32_t size, bool clamp) {
  if (i < 0) return clamp ? 0 : i + size;
  if (i >= size) return clamp ? size - 1 : i - size;
  return i;
}

FASTRT_INLINE Rgba fetch(const TextureRow& row, const TextureLevel& level, std::int32_t x, std::int32_t y) {
  const long at = 4 * (static_cast<long>(y) * level.width + x);
  if (level.floats != nullptr) return load<Rgba>(level.floats + at);
  const std::uint8_t* code = level.bytes + at;
  const float* values = row.decoded;
  return Rgba(_mm_setr_ps(values[code[0]], values[code[1]], values[code[2]], values[256U + code[3]]));
}

FASTRT_INLINE Rgba mix(const Rgba& a, const Rgba& b, float share) {
  return a * Rgba(1.0F - share) + b * Rgba(share);
}

// Between the four pixels of one level whose centres are around (s, t), both in 0..1.
FASTRT_INLINE Rgba bilinear(const TextureRow& row, const TextureLevel& level, float s, float t) {
  const bool clamp = row.clamp != 0;
  const float x = s * static_cast<float>(level.width) - 0.5F;
  const float y = (1.0F - t) * static_cast<float>(level.height) - 0.5F;
  const float left = __builtin_floorf(x), top = __builtin_floorf(y);
  const std::int32_t x0 = inside(static_cast<std::int32_t>(left), level.width, clamp);
  const std::int32_t x1 = inside(static_cast<std::int32_t>(left) + 1, level.width, clamp);
  const std::int32_t y0 = inside(static_cast<std::int32_t>(top), level.height, clamp);
  const std::int32_t y1 = inside(static_cast<std::int32_t>(top) + 1, level.height, clamp);
  const Rgba upper = mix(fetch(row, level, x0, y0), fetch(row, level, x1, y0), x - left);
  const Rgba lower = mix(fetch(row, level, x0, y1), fetch(row, level, x1, y1), x - left);
  return mix(upper, lower, y - top);
}

FASTRT_INLINE Rgba procedural(const TextureRow& row, const TexturePlace& place) {
  const Rgba a = load<Rgba>(row.color_a), b = load<Rgba>(row.color_b);
  if (row.checker == 0) return mix(a, b, into_unit(place.t, row.clamp != 0));
  const float square = __builtin_floorf(place.s) + __builtin_floorf(place.t);
  return square - 2.0F * __builtin_floorf(square * 0.5F) == 1.0F ? b : a;
}

static Rgba look_up(const TextureRow& row, const TexturePlace& place) noexcept {
  Rgba value;
  if (row.levels == nullptr) {
    value = procedural(row, place);
  } else {
    const float s = into_unit(place.s, row.clamp != 0), t = into_unit(place.t, row.clamp != 0);
    const auto level = static_cast<std::int32_t>(place.level);
    const float share = place.level - static_cast<float>(level);
    value = bilinear(row, row.levels[level], s, t);
    if (share > 0.0F) value = mix(value, bilinear(row, row.levels[level + 1], s, t), share);
  }
  return max(value * Rgba(row.gain) + Rgba(row.base), Rgba(0.0F));
}

// The one number of a texture of numbers.
FASTRT_INLINE float channel_of(const TextureRow& row, const Rgba& value) {
  alignas(16) float v[4];
  value.store_aligned(v);
  return ((v[0] * row.channel[0] + v[1] * row.channel[1]) + v[2] * row.channel[2]) + v[3] * row.channel[3];
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
