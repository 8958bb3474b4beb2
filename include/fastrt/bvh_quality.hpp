// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fastrt {

// How much work goes into the bounding volume hierarchy. It never changes an answer, only the time.
enum class BvhQuality {
  standard, // built fast; the largest subtrees are moved to better places where that gains much
  high,     // all of them, in every scene; for those who render long
};

} // namespace fastrt
