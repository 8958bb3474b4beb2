// SPDX-License-Identifier: Apache-2.0
// Filters and adaptive sampling: what they make of an edge, and where the samples go.
#include "tests/golden/pictures.hpp"

#include <fastrt/error.hpp>

namespace fastrt::test {
namespace {

class Sampling : public Picture {};

// White right of the image column `column`, black left of it; seen by 40 x 9 pixels.
SceneBuilder edge_at(double column) {
  SceneBuilder builder;
  const double width = 2 * std::tan(20 * std::numbers::pi / 180) * 5 / 9; // of a pixel, at z = 0
  add_quad(builder, {static_cast<float>((column - 20) * width), -20, 0}, {60, 0, 0}, {0, 40, 0},
           builder.add_material(glowing(Vec3(1.0F))));
  return builder;
}

double weight(PixelFilter filter, double x) {
  x = std::fabs(x);
  switch (filter) {
  case PixelFilter::box:
    return x < 0.5 ? 1 : 0;
  case PixelFilter::tent:
    return std::max(0.0, 1 - x);
  case PixelFilter::gaussian:
    return x < 1.5 ? std::exp(-x * x / 0.5) : 0;
  default:
    if (x < 1) return (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6;
    return x < 2 ? (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6 : 0;
  }
}

// The filter's share right of `x`.
double share_beyond(PixelFilter filter, double x) {
  double all = 0, beyond = 0;
  for (double s = -2.0005; s < 2; s += 0.001) {
    all += weight(filter, s);
    if (s > x) beyond += weight(filter, s);
  }
  return beyond / all;
}

TEST_P(Sampling, FiltersSpreadAnEdgeAsTheyAreDefined) {
  for (const PixelFilter filter :
       {PixelFilter::box, PixelFilter::tent, PixelFilter::gaussian, PixelFilter::mitchell}) {
    SceneBuilder builder = edge_at(20.25);
    RenderSettings settings = settings_of(40, 9);
    settings.samples_per_pixel = 256;
    settings.filter = filter;
    const Frame frame = render(builder, Camera{}, settings);
    for (int x = 15; x < 26; ++x) {
      const double expected = std::max(0.0, share_beyond(filter, 20.25 - (x + 0.5))); // light is not negative
      for (int y = 0; y < 9; ++y)
        EXPECT_NEAR(color_at(frame, x, y).x, expected, 0.012) << static_cast<int>(filter) << ' ' << x;
    }
  }
}

TEST_P(Sampling, AdaptiveSpendsSamplesAtEdgesAlone) {
  SceneBuilder builder = edge_at(20.25);
  RenderSettings settings = settings_of(40, 9);
  settings.samples_per_pixel = 4;
  settings.most_samples = 20;
  settings.adaptive = 0.05F;
  settings.filter = PixelFilter::box;
  const Frame frame = render(builder, Camera{}, settings);
  ASSERT_EQ(frame.samples.size(), 360U);
  std::uint64_t samples = 0;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 40; ++x) {
      const int count = frame.samples[static_cast<std::size_t>(40 * y + x)];
      samples += static_cast<std::uint64_t>(count);
      // The edge is in column 20; its neighbours differ from it.
      EXPECT_EQ(count, x >= 19 && x <= 21 ? 20 : 4) << x << ',' << y;
      EXPECT_NEAR(color_at(frame, x, y).x, x < 20 ? 0.0 : x > 20 ? 1.0 : 0.75, 0.08);
    }
  EXPECT_EQ(frame.rays.primary, samples);
}

TEST_P(Sampling, AdaptiveLooksAtTheRowsAboveAndBelow) {
  SceneBuilder builder = edge_at(20); // x = 0
  Camera camera;
  camera.up = {1, 0, 0};
  RenderSettings settings = settings_of(9, 40);
  settings.samples_per_pixel = 4;
  settings.most_samples = 16;
  settings.adaptive = 0.05F;
  settings.filter = PixelFilter::box;
  const Frame frame = render(builder, camera, settings);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 9; ++x)
      EXPECT_EQ(frame.samples[static_cast<std::size_t>(9 * y + x)], y == 19 || y == 20 ? 16 : 4)
          << x << ',' << y;
}

// What counts is the difference of square roots: dark steps are seen where bright ones of that size are not.
TEST_P(Sampling, AdaptiveSeesDarkStepsBetter) {
  for (const bool dark : {true, false}) {
    SceneBuilder builder;
    const float low = dark ? 0.0F : 0.81F;
    add_quad(builder, {0, -20, 0}, {60, 0, 0}, {0, 40, 0},
             builder.add_material(glowing(Vec3(low + (dark ? 0.01F : 0.07F)))));
    builder.set_background(Vec3(low));
    RenderSettings settings = settings_of(40, 9);
    settings.samples_per_pixel = 4;
    settings.adaptive = 0.05F;
    settings.filter = PixelFilter::box;
    const Frame frame = render(builder, Camera{}, settings);
    EXPECT_EQ(frame.samples[40 * 4 + 19] > 4, dark);
    EXPECT_EQ(frame.samples[40 * 4 + 20] > 4, dark);
  }
}

TEST_P(Sampling, AdaptiveDoublesItsSamples) {
  SceneBuilder builder;
  add_quad(builder, {-6.5F, -20, 0}, {60, 0, 0}, {13, 40, 0}, builder.add_material(glowing(Vec3(1.0F))));
  RenderSettings settings = settings_of(40, 40);
  settings.samples_per_pixel = 2;
  settings.most_samples = 64;
  settings.adaptive = 0.3F;
  const Frame frame = render(builder, Camera{}, settings);
  int between = 0;
  for (const int count : frame.samples) {
    EXPECT_TRUE(count == 2 || count == 4 || count == 8 || count == 16 || count == 32 || count == 64) << count;
    between += count > 4 && count < 64 ? 1 : 0;
  }
  EXPECT_GT(between, 0);
}

// All pixels refined to the end are as if they had been asked for so many samples.
TEST_P(Sampling, AdaptiveSamplesAreTheFirstOnesOfMany) {
  for (const PixelFilter filter : {PixelFilter::tent, PixelFilter::mitchell}) {
    SceneBuilder builder = edge_at(19.8), same = edge_at(19.8);
    RenderSettings settings = settings_of(40, 9);
    settings.filter = filter;
    settings.samples_per_pixel = 32;
    const Frame all = render(builder, Camera{}, settings);
    settings.samples_per_pixel = 2;
    settings.most_samples = 32;
    settings.adaptive = 0.01F;
    const Frame adaptive = render(same, Camera{}, settings);
    int refined = 0;
    for (std::size_t i = 0; i < 360; ++i) {
      if (adaptive.samples[i] != 32) continue;
      ++refined;
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) EXPECT_EQ(adaptive.rgb[c], all.rgb[c]);
    }
    EXPECT_GT(refined, 9);
  }
}

TEST_P(Sampling, WhatMakesNoSenseIsRefused) {
  for (const float threshold : {-0.1F, 1.5F, std::nanf("")}) {
    SceneBuilder builder = edge_at(3);
    RenderSettings settings = settings_of(8, 8);
    settings.adaptive = threshold;
    EXPECT_THROW(render(builder, Camera{}, settings), UsageError);
  }
  SceneBuilder builder = edge_at(3);
  RenderSettings settings = settings_of(8, 8);
  settings.samples_per_pixel = 4;
  settings.most_samples = 3;
  EXPECT_THROW(render(builder, Camera{}, settings), UsageError);
}

FASTRT_PICTURES(Sampling);

} // namespace
} // namespace fastrt::test
