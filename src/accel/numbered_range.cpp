// SPDX-License-Identifier: Apache-2.0
#include "src/accel/numbered_range.hpp"

#include "src/accel/item_loops.hpp"

#include <algorithm>

namespace fastrt {
namespace {

// Boxes by their numbers, from a list of these. Neighbours in the list may lie anywhere: boxes are asked for
// some steps ahead.
struct Numbered {
  static constexpr std::size_t ahead = 24;

  const PrimitiveBox* boxes;
  const std::uint32_t* from;
  std::uint32_t* to;
  std::size_t last; // of the whole list

  const PrimitiveBox& box(std::size_t i) const {
    _mm_prefetch(reinterpret_cast<const char*>(boxes + from[std::min(i + ahead, last)]), _MM_HINT_T0);
    return boxes[from[i]];
  }
  void store(std::size_t i, const LaneBox&, std::uint32_t& place) const { place = from[i]; }
};

Numbered items_of(const NumberedBoxes& all, const BuildRange& range) {
  return {all.boxes, all.buffers[range.buffer], all.buffers[1 - range.buffer], range.end - 1};
}

} // namespace

void measure(const NumberedBoxes& all, BuildRange& range) { measure_items(items_of(all, range), range); }

void fill_bins(const NumberedBoxes& all, const BuildRange& range, const BinMapping& mapping, Bins& bins) {
  add_items(items_of(all, range), range, mapping, bins);
}

void move_to_sides(const NumberedBoxes& all, const BuildRange& range, std::size_t begin, std::size_t end,
                   const BinSplit& split, const SplitSides& sides, Bins* const bins[2]) {
  move_items<true>(items_of(all, range), range.centroids, begin, end, split, sides, bins);
}

void gather(const NumberedBoxes& all, const BuildRange& range, PrimitiveBox* to) {
  const Numbered items = items_of(all, range);
  for (std::size_t i = range.begin; i < range.end; ++i) *to++ = items.box(i);
}

} // namespace fastrt
