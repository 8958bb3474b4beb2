// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace fastrt {

// How the samples of a pixel are spread and weighed: over the pixel's own square; as a tent two pixels wide;
// as a bell (deviation 0.5 pixels, cut off at 1.5); or as Mitchell & Netravali's with B = C = 1/3, which
// sharpens.
enum class PixelFilter { box, tent, gaussian, mitchell };

// What a scene file asks of the rendering beside the size: RenderSettings of these names. What has no value
// is not said.
struct PictureSettings {
  std::optional<int> samples_per_pixel, most_samples, light_samples, max_depth;
  std::optional<PixelFilter> filter;
  std::optional<std::uint32_t> seed;
  std::optional<float> adaptive, min_contribution;
};

} // namespace fastrt
