// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/accel/box_lanes.hpp"

#include <cstddef>
#include <cstdint>

namespace fastrt {

inline constexpr int bin_count = 16;

inline __m128i clamp_bins(__m128i bins) {
  return _mm_max_epi16(_mm_min_epi16(bins, _mm_set1_epi32(bin_count - 1)), _mm_setzero_si128());
}

// Which bin a centroid falls into, on all three axes at once.
struct BinMapping {
  __m128 base = _mm_setzero_ps();
  __m128 scale = _mm_setzero_ps();

  BinMapping() = default;
  // For doubled centroids within these bounds. An axis without extent has one bin.
  explicit BinMapping(const LaneBox& centroids);

  // Three bin numbers, slightly out of range for a centroid slightly out of bounds.
  __m128i unclamped(__m128 centroid) const {
    return _mm_cvttps_epi32(_mm_mul_ps(_mm_sub_ps(centroid, base), scale));
  }
  // Three bin numbers, in range whatever the centroid is.
  __m128i operator()(__m128 centroid) const { return clamp_bins(unclamped(centroid)); }
};

// What fell into the bins of each axis.
struct Bins {
  LaneBox boxes[3][bin_count];
  std::uint32_t counts[bin_count][4] = {};

  // The numbers are multiplied by 16 all at once, so that they need no arithmetic to become addresses.
  void add(const LaneBox& box, __m128i bins) {
    const __m128i offsets = _mm_slli_epi32(bins, 4);
    add(box, 0, static_cast<unsigned>(_mm_cvtsi128_si32(offsets)));
    add(box, 1, static_cast<unsigned>(_mm_extract_epi16(offsets, 2)));
    add(box, 2, static_cast<unsigned>(_mm_extract_epi16(offsets, 4)));
  }
  void add(const Bins& other);

private:
  void add(const LaneBox& box, int axis, std::size_t offset) {
    static_assert(sizeof(LaneBox) == 32 && sizeof(counts[0]) == 16);
    reinterpret_cast<LaneBox*>(reinterpret_cast<char*>(boxes[axis]) + offset * 2)->extend(box);
    ++*reinterpret_cast<std::uint32_t*>(reinterpret_cast<char*>(counts) + offset +
                                        std::size_t{4} * static_cast<std::size_t>(axis));
  }
};

// A plane between bins: left of it lie the bins 0 .. position - 1 of the axis.
struct BinSplit {
  int axis = -1; // -1: none
  int position = 0;
  int occupied = 0; // bins of the axis that are not empty
};

// The plane with the least area * runs on both sides; none if no plane has something on either side.
BinSplit best_split(const Bins& bins, __m128 scale, int run_log2);

LaneBox left_bounds(const Bins& bins, const BinSplit& split);
LaneBox right_bounds(const Bins& bins, const BinSplit& split);
std::size_t left_count(const Bins& bins, const BinSplit& split);

} // namespace fastrt
