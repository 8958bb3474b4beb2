// SPDX-License-Identifier: Apache-2.0
#include "src/film/photon_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace fastrt {
namespace {

// The cell that a place lies in, on Morton's curve.
std::uint32_t cell_of(const SampleOffset& place) {
  const auto x = static_cast<std::uint32_t>((place.x + 1) * 0.5F * static_cast<float>(emission_side));
  const auto y = static_cast<std::uint32_t>((place.y + 1) * 0.5F * static_cast<float>(emission_side));
  std::uint32_t code = 0;
  for (std::uint32_t bit = 0; bit < emission_bits; ++bit)
    code |= (x >> bit & 1U) << (2 * bit) | (y >> bit & 1U) << (2 * bit + 1);
  return code;
}

TEST(PhotonSampling, EvenBits) {
  EXPECT_EQ(even_bits(0x55555555U), 0xFFFFU);
  EXPECT_EQ(even_bits(0xAAAAAAAAU), 0U);
  EXPECT_EQ(even_bits(0b010001U), 0b101U);
}

TEST(PhotonSampling, ActiveCellsShareThePhotonsEqually) {
  const std::vector<std::uint16_t> cells{3, 17, 18, 1000, 4095};
  for (const std::uint32_t seed : {0U, 7U}) {
    std::vector<int> counts(emission_side * emission_side, 0);
    constexpr std::uint32_t count = 5 * 64;
    for (std::uint32_t i = 0; i < count; ++i) {
      const SampleOffset place = photon_place(i, count, cells.data(), 5, photon_key(i, 2, seed));
      ASSERT_TRUE(place.x >= -1 && place.x < 1 && place.y >= -1 && place.y < 1);
      ++counts[cell_of(place)];
    }
    for (const std::uint16_t cell : cells) EXPECT_EQ(counts[cell], 64) << cell;
  }
}

// Within a cell too: 16 photons of one cell lie in 16 different sixteenths of it.
TEST(PhotonSampling, PhotonsSpreadWithinACell) {
  const std::uint16_t cell = 100;
  std::vector<int> counts(16, 0);
  for (std::uint32_t i = 0; i < 16; ++i) {
    const SampleOffset place = photon_place(i, 16, &cell, 1, photon_key(i, 0, 0));
    const float side = static_cast<float>(emission_side) * 0.5F;
    const auto x = static_cast<int>((place.x + 1) * side * 4) & 3;
    const auto y = static_cast<int>((place.y + 1) * side * 4) & 3;
    ++counts[static_cast<std::size_t>(4 * y + x)];
  }
  for (const int count : counts) EXPECT_EQ(count, 1);
}

TEST(PhotonSampling, TheLargestNumbersFit) {
  std::vector<std::uint16_t> cells;
  for (std::uint32_t i = 0; i < emission_side * emission_side; ++i)
    cells.push_back(static_cast<std::uint16_t>(i));
  constexpr std::uint32_t count = 1U << 30U;
  const auto cell_count = static_cast<std::uint32_t>(cells.size());
  EXPECT_EQ(cell_of(photon_place(0, count, cells.data(), cell_count, 1)), 0U);
  EXPECT_EQ(cell_of(photon_place(count - 1, count, cells.data(), cell_count, 1)), cell_count - 1);
  EXPECT_EQ(cell_of(photon_place(count / 2, count, cells.data(), cell_count, 1)), cell_count / 2);
}

TEST(PhotonSampling, CapsAreEvenlyCovered) {
  for (const float h : {0.1F, 1.0F, 2.0F}) {
    double sum = 0;
    constexpr int side = 100;
    for (int i = 0; i < side * side; ++i) {
      const SampleOffset place{static_cast<float>(i % side) * 0.02F - 0.99F,
                               static_cast<float>(i / side) * 0.02F - 0.99F};
      const LightPlace d = cap_direction(place, h);
      EXPECT_NEAR(d.x * d.x + d.y * d.y + d.z * d.z, 1, 1e-5F);
      ASSERT_TRUE(d.z >= 1 - h - 1e-5F && d.z <= 1);
      sum += static_cast<double>(d.z);
    }
    // Heights are as likely as each other.
    EXPECT_NEAR(sum / (side * side), 1 - 0.5 * static_cast<double>(h), 1e-3);
  }
}

TEST(PhotonSampling, ScatteredDirectionsFollowTheCosine) {
  double sum = 0, sum_x = 0, sum_y = 0;
  constexpr std::uint32_t count = 100000;
  for (std::uint32_t i = 0; i < count; ++i) {
    const LightPlace d = cosine_direction(photon_key(i, 0, 3));
    ASSERT_NEAR(d.x * d.x + d.y * d.y + d.z * d.z, 1, 1e-5F);
    ASSERT_GE(d.z, 0);
    sum += static_cast<double>(d.z), sum_x += static_cast<double>(d.x), sum_y += static_cast<double>(d.y);
  }
  EXPECT_NEAR(sum / count, 2.0 / 3, 3e-3);
  EXPECT_NEAR(sum_x / count, 0, 5e-3);
  EXPECT_NEAR(sum_y / count, 0, 5e-3);
}

// Half of them to each side; places that are evenly spread give the cosine's mean, 2/3.
TEST(PhotonSampling, MattSurfacesShineToBothSides) {
  double above = 0, below = 0, sum_x = 0, sum_y = 0;
  constexpr int side = 200;
  for (int i = 0; i < side * side; ++i) {
    const SampleOffset place{static_cast<float>(i % side) * 0.01F - 0.995F,
                             static_cast<float>(i / side) * 0.01F - 0.995F};
    const LightPlace d = matt_direction(place);
    ASSERT_NEAR(d.x * d.x + d.y * d.y + d.z * d.z, 1, 1e-5F);
    ASSERT_EQ(std::signbit(d.z), place.x < 0.0F);
    (d.z < 0.0F ? below : above) += static_cast<double>(d.z);
    sum_x += static_cast<double>(d.x), sum_y += static_cast<double>(d.y);
  }
  constexpr double half = side * side / 2;
  EXPECT_NEAR(above / half, 2.0 / 3, 1e-3);
  EXPECT_NEAR(below / half, -2.0 / 3, 1e-3);
  EXPECT_NEAR(sum_x / half, 0, 1e-3);
  EXPECT_NEAR(sum_y / half, 0, 1e-3);
}

TEST(PhotonSampling, TurnsHaveNumbersOfTheirOwn) {
  const std::uint32_t key = photon_key(1, 2, 3);
  const std::uint32_t a = next_photon_key(key, PhotonTurn::reflected);
  const std::uint32_t b = next_photon_key(key, PhotonTurn::refracted);
  const std::uint32_t c = next_photon_key(key, PhotonTurn::scattered);
  EXPECT_TRUE(a != b && b != c && a != c && a != key);
  EXPECT_NE(photon_key(1, 2, 3), photon_key(2, 1, 3));
  EXPECT_NE(photon_key(1, 2, 3), photon_key(1, 2, 4));
}

} // namespace
} // namespace fastrt
