// SPDX-License-Identifier: Apache-2.0
// Takes scattered rays apart. Neighbouring pixels often see two surfaces, one behind the other: as the light
// sees their points, the groups at the edge between the two reach from the one to the other. Without the rays
// of one side all groups are small again, and those of the other side are few and lie together.
#pragma once

#include "src/kernels/tile_setup.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Times that a batch is taken apart at most, and so one less than it has parts.
inline constexpr int max_tile_splits = 3;

FASTRT_INLINE void find_ends(LiveRays& live) {
  live.first = live.last = -1;
  for (int g = 0; g < batch_groups; ++g) {
    if (live.bits[g] == 0) continue;
    if (live.first < 0) live.first = g * group_size + __builtin_ctz(live.bits[g]);
    live.last = g * group_size + 31 - __builtin_clz(live.bits[g]);
  }
}

// The group's rays that lie beyond the middle of the longer side of its rectangle.
FASTRT_INLINE std::uint32_t far_side(const TilePoints& points, const TileGroups& groups, int g) {
  const float width = groups.x1[g] - groups.x0[g], height = groups.y1[g] - groups.y0[g];
  const bool wide = width > height;
  const float* const at = (wide ? points.x : points.y) + g * group_size;
  const PacketF middle(wide ? groups.x0[g] + 0.5F * width : groups.y0[g] + 0.5F * height);
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) bits |= to_bits(PacketF::load_aligned(at + k) > middle) << k;
  return bits;
}

// Moves one side of each group that takes more than its share of the plane from `live` to `others`; false if
// there is nothing to move. points, groups: of the rays in `live`.
FASTRT_INLINE bool split_groups(const TilePoints& points, const TileGroups& groups, LiveRays& live,
                                LiveRays& others) {
  const float width = most_of(groups.x1) - least_of(groups.x0);
  const float height = most_of(groups.y1) - least_of(groups.y0);
  const float share = width * height * (1.0F / batch_groups);
  others = LiveRays{};
  std::uint32_t moved = 0;
  for (int g = 0; g < batch_groups; ++g) {
    if (!((groups.x1[g] - groups.x0[g]) * (groups.y1[g] - groups.y0[g]) > share)) continue;
    others.bits[g] = live.bits[g] & far_side(points, groups, g);
    live.bits[g] &= ~others.bits[g];
    moved |= others.bits[g];
  }
  find_ends(live);
  find_ends(others);
  return moved != 0 && live.first >= 0;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
