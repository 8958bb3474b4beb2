// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fastrt {

// How much work goes into the bounding volume hierarchy. It never changes an answer, only the time.
enum class BvhQuality {
  standard, // built fast
  high,     // then made better by moving subtrees about; for those who render long
};

} // namespace fastrt
