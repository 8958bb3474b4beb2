// SPDX-License-Identifier: Apache-2.0
#include "src/film/photon_map.hpp"
#include "src/film/photon_radii.hpp"
#include "src/reference/photons.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace fastrt {
namespace {

// On the plane y = 0: `dense` photons in a square of side 0.1, the others in one of side 4.
std::vector<Photon> photons_on_floor(int dense, int sparse) {
  std::mt19937 random(5);
  const auto within = [&](float side) {
    return (static_cast<float>(random() >> 8U) * 0x1p-24F - 0.5F) * side;
  };
  std::vector<Photon> photons;
  for (int i = 0; i < dense + sparse; ++i) {
    const float side = i < dense ? 0.1F : 4.0F;
    Photon photon{};
    photon.point = {within(side), 0, within(side)};
    photon.normal = {0, 1, 0};
    photon.flux = {1, 2, 3};
    photon.index = static_cast<std::uint32_t>(i);
    photons.push_back(photon);
  }
  return photons;
}

reference::Surface floor_at(float x, float z) {
  reference::Surface surface;
  surface.point = {x, 0, z};
  surface.geometric_normal = {0, 1, 0};
  return surface;
}

bool same(const PhotonMap& a, const PhotonMap& b) {
  if (a.levels.size() != b.levels.size()) return false;
  for (std::size_t i = 0; i < a.levels.size(); ++i) {
    const PhotonLevel &p = a.levels[i], &q = b.levels[i];
    const auto count = static_cast<std::ptrdiff_t>(p.size()); // beyond it there is NaN
    if (p.size() != q.size() || p.row_begin != q.row_begin || p.cell_x != q.cell_x) return false;
    if (!std::equal(p.x.begin(), p.x.begin() + count, q.x.begin()) ||
        !std::equal(p.z.begin(), p.z.begin() + count, q.z.begin()))
      return false;
  }
  return true;
}

TEST(PhotonMap, DoesNotDependOnTheOrderOfPhotons) {
  std::vector<Photon> photons = photons_on_floor(3000, 1000);
  const PhotonMap map = make_photon_map(photons, 4000, 0);
  EXPECT_GT(map.levels.size(), 1U);
  std::shuffle(photons.begin(), photons.end(), std::mt19937(1));
  EXPECT_TRUE(same(map, make_photon_map(photons, 4000, 0)));
}

// Photons are sorted by cells, and rows say where.
TEST(PhotonMap, RowsHoldTheirCells) {
  const PhotonMap map = make_photon_map(photons_on_floor(500, 500), 1000, 0.1F);
  ASSERT_EQ(map.levels.size(), 1U);
  const PhotonLevel& level = map.levels[0];
  EXPECT_EQ(level.radius, 0.1F);
  EXPECT_GT(level.size_z, 10);
  EXPECT_EQ(level.row_begin.back(), 1000U);
  for (std::size_t row = 0; row + 1 < level.row_begin.size(); ++row)
    for (std::uint32_t i = level.row_begin[row]; i < level.row_begin[row + 1]; ++i) {
      const auto z = static_cast<std::size_t>((level.z[i] - level.bounds.lower.z) * level.inverse_side);
      EXPECT_EQ(z, row / static_cast<std::size_t>(level.size_y));
      EXPECT_TRUE(i == level.row_begin[row] || level.cell_x[i - 1] <= level.cell_x[i]);
    }
  EXPECT_TRUE(std::isnan(level.x[1000 + photon_padding - 1]));
}

// What all points of the floor see together is what the photons bring.
TEST(PhotonMap, KeepsTheLight) {
  for (const float radius : {0.0F, 0.25F}) {
    const PhotonMap map = make_photon_map(photons_on_floor(2000, 2000), 4000, radius);
    double sum = 0;
    constexpr int side = 120;
    for (int i = 0; i < side * side; ++i) {
      const float x = static_cast<float>(i % side) / side * 6 - 3,
                  z = static_cast<float>(i / side) / side * 6 - 3;
      if (map.levels.size() > 1 && std::fabs(x) < 0.3F && std::fabs(z) < 0.3F)
        continue; // too fine for this grid
      sum += static_cast<double>(reference::caustic_light(map, floor_at(x, z)).x) * 36.0 / side / side;
    }
    const double expected = map.levels.size() > 1 ? 0.5 * (1 - 0.36 / 16) : 1;
    EXPECT_NEAR(sum, expected, 0.03) << radius;
  }
}

TEST(PhotonMap, RadiiFollowTheDensity) {
  const std::vector<Photon> photons = photons_on_floor(4000, 1000);
  Aabb bounds;
  for (const Photon& photon : photons) bounds.extend(photon.point);
  const PhotonRadii radii = choose_radii(photons, bounds);
  double dense = 0, sparse = 0;
  for (std::size_t i = 0; i < photons.size(); ++i) (i < 4000 ? dense : sparse) += radii.level[i];
  EXPECT_GT(dense / 4000, sparse / 1000 + 2);
  EXPECT_NEAR(radii.widest, 4.0 / 8 / std::sqrt(3.14159), 0.01);
}

// Other surfaces stay dark: those that look away, and those beside the photons' plane.
TEST(PhotonMap, LightStaysOnItsSurface) {
  const PhotonMap map = make_photon_map(photons_on_floor(0, 4000), 4000, 0.5F);
  EXPECT_GT(reference::caustic_light(map, floor_at(0, 0)).y, 0.05F);
  reference::Surface other = floor_at(0, 0);
  other.geometric_normal = {0, -1, 0};
  EXPECT_EQ(reference::caustic_light(map, other), Vec3(0.0F));
  other.geometric_normal = {1, 0, 0};
  EXPECT_EQ(reference::caustic_light(map, other), Vec3(0.0F));
  other = floor_at(0, 0);
  other.point.y = 0.2F;
  EXPECT_EQ(reference::caustic_light(map, other), Vec3(0.0F));
}

// What lands far away leaves the others' radii as they are.
TEST(PhotonMap, FarPhotonsAreLeftOut) {
  std::vector<Photon> photons = photons_on_floor(500, 500);
  const PhotonMap map = make_photon_map(photons, 1000, 0);
  photons.push_back(photons[0]);
  photons.back().point.x = 1e6F;
  const Aabb reach{Vec3(-100.0F), Vec3(100.0F)};
  EXPECT_TRUE(same(map, make_photon_map(photons, 1000, 0, reach)));
  EXPECT_FALSE(same(map, make_photon_map(photons, 1000, 0)));
}

TEST(PhotonMap, OddPhotons) {
  EXPECT_TRUE(make_photon_map({}, 10, 0).levels.empty());
  std::vector<Photon> photons = photons_on_floor(1, 0);
  photons.push_back(photons[0]);
  photons[1].flux.x = std::numeric_limits<float>::infinity();
  for (const float radius : {0.0F, 1e-30F, 1e30F}) {
    const PhotonMap map = make_photon_map(photons, 10, radius);
    ASSERT_EQ(map.levels.size(), 1U);
    EXPECT_EQ(map.levels[0].size(), 1U);
    EXPECT_TRUE(std::isfinite(reference::caustic_light(map, floor_at(0, 0)).x));
  }
}

} // namespace
} // namespace fastrt
