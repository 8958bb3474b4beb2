// SPDX-License-Identifier: Apache-2.0
#include <fastrt/error.hpp>
#include <fastrt/texture.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace fastrt {
namespace {

Image grey_image(int width, int height, const std::vector<float>& greys) {
  std::vector<float> rgba;
  for (const float grey : greys) rgba.insert(rgba.end(), {grey, grey, grey, 1.0F});
  return {width, height, std::span<const float>(rgba)};
}

TEST(Image, CodesAreDecoded) {
  const std::vector<std::uint8_t> rgba{0, 128, 255, 51};
  const Image srgb(1, 1, rgba, true), data(1, 1, rgba, false);
  EXPECT_NEAR(srgb.pixel(0, 0, 0).g, 0.21586, 1e-5);
  EXPECT_EQ(srgb.pixel(0, 0, 0).b, 1.0F);
  EXPECT_EQ(srgb.pixel(0, 0, 0).a, 0.2F);
  EXPECT_EQ(data.pixel(0, 0, 0), glm::vec4(0.0F, 128.0F / 255, 1.0F, 0.2F));
  EXPECT_TRUE(srgb.has_alpha());
}

TEST(Image, NumbersThatMakeNoSenseBecomeZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> rgba{nan, infinity, -1.0F, 1.0F};
  EXPECT_EQ(Image(1, 1, std::span<const float>(rgba)).pixel(0, 0, 0), glm::vec4(0, 0, 0, 1));
}

TEST(Image, LevelsAreMeansOfTheArea) {
  const Image image = grey_image(4, 2, {1, 3, 5, 7, 1, 3, 5, 7});
  ASSERT_EQ(image.levels().size(), 3U);
  EXPECT_EQ(image.levels()[1].width, 2);
  EXPECT_EQ(image.levels()[1].height, 1);
  EXPECT_EQ(image.pixel(1, 0, 0).r, 2.0F);
  EXPECT_EQ(image.pixel(1, 1, 0).r, 6.0F);
  EXPECT_EQ(image.pixel(2, 0, 0).r, 4.0F);
}

// Three or five pixels become one or two; the mean of everything stays what it is.
TEST(Image, OddSidesKeepTheMean) {
  for (const int width : {3, 5, 7, 13}) {
    std::vector<float> greys;
    double sum = 0;
    for (int i = 0; i < 3 * width; ++i) {
      greys.push_back(static_cast<float>(i * i % 11));
      sum += greys.back();
    }
    const Image image = grey_image(width, 3, greys);
    EXPECT_NEAR(image.pixel(image.levels().size() - 1, 0, 0).r, sum / (3 * width), 1e-4) << width;
  }
}

TEST(Image, CodesOfLevelsAreTheNearest) {
  std::vector<std::uint8_t> rgba;
  for (const int code : {0, 255, 255, 0})
    rgba.insert(rgba.end(), 3, static_cast<std::uint8_t>(code)), rgba.push_back(255);
  const Image image(2, 2, rgba, true);
  EXPECT_EQ(image.bytes()[4 * 4], 188); // sRGB of 0.5
  EXPECT_EQ(image.bytes()[4 * 4 + 3], 255);
  EXPECT_FALSE(image.has_alpha());
}

// The nearest of 256 values; of two the greater one.
int nearest_code(const float* values, float x) {
  int best = 0;
  for (int code = 1; code < 256; ++code)
    if (std::abs(values[code] - x) <= std::abs(values[best] - x)) best = code;
  return best;
}

// Of all codes, dark ones above all, which lie closest together on the sRGB curve.
TEST(Image, CodesOfHalfLevelsAreTheNearestToTheirMeans) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> rgba(4 * 128 * 64);
  for (std::size_t i = 0; i < rgba.size(); ++i)
    rgba[i] = static_cast<std::uint8_t>(random() % (i % 3 == 0 ? 256 : i % 3 == 1 ? 12 : 60));
  for (const bool srgb : {true, false}) {
    const Image image(128, 64, rgba, srgb);
    for (std::size_t l = 1; l < image.levels().size() - 1; ++l) {
      const Image::Level& level = image.levels()[l];
      for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x) {
          const auto below = [&](int dx, int dy) { return image.pixel(l - 1, 2 * x + dx, 2 * y + dy); };
          const glm::vec4 mean =
              ((below(0, 0) * 0.25F + below(1, 0) * 0.25F) + below(0, 1) * 0.25F) + below(1, 1) * 0.25F;
          for (int c = 0; c < 4; ++c) {
            const std::size_t at = 4 * (level.first + static_cast<std::size_t>(y * level.width + x));
            ASSERT_EQ(image.bytes()[at + static_cast<std::size_t>(c)],
                      nearest_code(image.decoded().data() + (c == 3 ? 256 : 0), mean[c]))
                << srgb << ' ' << l << ' ' << x << ' ' << y << ' ' << c;
          }
        }
    }
  }
}

TEST(Image, SizesAreChecked) {
  const std::vector<std::uint8_t> four(4);
  EXPECT_THROW(Image(0, 1, {}, true), InputError);
  EXPECT_THROW(Image(1, max_image_side + 1, four, true), InputError);
  EXPECT_THROW(Image(2, 1, four, true), InputError);
  EXPECT_EQ(Image(1, max_image_side, std::vector<std::uint8_t>(4 * max_image_side), true).levels().size(),
            15U);
}

} // namespace
} // namespace fastrt
