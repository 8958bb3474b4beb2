// SPDX-License-Identifier: Apache-2.0
// Looking up a texture at a point per lane (docs/numerics.md, "Textures"). Where in memory pixels lie is
// found for all lanes at once; they are fetched and blended point by point, with a pixel's four channels as
// lanes.
#pragma once

#include "src/simd/shared_math.hpp"
#include "src/trace/surface_lanes.hpp"
#include "src/trace/texture_sites.hpp"
#include "src/trace/texture_view.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Points of a texture, and the mip levels of the footprints there.
struct TexturePlaces {
  PathF s, t, level;
};

// points: of the surfaces.
FASTRT_INLINE TexturePlaces places_on(const TextureRow& row, const HitSites& sites, const PathV& points,
                                      const PathF& footprint) {
  PathF u = PathF::load_aligned(sites.u), v = PathF::load_aligned(sites.v),
        density = PathF::load_aligned(sites.density);
  if (row.planar != 0) {
    u = dot(points, broadcast3<PathF>(row.plane_u));
    v = dot(points, broadcast3<PathF>(row.plane_v));
    density = PathF(row.plane_density);
  }
  const PathF zero(0.0F);
  TexturePlaces places{u * PathF(row.scale[0]) + PathF(row.offset[0]),
                       v * PathF(row.scale[1]) + PathF(row.offset[1]), zero};
  if (row.levels == nullptr) return places;
  const PathF pixels = (footprint * density) * PathF(row.pixels);
  const PathM small = pixels > PathF(1.0F);
  if (to_bits(small) == 0) return places;
  const PathF level = PathF(0.5F) * shared_log2<BatchOps<widest>>(pixels), last(row.last_level);
  places.level = simd::select(small, simd::select(level < last, level, last), zero);
  return places;
}

// Into 0..1: held there, or its fraction. What is no number becomes 0.
FASTRT_INLINE PathF into_unit(const PathF& x, bool clamp) {
  const PathF zero(0.0F), one(1.0F);
  if (clamp) return simd::select(x > zero, simd::select(x < one, x, one), zero);
  const PathF fraction = x - simd::floor(x);
  return simd::select((fraction >= zero) & (fraction <= one), fraction, zero);
}

// Indices of pixels that may be one outside.
FASTRT_INLINE PathI inside(const PathI& i, const PathI& size, bool clamp) {
  const PathI below = clamp ? PathI(0) : i + size, above = clamp ? size - PathI(1) : i - size;
  return simd::select(i < PathI(0), below, simd::select(i >= size, above, i));
}

// The four pixels of a level whose centres are around each point: where they are in the level, and their
// shares.
struct TexelCorners {
  alignas(64) std::int32_t upper_left[widest], upper_right[widest], lower_left[widest], lower_right[widest];
  alignas(64) float left[widest], right[widest], upper[widest], lower[widest];
  const TextureLevel* level[widest];
};

// s, t: in 0..1. levels: which one, per lane.
FASTRT_INLINE void find_corners(const TextureRow& row, const PathF& s, const PathF& t, const PathI& levels,
                                std::uint32_t bits, TexelCorners& out) {
  const bool clamp = row.clamp != 0;
  alignas(64) std::int32_t which[widest], wide[widest], high[widest];
  levels.store_aligned(which);
  PathI(1).store_aligned(wide);
  PathI(1).store_aligned(high);
  for (; bits != 0; bits &= bits - 1) {
    const int k = __builtin_ctz(bits);
    const TextureLevel& level = row.levels[which[k]];
    out.level[k] = &level;
    wide[k] = level.width;
    high[k] = level.height;
  }
  const PathI width = PathI::load_aligned(wide), height = PathI::load_aligned(high);
  const PathF half(0.5F), one(1.0F);
  const PathF x = s * simd::to_float(width) - half, y = (one - t) * simd::to_float(height) - half;
  const PathF left = simd::floor(x), top = simd::floor(y);
  const PathI column = simd::to_int(left), line = simd::to_int(top);
  const PathI x0 = inside(column, width, clamp), x1 = inside(column + PathI(1), width, clamp);
  const PathI y0 = inside(line, height, clamp) * width, y1 = inside(line + PathI(1), height, clamp) * width;
  (y0 + x0).store_aligned(out.upper_left);
  (y0 + x1).store_aligned(out.upper_right);
  (y1 + x0).store_aligned(out.lower_left);
  (y1 + x1).store_aligned(out.lower_right);
  const PathF right_share = x - left, lower_share = y - top;
  right_share.store_aligned(out.right);
  (one - right_share).store_aligned(out.left);
  lower_share.store_aligned(out.lower);
  (one - lower_share).store_aligned(out.upper);
}

FASTRT_INLINE Rgba fetch(const TextureRow& row, const TextureLevel& level, std::int32_t pixel) {
  const std::size_t at = 4 * static_cast<std::size_t>(pixel);
  if (level.floats != nullptr) return load<Rgba>(level.floats + at);
  const std::uint8_t* code = level.bytes + at;
  const float* values = row.decoded;
  return Rgba(_mm_setr_ps(values[code[0]], values[code[1]], values[code[2]], values[256U + code[3]]));
}

// Between the four pixels around the point of lane k.
FASTRT_INLINE Rgba blend_corners(const TextureRow& row, const TexelCorners& c, int k) {
  const TextureLevel& level = *c.level[k];
  const Rgba left(c.left[k]), right(c.right[k]);
  const Rgba upper = fetch(row, level, c.upper_left[k]) * left + fetch(row, level, c.upper_right[k]) * right;
  const Rgba lower = fetch(row, level, c.lower_left[k]) * left + fetch(row, level, c.lower_right[k]) * right;
  return upper * Rgba(c.upper[k]) + lower * Rgba(c.lower[k]);
}

// A colour and alpha per lane.
struct ColorLanes {
  PathV color;
  PathF alpha;
};

FASTRT_INLINE ColorLanes look_up_image(const TextureRow& row, const TexturePlaces& places,
                                       std::uint32_t bits) {
  const bool clamp = row.clamp != 0;
  const PathF s = into_unit(places.s, clamp), t = into_unit(places.t, clamp);
  const PathI level = simd::to_int(places.level);
  const PathF share = places.level - simd::to_float(level);
  const std::uint32_t between = to_bits(share > PathF(0.0F)) & bits;
  alignas(64) float lower_share[widest], upper_share[widest], r[widest], g[widest], b[widest], a[widest];
  share.store_aligned(upper_share);
  (PathF(1.0F) - share).store_aligned(lower_share);
  TexelCorners first, second;
  find_corners(row, s, t, level, bits, first);
  if (between != 0) find_corners(row, s, t, level + PathI(1), between, second);
  for (float* column : {r, g, b, a}) PathF(0.0F).store_aligned(column);
  for (; bits != 0; bits &= bits - 1) {
    const int k = __builtin_ctz(bits);
    Rgba value = blend_corners(row, first, k);
    if ((between >> k & 1U) != 0)
      value = value * Rgba(lower_share[k]) + blend_corners(row, second, k) * Rgba(upper_share[k]);
    alignas(16) float channels[4];
    value.store_aligned(channels);
    r[k] = channels[0];
    g[k] = channels[1];
    b[k] = channels[2];
    a[k] = channels[3];
  }
  return {load3<PathF>(r, g, b), PathF::load_aligned(a)};
}

FASTRT_INLINE ColorLanes look_up_procedure(const TextureRow& row, const TexturePlaces& places) {
  const auto each_channel = [&](const auto& value) {
    return ColorLanes{{value(0), value(1), value(2)}, value(3)};
  };
  if (row.checker != 0) {
    const PathF square = simd::floor(places.s) + simd::floor(places.t);
    const PathM odd = square - PathF(2.0F) * simd::floor(square * PathF(0.5F)) == PathF(1.0F);
    return each_channel(
        [&](int c) { return simd::select(odd, PathF(row.color_b[c]), PathF(row.color_a[c])); });
  }
  const PathF b_share = into_unit(places.t, row.clamp != 0), a_share = PathF(1.0F) - b_share;
  return each_channel(
      [&](int c) { return PathF(row.color_a[c]) * a_share + PathF(row.color_b[c]) * b_share; });
}

// For the lanes in `bits`.
[[gnu::noinline]] static ColorLanes look_up(const TextureRow& row, const TexturePlaces& places,
                                            std::uint32_t bits) noexcept {
  const ColorLanes value =
      row.levels == nullptr ? look_up_procedure(row, places) : look_up_image(row, places, bits);
  const PathF gain(row.gain), base(row.base), zero(0.0F);
  const auto adjusted = [&](const PathF& x) { return max(x * gain + base, zero); };
  return {{adjusted(value.color.x), adjusted(value.color.y), adjusted(value.color.z)}, adjusted(value.alpha)};
}

// The one number of a texture of numbers.
FASTRT_INLINE PathF look_up_number(const TextureRow& row, const TexturePlaces& places, std::uint32_t bits) {
  const ColorLanes v = look_up(row, places, bits);
  return ((v.color.x * PathF(row.channel[0]) + v.color.y * PathF(row.channel[1])) +
          v.color.z * PathF(row.channel[2])) +
         v.alpha * PathF(row.channel[3]);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
