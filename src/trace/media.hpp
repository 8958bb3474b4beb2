// SPDX-License-Identifier: Apache-2.0
// The list of media that a ray is in: materials, the innermost first, -1 where there is none
// (docs/numerics.md, "Secondary rays").
#pragma once

#include "src/simd/lanes.hpp"
#include "src/trace/scene_view.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Crosses a surface of `material`: out of it if the list holds it, else into it.
FASTRT_INLINE void cross_medium(std::int32_t material, std::int32_t (&list)[max_media]) {
  int held_at = max_media - 1; // where nothing holds it, the outermost one makes room
  for (int k = max_media - 1; k >= 0; --k)
    if (list[k] == material) held_at = k;
  if (list[held_at] == material) {
    for (int k = held_at; k < max_media - 1; ++k) list[k] = list[k + 1];
    list[max_media - 1] = -1;
  } else {
    for (int k = max_media - 1; k > 0; --k) list[k] = list[k - 1];
    list[0] = material;
  }
}

FASTRT_INLINE bool is_medium(const MaterialRow& row) { return row.has_transmit != 0 && row.thin == 0; }

} // namespace fastrt::FASTRT_ISA_NAMESPACE
