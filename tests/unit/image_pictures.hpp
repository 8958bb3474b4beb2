// SPDX-License-Identifier: Apache-2.0
// Pictures for the tests of the image writers.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace fastrt {

struct TestPicture {
  std::string name;
  int width, height;
  std::vector<float> rgb;
};

// A shaded ball before a flat background, as renders look.
inline TestPicture ball_picture(int width, int height) {
  TestPicture picture{"ball", width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float dx = 2.2F * (static_cast<float>(x) + 0.5F) / static_cast<float>(width) - 1.1F;
      const float dy = 2.2F * (static_cast<float>(y) + 0.5F) / static_cast<float>(height) - 1.1F;
      const float d = dx * dx + dy * dy;
      const float light = d < 1 ? 0.1F + 0.8F * std::sqrt(1 - d) : 0.0F;
      for (const float colour : {0.8F, 0.5F, 0.3F}) picture.rgb.push_back(d < 1 ? colour * light : 0.035F);
    }
  return picture;
}

inline TestPicture flat_picture(int width, int height, float value) {
  const std::size_t count = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return {"flat", width, height, std::vector<float>(count, value)};
}

inline TestPicture noise_picture(int width, int height, float highest = 1.0F) {
  TestPicture picture = flat_picture(width, height, 0);
  picture.name = "noise";
  std::mt19937 random(static_cast<std::uint32_t>(width * 31 + height));
  for (float& value : picture.rgb) value = highest * static_cast<float>(random() >> 8U) * 0x1p-24F;
  return picture;
}

inline std::vector<TestPicture> test_pictures() {
  return {ball_picture(64, 48),         ball_picture(700, 300),         flat_picture(1, 1, 0.5F),
          flat_picture(300, 400, 0.2F), flat_picture(2, 1000, 1.0F),    noise_picture(1, 1),
          noise_picture(5, 3),          noise_picture(513, 257),        noise_picture(20000, 3),
          noise_picture(2, 5000),       noise_picture(200, 200, 0.001F)};
}

} // namespace fastrt
