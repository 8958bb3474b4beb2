// SPDX-License-Identifier: Apache-2.0
// Which numbers the darkest and the brightest code of an AOV's picture stand for.
#pragma once

#include "src/write/codes.hpp"

#include <fastrt/math.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace fastrt {

// The finite numbers that were added lie within these; 0 and 1 if there are none.
struct Range {
  float low = infinity, high = -infinity;
  void add(float x) {
    if (!std::isfinite(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  // 0 at the low end, 1 at the high one.
  float place(float x) const { return high > low ? (x - low) / (high - low) : 0.0F; }
};

using Ranges = std::array<Range, 3>; // of the channels

// add(pixel, ranges) for all pixels.
template <class Add>
Ranges ranges_of_pixels(std::size_t pixels, int threads, const Add& add) {
  std::vector<Ranges> of_pieces(piece_count(pixels));
  for_pieces(pixels, threads, [&](std::size_t piece, std::size_t first, std::size_t last) {
    Ranges ranges;
    for (std::size_t pixel = first; pixel < last; ++pixel) add(pixel, ranges);
    of_pieces[piece] = ranges;
  });
  Ranges all;
  for (const Ranges& ranges : of_pieces)
    for (std::size_t c = 0; c < all.size(); ++c) {
      all[c].add(ranges[c].low);
      all[c].add(ranges[c].high);
    }
  return all;
}

// Where nothing is seen.
inline bool is_zero(const float* v) { return v[0] == 0.0F && v[1] == 0.0F && v[2] == 0.0F; }

// The box of the positions (three numbers a pixel) but for those far from most others: before a horizon they
// would leave nothing for the rest.
Ranges ranges_of_positions(std::span<const float> positions, int threads);

} // namespace fastrt
