// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace fastrt {

// The linear light that an sRGB code stands for, in float or double. code: its share of the largest one, 0 to
// 1.
template <class T>
T linear_of_srgb(T code) {
  return code <= T(0.04045) ? code / T(12.92) : std::pow((code + T(0.055)) / T(1.055), T(2.4));
}

} // namespace fastrt
