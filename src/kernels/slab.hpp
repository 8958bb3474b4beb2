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
// 1 + 2 * gamma(3), Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013.
inline constexpr float slab_factor = 1.00000036F;

FASTRT_INLINE float depth_bound(float t) { return t + __builtin_fabsf(t) * depth_slack; }
template <class F>
FASTRT_INLINE F depth_bound(const F& t) {
  return t + abs(t) * F(depth_slack);
}

// One axis of a ray: where it starts, as the near and the far plane see it, and the inverse of its direction.
template <class F>
struct SlabAxis {
  F near_origin, far_origin, inverse;
};

template <class F>
FASTRT_INLINE SlabAxis<F> slab_axis(const F& origin, const F& dir, const F& padding) {
  const F pad = flip(padding, sign_bit(dir));
  return {origin + pad, origin - pad, F(1.0F) / dir};
}

template <class F>
FASTRT_INLINE F padding_of(const V3<F>& origin, const F& largest_coordinate) {
  return F(box_padding) * max(largest(origin), largest_coordinate);
}

template <class F>
struct SlabLanes {
  F near, far; // the ray is in the box for near <= t <= far; a miss when near > far
};

// near_* and far_* are the planes that the ray meets first and last per axis. The running bound goes second:
// max and min return their second operand when the slab is NaN (0 * infinity: a ray in a face's plane), so
// such an axis does not cull.
template <class F>
FASTRT_INLINE SlabLanes<F> intersect_slabs(const SlabAxis<F>& x, const SlabAxis<F>& y, const SlabAxis<F>& z,
                                           const V3<F>& near_planes, const V3<F>& far_planes, const F& t_min,
                                           const F& t_max) {
  const F nx = (near_planes.x - x.near_origin) * x.inverse;
  const F ny = (near_planes.y - y.near_origin) * y.inverse;
  const F nz = (near_planes.z - z.near_origin) * z.inverse;
  const F fx = (far_planes.x - x.far_origin) * x.inverse;
  const F fy = (far_planes.y - y.far_origin) * y.inverse;
  const F fz = (far_planes.z - z.far_origin) * z.inverse;
  const F near = max(nx, max(ny, max(nz, t_min)));
  const F far = min(fx, min(fy, min(fz, t_max)));
  return {near, far * F(slab_factor)};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
