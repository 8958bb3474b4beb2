// SPDX-License-Identifier: Apache-2.0
// The builder's innermost loops, over items: boxes side by side, or a list of the numbers of boxes.
// items.box(i): the box of the i-th; items.store(i, box, to): puts what there is of it; items.to: the place
// of the first after a move.
#pragma once

#include "src/accel/subtree.hpp"

namespace fastrt {

inline float lane_of(__m128 values, int lane) {
  alignas(16) float lanes[4];
  _mm_store_ps(lanes, values);
  return lanes[lane];
}

// The range's exact bounds: of its boxes and of their doubled centroids.
template <class Items>
void measure_items(const Items& items, BuildRange& range) {
  range.bounds = range.centroids = LaneBox{};
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const LaneBox box = load(items.box(i));
    range.bounds.extend(box);
    range.centroids.extend(doubled_centroid(box));
  }
  range.tight = true;
}

template <class Items>
void add_items(const Items& items, const BuildRange& range, const BinMapping& mapping, Bins& bins) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const LaneBox box = load(items.box(i));
    bins.add(box, mapping(doubled_centroid(box)));
  }
}

// Moves items begin .. end - 1 to their sides, keeping their order, and into the sides' bins only if these
// are asked for. What a primitive's bins wait for is kept short, or they are late for the next primitives':
// the axis is looked at by itself, in all lanes, and both sides' mappings are at hand before it is known
// which counts.
template <bool into_bins, class Items>
void move_items(const Items& items, const LaneBox& centroids, std::size_t begin, std::size_t end,
                const BinSplit& split, const SplitSides& sides, Bins* const bins[2]) {
  const BinMapping mapping(centroids);
  const int axis = split.axis;
  const __m128 base = _mm_set1_ps(lane_of(mapping.base, axis));
  const __m128 scale = _mm_set1_ps(lane_of(mapping.scale, axis));
  const __m128 plane = _mm_set1_ps(static_cast<float>(split.position));
  const BinMapping left_mapping = sides.mappings[0], right_mapping = sides.mappings[1];
  auto *next_left = items.to + sides.next[0], *next_right = items.to + sides.next[1];
  for (std::size_t i = begin; i < end; ++i) {
    const PrimitiveBox& from = items.box(i);
    const LaneBox whole{_mm_load_ps(from.lower), _mm_load_ps(from.upper)}; // with id and group
    const __m128 place =
        _mm_mul_ps(_mm_sub_ps(_mm_set1_ps(from.lower[axis] + from.upper[axis]), base), scale);
    const __m128 is_right = _mm_cmpge_ps(place, plane);
    const std::size_t side = static_cast<std::size_t>(_mm_movemask_ps(is_right)) & 1U;
    items.store(i, whole, *(side != 0 ? next_right : next_left));
    next_left += 1 - side;
    next_right += side;
    if constexpr (into_bins) {
      const LaneBox box = clear_fourth(whole);
      const __m128 centroid = doubled_centroid(box);
      const __m128i bin = select(_mm_castps_si128(is_right), right_mapping.unclamped(centroid),
                                 left_mapping.unclamped(centroid));
      (side != 0 ? bins[1] : bins[0])->add(box, clamp_bins(bin));
    }
  }
}

} // namespace fastrt
