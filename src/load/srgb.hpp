// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace fastrt {

// The linear light that an sRGB code stands for. code: its share of the largest one, 0 to 1.
inline float linear_of_srgb(float code) {
  return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F);
}

} // namespace fastrt
