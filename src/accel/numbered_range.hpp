// SPDX-License-Identifier: Apache-2.0
// Large ranges of primitives by their numbers: while those travel, the boxes stay where they are. A second
// copy of these would be the most memory that a build takes, and new memory is slow.
#pragma once

#include "src/accel/subtree.hpp"

namespace fastrt {

struct NumberedBoxes {
  const PrimitiveBox* boxes;
  std::uint32_t* buffers[2]; // numbers of boxes travel between the two, one way per level
};

// The range's exact bounds: of the boxes with its numbers, and of their doubled centroids.
void measure(const NumberedBoxes& all, BuildRange& range);
// Adds the range's boxes to where `mapping` puts them.
void fill_bins(const NumberedBoxes& all, const BuildRange& range, const BinMapping& mapping, Bins& bins);
// Moves numbers begin .. end - 1, a part of the range, to the other buffer: each to its side, from sides.next
// on, in their order. Their boxes go into the side's bins.
void move_to_sides(const NumberedBoxes& all, const BuildRange& range, std::size_t begin, std::size_t end,
                   const BinSplit& split, const SplitSides& sides, Bins* const bins[2]);

// The boxes of a range, side by side: `to` holds range.size().
void gather(const NumberedBoxes& all, const BuildRange& range, PrimitiveBox* to);

} // namespace fastrt
