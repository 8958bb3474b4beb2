// SPDX-License-Identifier: Apache-2.0
// Linear light to 8-bit sRGB.
#pragma once

#include <cstddef>

namespace fastrt {

// codes[i] = round(255 * srgb(clamp(linear[i], 0, 1))), rounded correctly; 0 for NaN.
void to_srgb8(const float* linear, std::size_t count, unsigned char* codes) noexcept;

// The linear light that `code` stands for: to_srgb8 gives the code back.
float linear_of_srgb8(unsigned char code) noexcept;

} // namespace fastrt
