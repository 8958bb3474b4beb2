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

// As those of subtree.hpp: numbers range.begin .. range.end - 1 of the range's buffer, or begin .. end - 1.
void measure(const NumberedBoxes& all, BuildRange& range);
void fill_bins(const NumberedBoxes& all, const BuildRange& range, const BinMapping& mapping, Bins& bins);
void move_to_sides(const NumberedBoxes& all, const BuildRange& range, std::size_t begin, std::size_t end,
                   const BinSplit& split, const SplitSides& sides, Bins* const bins[2]);

// The boxes of a range, side by side.
void gather(const NumberedBoxes& all, const BuildRange& range, PrimitiveBox* to);

} // namespace fastrt
