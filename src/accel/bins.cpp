// SPDX-License-Identifier: Apache-2.0
#include "src/accel/bins.hpp"

#include <limits>

namespace fastrt {

BinMapping::BinMapping(const LaneBox& centroids) : base(centroids.lower) {
  // A little less than the number of bins, so that the upper end falls into the last one.
  const __m128 bins = _mm_set1_ps(bin_count * 0.99999F);
  const __m128 extent = _mm_sub_ps(centroids.upper, centroids.lower);
  const __m128 wide = _mm_cmpge_ps(extent, _mm_set1_ps(std::numeric_limits<float>::min()));
  scale = _mm_and_ps(wide, _mm_div_ps(bins, extent));
}

void Bins::add(const Bins& other) {
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < bin_count; ++i) boxes[axis][i].extend(other.boxes[axis][i]);
  for (int i = 0; i < bin_count; ++i)
    for (int axis = 0; axis < 3; ++axis) counts[i][axis] += other.counts[i][axis];
}

namespace {

// Sweeps over the bins of the three axes side by side: lane by lane, axis by axis.
struct Sweep {
  LaneBox boxes[3];
  __m128i counts = _mm_setzero_si128();

  void add(const Bins& bins, int i) {
    for (int axis = 0; axis < 3; ++axis) boxes[axis].extend(bins.boxes[axis][i]);
    counts = _mm_add_epi32(counts, _mm_loadu_si128(reinterpret_cast<const __m128i*>(bins.counts[i])));
  }
  // An empty side has an infinite box and no runs: NaN, which is less than nothing.
  __m128 cost(__m128 scale, int run_log2) const {
    return _mm_mul_ps(half_areas(boxes, scale), runs_of(counts, run_log2));
  }
};

} // namespace

BinSplit best_split(const Bins& bins, __m128 scale, int run_log2) {
  __m128 right_costs[bin_count];
  Sweep right;
  for (int i = bin_count - 1; i > 0; --i) {
    right.add(bins, i);
    right_costs[i] = right.cost(scale, run_log2);
  }
  Sweep left;
  LeastCosts least;
  for (int i = 1; i < bin_count; ++i) {
    left.add(bins, i - 1);
    least.offer(_mm_add_ps(left.cost(scale, run_log2), right_costs[i]), i);
  }
  BinSplit best;
  best.axis = least.axis();
  if (best.axis < 0) return best;
  best.position = least.place(best.axis);
  for (int i = 0; i < bin_count; ++i) best.occupied += bins.counts[i][best.axis] != 0;
  return best;
}

LaneBox left_bounds(const Bins& bins, const BinSplit& split) {
  LaneBox bounds;
  for (int i = 0; i < split.position; ++i) bounds.extend(bins.boxes[split.axis][i]);
  return bounds;
}

LaneBox right_bounds(const Bins& bins, const BinSplit& split) {
  LaneBox bounds;
  for (int i = split.position; i < bin_count; ++i) bounds.extend(bins.boxes[split.axis][i]);
  return bounds;
}

std::size_t left_count(const Bins& bins, const BinSplit& split) {
  std::size_t count = 0;
  for (int i = 0; i < split.position; ++i) count += bins.counts[i][split.axis];
  return count;
}

} // namespace fastrt
