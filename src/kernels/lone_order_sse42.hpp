// SPDX-License-Identifier: Apache-2.0
// lone_order.hpp for SSE4.2, whose lanes hold half a node: entry by entry.
#pragma once

#include "src/kernels/waiting.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Which boxes were met (bits), and where. Putting them onto the stack takes branches that can hardly be
// foreseen.
struct MetBoxes {
  std::uint32_t met;
  alignas(16) float near[wide_children];
};

template <class Meet>
FASTRT_INLINE void find_met(const WideNode&, const Meet& meet, MetBoxes& boxes) {
  boxes.met = 0;
  for (int half = 0; half < wide_children; half += node_lanes) {
    const BoxLanes lanes = meet(half);
    lanes.near.store_aligned(boxes.near + half);
    boxes.met |= to_bits(lanes.near <= lanes.far) << half;
  }
}

FASTRT_INLINE Waiting* push_in_order(const WideNode& node, const MetBoxes& boxes, Waiting* top) {
  std::uint32_t bits = boxes.met;
  if (bits == 0) return top;
  const auto next = [&] {
    const int i = __builtin_ctz(bits);
    bits &= bits - 1;
    return make_waiting(node.child[i], boxes.near[i], node.size[i]);
  };
  Waiting nearest = next();
  Waiting* const bottom = top;
  while (bits != 0) {
    Waiting entry = next();
    if (entry < nearest) {
      const Waiting swapped = nearest;
      nearest = entry;
      entry = swapped;
    }
    Waiting* place = top++;
    for (; place != bottom && place[-1] < entry; --place) *place = place[-1];
    *place = entry;
  }
  *top++ = nearest;
  return top;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
