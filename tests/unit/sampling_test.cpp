// SPDX-License-Identifier: Apache-2.0
#include "src/film/filter_table.hpp"
#include "src/film/light_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace fastrt {
namespace {

SampleOffset sample(std::uint32_t index, PixelFilter filter, std::uint32_t seed = 0, std::uint32_t x = 3,
                    std::uint32_t y = 5) {
  return sample_offset(x, y, sample_set(index, filter_of(filter), seed));
}

TEST(Hash, IsOneToOneOnWhatItIsAsked) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < 100000; ++i) seen.insert(hash32(i));
  EXPECT_EQ(seen.size(), 100000U);
}

TEST(ReverseBits, TurnsTheWordAround) {
  EXPECT_EQ(reverse_bits(1), 0x80000000U);
  EXPECT_EQ(reverse_bits(0x80000000U), 1U);
  EXPECT_EQ(reverse_bits(0x00F0A001U), 0x80050F00U);
  for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(reverse_bits(reverse_bits(hash32(i))), hash32(i));
}

TEST(TentWarp, IsTheTentsInverse) {
  EXPECT_EQ(tent_warp(0.0F), -1.0F);
  EXPECT_EQ(tent_warp(0.5F), 0.0F);
  for (int i = 0; i < 1000; ++i) {
    const float u = static_cast<float>(i) / 1000;
    const float x = tent_warp(u);
    // The share of the tent's area left of x.
    const float area = x < 0 ? 0.5F * (1 + x) * (1 + x) : 1 - 0.5F * (1 - x) * (1 - x);
    EXPECT_NEAR(area, u, 1e-6F);
  }
}

double mitchell(double x) {
  x = std::fabs(x);
  if (x < 1) return (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6;
  return x < 2 ? (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6 : 0;
}

TEST(Samples, StayWithinTheirFilter) {
  const std::vector<std::pair<PixelFilter, float>> radii = {{PixelFilter::box, 0.5F},
                                                            {PixelFilter::tent, 1.0F},
                                                            {PixelFilter::gaussian, 1.5F},
                                                            {PixelFilter::mitchell, 2.0F}};
  for (const auto& [filter, radius] : radii)
    for (std::uint32_t i = 0; i < 64; ++i)
      for (std::uint32_t x = 0; x < 50; ++x) {
        const SampleOffset offset = sample(i, filter, 1, x, 7 * x);
        EXPECT_LE(std::fabs(offset.x), radius);
        EXPECT_LE(std::fabs(offset.y), radius);
      }
}

// A (0, 2)-sequence: 2^k samples, from any multiple of 2^k on, have one in each of all 2^k cells however the
// square is divided into equal ones.
TEST(Samples, AreSpreadOverEveryGrid) {
  for (const std::uint32_t bits : {1U, 2U, 4U, 6U})
    for (const std::uint32_t first : {0U, 1U << bits, 5U << bits})
      for (std::uint32_t across = 0; across <= bits; ++across) {
        std::set<std::pair<int, int>> cells;
        for (std::uint32_t i = first; i < first + (1U << bits); ++i) {
          const SampleOffset offset = sample(i, PixelFilter::box, 4, 17, 23);
          cells.emplace(static_cast<int>((offset.x + 0.5F) * static_cast<float>(1U << across)),
                        static_cast<int>((offset.y + 0.5F) * static_cast<float>(1U << (bits - across))));
        }
        EXPECT_EQ(cells.size(), 1U << bits) << first << ' ' << across;
      }
}

// The filter's weight left of x, by samples, is its integral.
TEST(Samples, AreSpreadAsTheirFilter) {
  constexpr std::uint32_t count = 4096;
  for (const PixelFilter kind : {PixelFilter::gaussian, PixelFilter::mitchell, PixelFilter::tent}) {
    const Filter filter = filter_of(kind);
    const SampleWeights weights = sample_weights(filter, count);
    double whole = 0;
    std::vector<double> integral;
    const auto f = [&](double x) {
      if (kind == PixelFilter::tent) return std::max(0.0, 1 - std::fabs(x));
      return kind == PixelFilter::mitchell ? mitchell(x) : std::fabs(x) < 1.5 ? std::exp(-2 * x * x) : 0.0;
    };
    for (double x = -2; x < 2; x += 0.001) integral.push_back(whole += 0.001 * f(x + 0.0005));
    for (const double x : {-1.5, -1.2, -0.8, -0.3, 0.0, 0.4, 1.0, 1.3}) {
      double found = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        const SampleOffset offset = sample(i, kind, 2);
        const double weight = in_lobe(filter, i) ? -double(weights.lobes) : double(weights.core);
        if (static_cast<double>(offset.x) < x) found += weight / 2;
        if (static_cast<double>(offset.y) < x) found += weight / 2;
      }
      EXPECT_NEAR(found, integral[static_cast<std::size_t>((x + 2) * 1000) - 1] / whole, 0.005)
          << static_cast<int>(kind) << ' ' << x;
    }
  }
}

TEST(SampleWeights, AddUpToOne) {
  for (const PixelFilter kind : {PixelFilter::box, PixelFilter::mitchell})
    for (const std::uint32_t count : {1U, 2U, 7U, 8U, 9U, 64U}) {
      const Filter filter = filter_of(kind);
      const std::uint32_t lobes = lobe_samples(filter, count);
      std::uint32_t found = 0;
      for (std::uint32_t i = 0; i < count; ++i) found += in_lobe(filter, i) ? 1 : 0;
      EXPECT_EQ(found, lobes);
      const SampleWeights weights = sample_weights(filter, count);
      EXPECT_NEAR(resolve_channel(weights, static_cast<float>(count - lobes), static_cast<float>(lobes)), 1,
                  1e-6F);
    }
  EXPECT_EQ(resolve_channel({1, 1}, 1, 2), 0.0F); // light is never negative
}

TEST(Samples, AverageToTheirCentre) {
  for (const PixelFilter filter : {PixelFilter::box, PixelFilter::tent, PixelFilter::gaussian}) {
    double x = 0;
    double y = 0;
    for (std::uint32_t pixel = 0; pixel < 400; ++pixel)
      for (std::uint32_t i = 0; i < 16; ++i) {
        const SampleOffset offset = sample(i, filter, 0, pixel % 20, pixel / 20);
        x += static_cast<double>(offset.x) / 6400;
        y += static_cast<double>(offset.y) / 6400;
      }
    EXPECT_NEAR(x, 0, 0.01);
    EXPECT_NEAR(y, 0, 0.01);
  }
}

TEST(Samples, DependOnPixelSeedAndIndexAlone) {
  const SampleOffset first = sample(3, PixelFilter::box);
  EXPECT_EQ(first.x, sample(3, PixelFilter::box).x);
  EXPECT_NE(first.x, sample(4, PixelFilter::box).x);
  EXPECT_NE(first.x, sample(3, PixelFilter::box, 1).x);
  EXPECT_NE(first.x, sample(3, PixelFilter::box, 0, 4, 5).x);
  EXPECT_NE(first.y, sample(3, PixelFilter::box, 0, 5, 3).y);
}

TEST(DiskPoint, CarriesAreasOver) {
  // A square ring between |max| = s and s + ds becomes a round one of the same share.
  for (int i = -20; i <= 20; ++i)
    for (int k = -20; k <= 20; ++k) {
      const float a = static_cast<float>(i) / 20, b = static_cast<float>(k) / 20;
      const SampleOffset p = disk_point(a, b);
      EXPECT_NEAR(std::hypot(p.x, p.y), std::max(std::fabs(a), std::fabs(b)), 1e-6F);
    }
  // And angles are spread evenly: an eighth of the square's side is that of the disk's edge.
  EXPECT_NEAR(disk_point(1, 0.5F).y, std::sin(std::numbers::pi / 8), 1e-6);
  EXPECT_NEAR(disk_point(0.5F, -1).y, -std::cos(std::numbers::pi / 8), 1e-6);
  EXPECT_NEAR(disk_point(-1, 1).x, -std::sqrt(0.5), 1e-6);
}

TEST(LensPoints, FillTheDiskEvenlyAndIndependently) {
  double x = 0, y = 0, inner = 0, with_pixel = 0;
  for (std::uint32_t pixel = 0; pixel < 200; ++pixel)
    for (std::uint32_t i = 0; i < 16; ++i) {
      const SampleSet set = sample_set(i, filter_of(PixelFilter::box), 3);
      const SampleOffset lens = lens_point(pixel % 20, pixel / 20, set);
      const SampleOffset offset = sample_offset(pixel % 20, pixel / 20, set);
      EXPECT_LE(std::hypot(lens.x, lens.y), 1.000001);
      x += static_cast<double>(lens.x) / 3200;
      y += static_cast<double>(lens.y) / 3200;
      inner += std::hypot(lens.x, lens.y) < std::sqrt(0.5F) ? 1.0 / 3200 : 0;
      with_pixel += static_cast<double>(lens.x) * static_cast<double>(offset.x) / 3200;
    }
  EXPECT_NEAR(x, 0, 0.02);
  EXPECT_NEAR(y, 0, 0.02);
  EXPECT_NEAR(inner, 0.5, 0.02);
  EXPECT_NEAR(with_pixel, 0, 0.01);
}

// One in each part of the light, in order, whoever asks: shadow rays of one number have much in common.
TEST(LightSamples, AreNumberedByTheirPlaceOnTheLight) {
  for (const std::uint32_t count : {1U, 2U, 7U, 16U, 1000U})
    for (std::uint32_t x = 0; x < 50; ++x)
      for (std::uint32_t i = 0; i < count; ++i) {
        const LightBits bits = light_bits({x, 3, 1, 0, 2, 9}, i, count);
        const double place = bits.u * 0x1p-32 * count;
        EXPECT_GE(place, i - 1e-3) << count;
        EXPECT_LE(place, i + 1 + 1e-3) << count;
      }
}

TEST(LightSamples, AreShiftedAtRandom) {
  std::set<std::uint32_t> along, across;
  for (std::uint32_t x = 0; x < 50; ++x) {
    const LightBits bits = light_bits({x, 3, 1, 0, 2, 9}, 5, 16);
    along.insert(bits.u);
    across.insert(bits.v >> 28U);
  }
  EXPECT_EQ(along.size(), 50U);
  EXPECT_GE(across.size(), 13U);
}

} // namespace
} // namespace fastrt
