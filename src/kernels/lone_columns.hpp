// SPDX-License-Identifier: Apache-2.0
// What rays that go alone need of themselves to meet boxes and to sieve triangles, as columns: made for a
// group of 16 at once, a register at a time, when the first of them goes alone.
//
// The shear: Woop, Benthin & Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
#pragma once

#include "src/kernels/leaf_lanes.hpp"
#include "src/kernels/slab.hpp"
#include "src/trace/ray_batch.hpp"

#include <cstddef>

namespace fastrt::FASTRT_ISA_NAMESPACE {

using PacketF = Floats<widest>;
using PacketI = Ints<widest>;
using PacketM = Mask<widest>;

// Lanes that hold one of the `left` rays that are left, and one that can be traced.
FASTRT_INLINE PacketM traceable_lanes(const V3<PacketF>& origins, const V3<PacketF>& dirs, int left) {
  return are_traceable(origins, dirs) & from_bits<widest>(lanes_in(left));
}

// Boxes are met as if larger by this share of the largest coordinate: what is left of it beyond the reach of
// primitives covers the rounding of starts that are multiplied out.
inline constexpr float lone_padding = 2.0F * box_padding;
// Directions are met as if no component were smaller than this share of the largest one. It moves the ray by
// far less than the padding, and spares the axes along which it does not move 0 * infinity.
inline constexpr float least_slope = 0x1p-40F;
// Rounding of sheared corners and of the exact test, and that one's tolerance, as a share of the triangle's
// size times the largest coordinate: together below 2^-16.
inline constexpr float sieve_margin = 0x1p-15F;
// Numbers larger than this or smaller than its inverse are not sieved: products must neither overflow nor
// vanish.
inline constexpr float sieve_limit = 1e12F;

// Of one ray (F: float, I: an integer), or of a batch (arrays of them).
template <class F, class I>
struct LoneFields {
  // A plane lies at plane * inverse - start, as the ray meets boxes' near and far planes.
  F inverse[3], near_start[3], far_start[3];
  // Where the planes that the ray meets first lie among a node's columns, in floats; the others: ^ 8.
  I near_planes[3], far_planes[3];
  // The axes across the one that the ray follows most, and that one: as a block's columns, in floats.
  I across_x, across_y, along;
  F slope_x, slope_y; // the ray in space sheared along itself ..
  F at_x, at_y;       // .. where it is a point
  F margin;           // per size of a triangle; infinity: no sieve
};

struct alignas(64) LoneColumns : LoneFields<float[batch_size], std::int32_t[batch_size]> {
  std::uint32_t ready; // bit g: group g is made
};

using LoneNumbers = LoneFields<float, std::ptrdiff_t>;

// Together, so that a ray under way keeps few lines of the cache busy.
FASTRT_INLINE void copy_ray(const LoneColumns& from, std::ptrdiff_t i, LoneNumbers& to) {
  for (int axis = 0; axis < 3; ++axis) {
    to.inverse[axis] = from.inverse[axis][i];
    to.near_start[axis] = from.near_start[axis][i];
    to.far_start[axis] = from.far_start[axis][i];
    to.near_planes[axis] = from.near_planes[axis][i];
    to.far_planes[axis] = from.near_planes[axis][i] ^ wide_children;
  }
  to.across_x = from.across_x[i];
  to.across_y = from.across_y[i];
  to.along = from.along[i];
  to.slope_x = from.slope_x[i];
  to.slope_y = from.slope_y[i];
  to.at_x = from.at_x[i];
  to.at_y = from.at_y[i];
  to.margin = from.margin[i];
}

FASTRT_INLINE void prepare_axis(LoneColumns& c, int axis, int i, const PacketF& origin, const PacketF& dir,
                                const PacketF& padding, const PacketF& least) {
  const PacketF sign = sign_bit(dir), pad = flip(padding, sign);
  const PacketF steep = select(abs(dir) < least, flip(least, sign), dir), inverse = PacketF(1.0F) / steep;
  const PacketF near_start = (origin + pad) * inverse, far_start = (origin - pad) * inverse;
  // Numbers that run out of range cull nothing on this axis but unused children, whose boxes are infinite.
  const PacketF none(__builtin_inff()), most(__FLT_MAX__);
  const PacketM plain = (abs(inverse) < none) & (abs(near_start) < none) & (abs(far_start) < none);
  select(plain, inverse, flip(PacketF(1e-30F), sign)).store_aligned(c.inverse[axis] + i);
  select(plain, near_start, most).store_aligned(c.near_start[axis] + i);
  select(plain, far_start, negate(most)).store_aligned(c.far_start[axis] + i);
  const PacketI lower(2 * axis * wide_children), upper((2 * axis + 1) * wide_children);
  simd::select(as_ints(sign) < PacketI(0), upper, lower).store_aligned(c.near_planes[axis] + i);
}

// size: of the numbers of the rays and of the boxes that they meet.
FASTRT_INLINE void prepare_axes(LoneColumns& c, int i, const V3<PacketF>& origin, const V3<PacketF>& dir,
                                const PacketF& size) {
  const PacketF padding = PacketF(lone_padding) * size, least = PacketF(least_slope) * largest(dir);
  prepare_axis(c, 0, i, origin.x, dir.x, padding, least);
  prepare_axis(c, 1, i, origin.y, dir.y, padding, least);
  prepare_axis(c, 2, i, origin.z, dir.z, padding, least);
}

FASTRT_INLINE void prepare_sieve(LoneColumns& c, int i, const V3<PacketF>& origin, const V3<PacketF>& dir,
                                 const PacketF& size) {
  const PacketF x = abs(dir.x), y = abs(dir.y), z = abs(dir.z);
  const PacketM is_x = (x > y) & (x > z), is_y = (y >= x) & (y > z), not_z = is_x | is_y;
  constexpr int column = 3 * block_size;
  const PacketI c0(0), c1(column), c2(2 * column);
  select_ints<PacketF>(is_x, c1, c0).store_aligned(c.across_x + i);
  select_ints<PacketF>(not_z, c2, c1).store_aligned(c.across_y + i);
  select_ints<PacketF>(is_x, c0, select_ints<PacketF>(is_y, c1, c2)).store_aligned(c.along + i);
  const PacketF step = select(is_x, dir.x, select(is_y, dir.y, dir.z)),
                begin = select(is_x, origin.x, select(is_y, origin.y, origin.z));
  const PacketF inverse = PacketF(1.0F) / step;
  const PacketF slope_x = select(is_x, dir.y, dir.x) * inverse,
                slope_y = select(not_z, dir.z, dir.y) * inverse;
  slope_x.store_aligned(c.slope_x + i);
  slope_y.store_aligned(c.slope_y + i);
  (select(is_x, origin.y, origin.x) - slope_x * begin).store_aligned(c.at_x + i);
  (select(not_z, origin.z, origin.y) - slope_y * begin).store_aligned(c.at_y + i);
  const PacketF most(sieve_limit), least(1.0F / sieve_limit);
  const PacketM plain = (size < most) & (size > least) & (abs(step) > least);
  select(plain, size * PacketF(sieve_margin), PacketF(__builtin_inff())).store_aligned(c.margin + i);
}

[[gnu::noinline]] static void prepare_group(LoneColumns& c, const RayBatch& rays, float largest_coordinate,
                                            int g) noexcept {
  for (int i = g * group_size; i < (g + 1) * group_size; i += widest) {
    const V3<PacketF> origin = load3<PacketF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    const V3<PacketF> dir = load3<PacketF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    const PacketF size = max(largest(origin), PacketF(largest_coordinate));
    prepare_axes(c, i, origin, dir, size);
    prepare_sieve(c, i, origin, dir, size);
  }
  c.ready |= 1U << g;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
