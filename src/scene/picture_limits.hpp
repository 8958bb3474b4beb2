// SPDX-License-Identifier: Apache-2.0
// The ranges of what pictures are made of, for those who read settings and those who check them.
#pragma once

#include <cstdint>

namespace fastrt {

inline constexpr int most_pixels_a_side = 65536;
inline constexpr int most_samples_a_pixel = 65536; // that settings may ask for
inline constexpr int most_adaptive_samples = 16 * most_samples_a_pixel;
inline constexpr int most_light_samples = 1024; // shadow rays to a light with a size
inline constexpr int most_bounces = 64;
inline constexpr std::int64_t most_photons = std::int64_t{1} << 30;
inline constexpr std::int64_t most_caustic_photons = 100000000;

} // namespace fastrt
