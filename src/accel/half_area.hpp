// SPDX-License-Identifier: Apache-2.0
// Half the area of boxes, in double: no box that floats can hold runs out of them, and sums stay exact
// enough.
#pragma once

#include <fastrt/math.hpp>

namespace fastrt {

inline double half_area(const float (&lower)[3], const float (&upper)[3]) {
  const double x = static_cast<double>(upper[0]) - static_cast<double>(lower[0]);
  const double y = static_cast<double>(upper[1]) - static_cast<double>(lower[1]);
  const double z = static_cast<double>(upper[2]) - static_cast<double>(lower[2]);
  return x * y + y * z + z * x;
}

// 0 of an empty box.
inline double half_area(const Aabb& box) {
  if (box.empty()) return 0;
  return half_area({box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z});
}

} // namespace fastrt
