// SPDX-License-Identifier: Apache-2.0
// The order of a tile's pixels in a batch: groups of 4 x 4, and inside a group by 2 x 2, so that any aligned
// run of 4, 8 or 16 rays is compact.
#pragma once

namespace fastrt {

[[gnu::always_inline]] static inline constexpr int tile_pixel_x(int i) {
  return (i >> 4 & 3) * 4 + ((i & 1) | (i >> 1 & 2));
}
[[gnu::always_inline]] static inline constexpr int tile_pixel_y(int i) {
  return (i >> 6 & 3) * 4 + ((i >> 1 & 1) | (i >> 2 & 2));
}

} // namespace fastrt
