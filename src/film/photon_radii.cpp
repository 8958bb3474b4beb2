// SPDX-License-Identifier: Apache-2.0
#include "src/film/photon_radii.hpp"

#include <algorithm>

namespace fastrt {
namespace {

constexpr std::size_t wanted_photons = 60;
// The cells of level 0 divide the longest side by 2^3.
constexpr int first_bits = 3;
constexpr int finest_bits = first_bits + photon_radii - 1;

struct Placed {
  std::uint64_t code; // of the finest cell, on Morton's curve: a cell of any level is a run of photons
  std::uint32_t photon;
};

std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32U) & 0x1F00000000FFFFU;
  x = (x | x << 16U) & 0x1F0000FF0000FFU;
  x = (x | x << 8U) & 0x100F00F00F00F00FU;
  x = (x | x << 4U) & 0x10C30C30C30C30C3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

std::uint64_t code_of(const Vec3& point, const Vec3& low, float inverse_side) {
  constexpr float last = (1 << finest_bits) - 1;
  const Vec3 at = glm::min((point - low) * inverse_side, Vec3(last));
  const auto bits = [](float x) { return spread_bits(static_cast<std::uint64_t>(x)); };
  return bits(at.x) | bits(at.y) << 1U | bits(at.z) << 2U;
}

// Photons begin .. end - 1 lie in one cell of `level`; -1: in the box of all.
void assign(const std::vector<Placed>& placed, std::size_t begin, std::size_t end, int level,
            std::vector<std::uint8_t>& levels) {
  const int next = level + 1;
  const auto shift = static_cast<unsigned>(3 * (photon_radii - 1 - next));
  for (std::size_t first = begin, last = begin; first < end; first = last) {
    if (next < photon_radii)
      while (last < end && placed[last].code >> shift == placed[first].code >> shift) ++last;
    else
      last = end;
    if (next < photon_radii && last - first >= wanted_photons)
      assign(placed, first, last, next, levels);
    else
      for (std::size_t i = first; i < last; ++i)
        levels[placed[i].photon] = static_cast<std::uint8_t>(std::max(level, 0));
  }
}

} // namespace

PhotonRadii choose_radii(const std::vector<Photon>& photons, const Aabb& bounds) {
  const Vec3 extent = bounds.extent();
  const float longest = std::max(extent.x, std::max(extent.y, extent.z));
  PhotonRadii radii{1e-3F, std::vector<std::uint8_t>(photons.size(), 0)};
  if (!(longest > 0.0F)) return radii;
  // The disk of level 0 has the area of a cell's side.
  radii.widest = longest / (1 << first_bits) * 0.564189584F;
  const float inverse_side = (1 << finest_bits) / longest;
  std::vector<Placed> placed;
  placed.reserve(photons.size());
  for (std::size_t i = 0; i < photons.size(); ++i)
    placed.push_back({code_of(photons[i].point, bounds.lower, inverse_side), static_cast<std::uint32_t>(i)});
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.code < b.code; });
  assign(placed, 0, placed.size(), -1, radii.level);
  return radii;
}

} // namespace fastrt
