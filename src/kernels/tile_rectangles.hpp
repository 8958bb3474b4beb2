// SPDX-License-Identifier: Apache-2.0
// The sieve between the rectangle of a sphere or shape and its test against 16 rays: the rays as points of
// the plane, one by one.
#pragma once

#include "src/kernels/tile_culling.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// One rectangle, for looking at single rays.
struct LoneRectangle {
  float x0, x1, y0, y1;
};

// Rectangles as columns.
struct StoredRectangles {
  alignas(32) float x0[leaf_lanes], x1[leaf_lanes], y0[leaf_lanes], y1[leaf_lanes];

  [[gnu::always_inline]] inline explicit StoredRectangles(const Rectangles<LeafF>& r) {
    r.x0.store_aligned(x0);
    r.x1.store_aligned(x1);
    r.y0.store_aligned(y0);
    r.y1.store_aligned(y1);
  }
  [[gnu::always_inline]] inline LoneRectangle of(int lane) const {
    return {x0[lane], x1[lane], y0[lane], y1[lane]};
  }
};

// The rays of group g in the rectangle. Groups' rectangles lie around their rays as these points, so what
// holds for a group holds for each ray. (Pencils' rays stray from their points; groups' rectangles are larger
// by that.)
template <class View>
FASTRT_INLINE std::uint32_t rays_in_rectangle(const View& /*view*/, const TilePoints& points,
                                              const LoneRectangle& r, int g) {
  if (View::strays) return (1U << group_size) - 1U;
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) {
    const PacketF x = PacketF::load_aligned(points.x + g * group_size + k),
                  y = PacketF::load_aligned(points.y + g * group_size + k);
    bits |= to_bits((x >= PacketF(r.x0)) & (x <= PacketF(r.x1)) & (y >= PacketF(r.y0)) & (y <= PacketF(r.y1)))
            << k;
  }
  return bits;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
