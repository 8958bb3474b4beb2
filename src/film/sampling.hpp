// SPDX-License-Identifier: Apache-2.0
// Where the samples of a pixel lie, on the image and on the lens: functions of (pixel, index, seed) alone, so
// that any number of samples can be taken in any order. Integers until the last steps, and those are
// additions, multiplications, divisions and square roots: every path gets the same bits.
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

// One of two numbers that are both computed: of loops with branches compilers make no SIMD.
[[gnu::always_inline]] static inline float pick(bool first, float a, float b) {
  const std::uint32_t mask = 0U - static_cast<std::uint32_t>(first);
  return __builtin_bit_cast(float, (__builtin_bit_cast(std::uint32_t, a) & mask) |
                                       (__builtin_bit_cast(std::uint32_t, b) & ~mask));
}

// The square root is correctly rounded everywhere, so this stays exact.
[[gnu::always_inline]] static inline float tent_warp(float u) {
  const bool low = u < 0.5F;
  const float root = __builtin_sqrtf(pick(low, 2.0F * u, 2.0F - 2.0F * u));
  return pick(low, root - 1.0F, 1.0F - root);
}

// How samples are spread over a pixel's surroundings so that each counts the same (filter importance
// sampling, Ernst et al. 2006). Made by filter_of() in filter_table.hpp.
enum class FilterShape : std::uint32_t { box, tent, table };

inline constexpr int filter_steps = 1024;
// Of a filter with negative lobes, every sample whose index is 7 modulo 8 lies in a lobe.
inline constexpr std::uint32_t lobe_period = 8;

struct Filter {
  FilterShape shape;
  float negative;     // the lobes' weight; the rest weighs 1 + negative. 0: no lobes
  const float* core;  // of shape `table`: filter_steps + 2 offsets, from the centre outwards
  const float* lobes; // the same for the lobes
};

[[gnu::always_inline]] static inline bool in_lobe(const Filter& filter, std::uint32_t index) {
  return filter.negative != 0.0F && index % lobe_period == lobe_period - 1;
}
// How many of the samples 0 .. count - 1 lie in lobes.
[[gnu::always_inline]] static inline std::uint32_t lobe_samples(const Filter& filter, std::uint32_t count) {
  return filter.negative != 0.0F ? count / lobe_period : 0U;
}

// A pixel is sum * core - lobe_sum * lobes, of the sums of its samples in no lobe and in lobes.
struct SampleWeights {
  float core, lobes;
};
[[gnu::always_inline]] static inline SampleWeights sample_weights(const Filter& filter, std::uint32_t count) {
  const std::uint32_t in_lobes = lobe_samples(filter, count);
  const auto others = static_cast<float>(count - in_lobes);
  if (in_lobes == 0) return {1.0F / others, 0.0F};
  return {(1.0F + filter.negative) / others, filter.negative / static_cast<float>(in_lobes)};
}
[[gnu::always_inline]] static inline float resolve_channel(const SampleWeights& weights, float sum,
                                                           float lobe_sum) {
  if (weights.lobes == 0.0F) return sum * weights.core;
  const float value = sum * weights.core - lobe_sum * weights.lobes;
  return value > 0.0F ? value : 0.0F;
}

// A point of Sobol's sequence in two dimensions, bits in reverse: what scramble() takes.
struct SequencePoint {
  std::uint32_t u, v;
};
[[gnu::always_inline]] static inline SequencePoint sequence_point(std::uint32_t index) {
  SequencePoint point{index, 0};
  for (std::uint32_t column = 1; index != 0; index >>= 1U, column ^= column << 1U)
    if ((index & 1U) != 0) point.v ^= column;
  return point;
}

// Owen's scrambling by a hash (Laine & Karras 2011, with the constants of Burley, JCGT 2020), as a number
// from 0 to below 1. Any 2^k points from a multiple of 2^k on stay evenly spread: one in each cell of every
// grid of 2^k equal cells.
[[gnu::always_inline]] static inline std::uint32_t scramble_bits(std::uint32_t reversed, std::uint32_t key) {
  reversed += key;
  reversed ^= reversed * 0x6C50B47CU;
  reversed ^= reversed * 0xB82F1E52U;
  reversed ^= reversed * 0xC7AFE638U;
  reversed ^= reversed * 0x8D22F6E6U;
  return reverse_bits(reversed);
}
[[gnu::always_inline]] static inline float scramble(std::uint32_t reversed, std::uint32_t key) {
  return static_cast<float>(static_cast<std::int32_t>(scramble_bits(reversed, key) >> 8U)) * 0x1p-24F;
}

[[gnu::always_inline]] static inline std::uint32_t pixel_key(std::uint32_t x, std::uint32_t y,
                                                             std::uint32_t seed) {
  return hash32(x + hash32(y + hash32(seed)));
}

// Filters are even: the table is of the half with positive offsets.
[[gnu::always_inline]] static inline float look_up(const float* table, float u) {
  const float side = 2.0F * u - 1.0F;
  const float place = (side < 0.0F ? -side : side) * static_cast<float>(filter_steps);
  const int step = static_cast<int>(place);
  const float x = table[step] + (place - static_cast<float>(step)) * (table[step + 1] - table[step]);
  return side < 0.0F ? -x : x;
}

// What is common to sample `index` of all pixels.
struct SampleSet {
  SequencePoint point;
  std::uint32_t index;    // of the sample, before the lobes' were taken out
  bool lobe, lobe_across; // in a lobe of x, or of y
  Filter filter;
  std::uint32_t seed;
};

[[gnu::always_inline]] static inline SampleSet sample_set(std::uint32_t index, const Filter& filter,
                                                          std::uint32_t seed) {
  SampleSet set{};
  set.index = index;
  set.filter = filter;
  set.seed = seed;
  set.lobe = in_lobe(filter, index);
  // Samples in lobes, and the others, are sequences of their own.
  const std::uint32_t own = set.lobe ? index / lobe_period : index - lobe_samples(filter, index);
  set.lobe_across = set.lobe && own % 2 != 0;
  set.point = sequence_point(set.lobe ? own / 2 : own);
  return set;
}

// Samples in lobes are scrambled by another key.
inline constexpr std::uint32_t lobe_shift = 0x9E3779B9U;

struct SampleOffset {
  float x, y; // from the pixel's centre, in pixels
};

// What scrambles a pixel's points of a set's sequence.
[[gnu::always_inline]] static inline std::uint32_t sample_key(std::uint32_t x, std::uint32_t y,
                                                              const SampleSet& set) {
  return pixel_key(x, y, set.seed) + (set.lobe ? lobe_shift : 0U);
}

// A point of the unit square.
struct UnitPlace {
  float u, v;
};
[[gnu::always_inline]] static inline UnitPlace unit_place(const SequencePoint& point, std::uint32_t key) {
  return {scramble(point.u, key), scramble(point.v, hash32(key))};
}

// Where filters put it: those without a table, without a branch, and those with one.
template <FilterShape shape>
[[gnu::always_inline]] static inline SampleOffset filtered(const UnitPlace& place) {
  static_assert(shape != FilterShape::table);
  if (shape == FilterShape::tent) return {tent_warp(place.u), tent_warp(place.v)};
  return {place.u - 0.5F, place.v - 0.5F};
}
[[gnu::always_inline]] static inline SampleOffset filtered_by_table(const SampleSet& set,
                                                                    const UnitPlace& place) {
  return {look_up(set.lobe && !set.lobe_across ? set.filter.lobes : set.filter.core, place.u),
          look_up(set.lobe_across ? set.filter.lobes : set.filter.core, place.v)};
}

[[gnu::always_inline]] static inline SampleOffset sample_offset(std::uint32_t x, std::uint32_t y,
                                                                const SampleSet& set) {
  const UnitPlace place = unit_place(set.point, sample_key(x, y, set));
  if (set.filter.shape == FilterShape::tent) return filtered<FilterShape::tent>(place);
  if (set.filter.shape == FilterShape::box) return filtered<FilterShape::box>(place);
  return filtered_by_table(set, place);
}

// The square -1 .. 1 to the unit disk, areas to areas (Shirley & Chiu 1997); sine and cosine of up to 45
// degrees by their series.
[[gnu::always_inline]] static inline SampleOffset disk_point(float a, float b) {
  const bool wide = (a < 0.0F ? -a : a) > (b < 0.0F ? -b : b);
  const float radius = pick(wide, a, b);
  const float angle = 0.785398163F * (pick(wide, b, a) / pick(radius == 0.0F, 1.0F, radius)); // no 0 / 0
  const float square = angle * angle;
  const float sine =
      angle * (1.0F + square * (-0.166666667F + square * (0.00833333333F + square * -0.000198412698F)));
  const float cosine =
      1.0F +
      square * (-0.5F + square * (0.0416666667F + square * (-0.00138888889F + square * 2.48015873e-5F)));
  const float along = radius * cosine, across = radius * sine;
  return {pick(wide, along, across), pick(wide, across, along)};
}

// What scrambles a pixel's points on the lens.
[[gnu::always_inline]] static inline std::uint32_t lens_key(std::uint32_t x, std::uint32_t y,
                                                            std::uint32_t seed) {
  return hash32(pixel_key(x, y, seed) + 0x632BE5ABU);
}
// Which point of the sequence is the lens's of sample `index`.
[[gnu::always_inline]] static inline std::uint32_t lens_index(std::uint32_t index, std::uint32_t key) {
  return scramble_bits(reverse_bits(index), key);
}
[[gnu::always_inline]] static inline SampleOffset lens_place(const SequencePoint& point, std::uint32_t key) {
  const float a = scramble(point.u, hash32(key + 1U));
  const float b = scramble(point.v, hash32(key + 2U));
  return disk_point(2.0F * a - 1.0F, 2.0F * b - 1.0F);
}

// Where the ray of sample `index` of pixel (x, y) leaves the lens, a disk of radius 1: as evenly spread, and
// shuffled, so that places on the lens and on the image have nothing to do with each other.
[[gnu::always_inline]] static inline SampleOffset lens_point(std::uint32_t x, std::uint32_t y,
                                                             const SampleSet& set) {
  const std::uint32_t key = lens_key(x, y, set.seed);
  return lens_place(sequence_point(lens_index(set.index, key)), key);
}

} // namespace fastrt
