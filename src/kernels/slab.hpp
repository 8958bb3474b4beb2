// SPDX-License-Identifier: Apache-2.0
// Ray against box. These tests only cull: they may let a box through that the ray misses, never the other way
// round. A primitive's own test may report a hit a little outside its box (docs/numerics.md, "Triangle": by
// reach_margin), so boxes are met as if larger than that by box_padding; and distances are compared with a
// little slack.
#pragma once

#include "src/kernels/vec3.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Boxes are met as if larger by this share of the largest coordinate in play.
inline constexpr float box_padding = 0x1p-19F;
// What lies farther than the closest hit by no more than this share of it is still looked at.
inline constexpr float depth_slack = 0x1p-18F;

FASTRT_INLINE float depth_bound(float t) { return t + __builtin_fabsf(t) * depth_slack; }
template <class F>
FASTRT_INLINE F depth_bound(const F& t) {
  return t + abs(t) * F(depth_slack);
}

template <class F>
struct SlabLanes {
  F near, far; // the ray is in the box for near <= t <= far; a miss when near > far
};

} // namespace fastrt::FASTRT_ISA_NAMESPACE
