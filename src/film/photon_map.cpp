// SPDX-License-Identifier: Apache-2.0
#include "src/film/photon_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace fastrt {
namespace {

// How many photons the middle one of them finds within the radius.
constexpr double wanted_photons = 100;
// Cells along the longest side, at most.
constexpr float most_cells = 1000;

float longest(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

struct Cell {
  std::int32_t x, y, z;
  auto key() const { return std::tuple(z, y, x); }
};

Cell cell_of(const Vec3& point, const Vec3& low, float inverse_side) {
  const Vec3 at = (point - low) * inverse_side;
  return {static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y), static_cast<std::int32_t>(at.z)};
}

// How many photons the median photon shares a cell with.
double median_neighbours(const std::vector<Photon>& photons, const Vec3& low, float side) {
  std::vector<std::uint64_t> keys;
  keys.reserve(photons.size());
  for (const Photon& photon : photons) {
    const Cell cell = cell_of(photon.point, low, 1.0F / side);
    keys.push_back((static_cast<std::uint64_t>(cell.z) << 40U) | (static_cast<std::uint64_t>(cell.y) << 20U) |
                   static_cast<std::uint64_t>(cell.x));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> counts;
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    while (end < keys.size() && keys[end] == keys[begin]) ++end;
    counts.insert(counts.end(), end - begin, static_cast<std::uint32_t>(end - begin));
  }
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  return *middle;
}

// From the density around the median photon: half of them lie closer together.
float choose_radius(const std::vector<Photon>& photons, const Aabb& bounds) {
  const float extent = longest(bounds.extent());
  if (!(extent > 0.0F)) return 1e-3F * std::max(1.0F, longest(glm::abs(bounds.lower)));
  float side = extent / 256;
  double neighbours = median_neighbours(photons, bounds.lower, side);
  while (neighbours < 16 && side < extent / 10) {
    side *= 2;
    neighbours = median_neighbours(photons, bounds.lower, side);
  }
  const double density = neighbours / (static_cast<double>(side) * static_cast<double>(side));
  const double radius = std::sqrt(wanted_photons / (std::numbers::pi * density));
  return std::min(static_cast<float>(radius), extent / 16);
}

void set_grid(PhotonMap& map) {
  const float side = std::max(1.0625F * map.radius, longest(map.bounds.extent()) / most_cells);
  map.inverse_side = 1.0F / side;
  const Cell last = cell_of(map.bounds.upper, map.bounds.lower, map.inverse_side);
  map.size_x = last.x + 1;
  map.size_y = last.y + 1;
  map.size_z = last.z + 1;
}

void sort_photons(const PhotonMap& map, std::vector<Photon>& photons) {
  const auto order = [&](const Photon& p) {
    return std::tuple(cell_of(p.point, map.bounds.lower, map.inverse_side).key(), p.light, p.index, p.key,
                      p.point.x, p.point.y, p.point.z);
  };
  std::sort(photons.begin(), photons.end(),
            [&](const Photon& a, const Photon& b) { return order(a) < order(b); });
}

void fill_columns(const std::vector<Photon>& photons, PhotonMap& map) {
  const auto column = [&](std::vector<float>& to, Vec3 Photon::*member, int axis) {
    to.reserve(photons.size() + photon_padding);
    for (const Photon& photon : photons) to.push_back((photon.*member)[axis]);
    to.insert(to.end(), photon_padding, std::numeric_limits<float>::quiet_NaN());
  };
  std::vector<float>* const columns[] = {&map.x,        &map.y, &map.z, &map.normal_x, &map.normal_y,
                                         &map.normal_z, &map.r, &map.g, &map.b};
  Vec3 Photon::*const members[] = {&Photon::point, &Photon::normal, &Photon::flux};
  for (int i = 0; i < 9; ++i) column(*columns[i], members[i / 3], i % 3);
}

void fill_rows(const std::vector<Photon>& photons, PhotonMap& map) {
  const auto rows = static_cast<std::size_t>(map.size_y) * static_cast<std::size_t>(map.size_z);
  map.row_begin.assign(rows + 1, 0);
  map.cell_x.reserve(photons.size());
  for (const Photon& photon : photons) {
    const Cell cell = cell_of(photon.point, map.bounds.lower, map.inverse_side);
    map.cell_x.push_back(cell.x);
    ++map.row_begin[static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(map.size_y) +
                    static_cast<std::size_t>(cell.y) + 1];
  }
  for (std::size_t row = 0; row < rows; ++row) map.row_begin[row + 1] += map.row_begin[row];
}

bool usable(const Photon& p) {
  const Vec3 sum = p.point + p.normal + p.flux;
  return std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z);
}

} // namespace

PhotonMap make_photon_map(std::vector<Photon> photons, std::uint64_t count, float radius) {
  std::erase_if(photons, [](const Photon& photon) { return !usable(photon); });
  PhotonMap map;
  if (photons.empty()) return map;
  for (const Photon& photon : photons) map.bounds.extend(photon.point);
  // Points are no finer than this.
  const float least = 1e-6F * longest(glm::max(glm::abs(map.bounds.lower), glm::abs(map.bounds.upper)));
  map.radius = std::max(radius > 0.0F ? radius : choose_radius(photons, map.bounds), least);
  map.radius2 = map.radius * map.radius;
  map.inverse_radius2 = 1.0F / map.radius2;
  map.scale = static_cast<float>(2.0 / (std::numbers::pi * static_cast<double>(map.radius2)) /
                                 static_cast<double>(count));
  set_grid(map);
  sort_photons(map, photons);
  fill_columns(photons, map);
  fill_rows(photons, map);
  return map;
}

} // namespace fastrt
