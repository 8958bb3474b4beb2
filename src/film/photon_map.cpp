// SPDX-License-Identifier: Apache-2.0
#include "src/film/photon_map.hpp"

#include "src/film/photon_radii.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace fastrt {
namespace {

// Cells along the longest side, at most.
constexpr float most_cells = 1000;

float longest(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

struct Cell {
  std::int32_t x, y, z;
};

Cell cell_of(const Vec3& point, const PhotonLevel& level) {
  const Vec3 at = (point - level.bounds.lower) * level.inverse_side;
  return {static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y), static_cast<std::int32_t>(at.z)};
}

void set_grid(const std::vector<Photon>& photons, float radius, PhotonLevel& level) {
  for (const Photon& photon : photons) level.bounds.extend(photon.point);
  // Points are no finer than this.
  const float least = 1e-6F * longest(glm::max(glm::abs(level.bounds.lower), glm::abs(level.bounds.upper)));
  level.radius = std::max(radius, least);
  level.radius2 = level.radius * level.radius;
  level.inverse_radius2 = 1.0F / level.radius2;
  level.height2 = level.radius2 * 0.0625F;
  const float side = std::max(1.0625F * level.radius, longest(level.bounds.extent()) / most_cells);
  level.inverse_side = 1.0F / side;
  const Cell last = cell_of(level.bounds.upper, level);
  level.size_x = last.x + 1;
  level.size_y = last.y + 1;
  level.size_z = last.z + 1;
}

void sort_photons(const PhotonLevel& level, std::vector<Photon>& photons) {
  const auto order = [&](const Photon& p) {
    const Cell cell = cell_of(p.point, level);
    return std::tuple(cell.z, cell.y, cell.x, p.light, p.index, p.key, p.point.x, p.point.y, p.point.z);
  };
  std::sort(photons.begin(), photons.end(),
            [&](const Photon& a, const Photon& b) { return order(a) < order(b); });
}

void fill_columns(const std::vector<Photon>& photons, PhotonLevel& level) {
  const auto column = [&](std::vector<float>& to, Vec3 Photon::*member, int axis) {
    to.reserve(photons.size() + photon_padding);
    for (const Photon& photon : photons) to.push_back((photon.*member)[axis]);
    to.insert(to.end(), photon_padding, std::numeric_limits<float>::quiet_NaN());
  };
  std::vector<float>* const columns[] = {&level.x,        &level.y,        &level.z,
                                         &level.normal_x, &level.normal_y, &level.normal_z,
                                         &level.r,        &level.g,        &level.b};
  Vec3 Photon::*const members[] = {&Photon::point, &Photon::normal, &Photon::flux};
  for (int i = 0; i < 9; ++i) column(*columns[i], members[i / 3], i % 3);
}

void fill_rows(const std::vector<Photon>& photons, PhotonLevel& level) {
  const auto rows = static_cast<std::size_t>(level.size_y) * static_cast<std::size_t>(level.size_z);
  level.row_begin.assign(rows + 1, 0);
  level.cell_x.reserve(photons.size());
  for (const Photon& photon : photons) {
    const Cell cell = cell_of(photon.point, level);
    level.cell_x.push_back(cell.x);
    ++level.row_begin[static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(level.size_y) +
                      static_cast<std::size_t>(cell.y) + 1];
  }
  for (std::size_t row = 0; row < rows; ++row) level.row_begin[row + 1] += level.row_begin[row];
}

PhotonLevel make_level(std::vector<Photon> photons, std::uint64_t count, float radius) {
  PhotonLevel level;
  set_grid(photons, radius, level);
  const auto scale = static_cast<float>(2.0 / (std::numbers::pi * static_cast<double>(level.radius2)) /
                                        static_cast<double>(count));
  for (Photon& photon : photons) photon.flux *= scale;
  sort_photons(level, photons);
  fill_columns(photons, level);
  fill_rows(photons, level);
  return level;
}

bool usable(const Photon& p, const Aabb& reach) {
  const Vec3 sum = p.point + p.normal + p.flux;
  if (!std::isfinite(sum.x) || !std::isfinite(sum.y) || !std::isfinite(sum.z)) return false;
  return glm::clamp(p.point, reach.lower, reach.upper) == p.point;
}

} // namespace

PhotonMap make_photon_map(std::vector<Photon> photons, std::uint64_t count, float radius, const Aabb& reach) {
  std::erase_if(photons, [&](const Photon& photon) { return !usable(photon, reach); });
  PhotonMap map;
  if (photons.empty()) return map;
  if (radius > 0.0F) {
    map.levels.push_back(make_level(std::move(photons), count, radius));
    return map;
  }
  Aabb bounds;
  for (const Photon& photon : photons) bounds.extend(photon.point);
  const PhotonRadii radii = choose_radii(photons, bounds);
  std::vector<std::vector<Photon>> by_level(photon_radii);
  for (std::size_t i = 0; i < photons.size(); ++i) by_level[radii.level[i]].push_back(photons[i]);
  for (int i = 0; i < photon_radii; ++i) {
    std::vector<Photon>& of_level = by_level[static_cast<std::size_t>(i)];
    if (!of_level.empty())
      map.levels.push_back(make_level(std::move(of_level), count, std::ldexp(radii.widest, -i)));
  }
  return map;
}

} // namespace fastrt
