// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/accel/box_lanes.hpp"

#include <cstddef>
#include <cstdint>

namespace fastrt {

inline constexpr int bin_count = 16;

// Which bin a centroid falls into, on all three axes at once.
struct BinMapping {
  __m128 base = _mm_setzero_ps();
  __m128 scale = _mm_setzero_ps();

  BinMapping() = default;
  // For doubled centroids within these bounds. An axis without extent has one bin.
  explicit BinMapping(const LaneBox& centroids);

  // Three bin numbers; outside the bounds, or if the numbers overflow, it is some bin all the same.
  __m128i operator()(__m128 doubled_centroid) const {
    const __m128i bins = _mm_cvttps_epi32(_mm_mul_ps(_mm_sub_ps(doubled_centroid, base), scale));
    return _mm_max_epi16(_mm_min_epi16(bins, _mm_set1_epi32(bin_count - 1)), _mm_setzero_si128());
  }
};

// What fell into the bins of each axis.
struct Bins {
  LaneBox boxes[3][bin_count];
  std::uint32_t counts[bin_count][4] = {};

  void add(const LaneBox& box, __m128i bins) {
    const int x = _mm_cvtsi128_si32(bins), y = _mm_extract_epi16(bins, 2), z = _mm_extract_epi16(bins, 4);
    boxes[0][x].extend(box);
    boxes[1][y].extend(box);
    boxes[2][z].extend(box);
    ++counts[x][0];
    ++counts[y][1];
    ++counts[z][2];
  }
  void add(const Bins& other);
};

// A plane between bins: left of it lie the bins 0 .. position - 1 of the axis.
struct BinSplit {
  int axis = -1; // -1: none
  int position = 0;
  int occupied = 0; // bins of the axis that are not empty
};

// The plane with the least area * blocks on both sides; none if no plane has something on either side.
BinSplit best_split(const Bins& bins, __m128 scale);

inline bool is_right(__m128i bins, const BinSplit& split) {
  const __m128i right = _mm_cmpgt_epi32(bins, _mm_set1_epi32(split.position - 1));
  return (static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(right))) >> split.axis & 1U) != 0;
}

LaneBox left_bounds(const Bins& bins, const BinSplit& split);
LaneBox right_bounds(const Bins& bins, const BinSplit& split);
std::size_t left_count(const Bins& bins, const BinSplit& split);

} // namespace fastrt
