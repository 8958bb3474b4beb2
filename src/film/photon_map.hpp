// SPDX-License-Identifier: Apache-2.0
// The photons of caustics, put in order for both paths.
#pragma once

#include <fastrt/math.hpp>

#include <cstdint>
#include <vector>

namespace fastrt {

// What a photon leaves on a surface.
struct Photon {
  Vec3 point;
  Vec3 normal; // geometric, on the side that the photon came from
  Vec3 flux;
  std::uint32_t light, index; // where it came from: the row of the plan, and its number there
  std::uint32_t key;          // the way it took
};

// Columns of floats have so many rows more, which hold NaN.
inline constexpr std::size_t photon_padding = 16;

// Photons whose light is spread over disks of one radius, as columns, in the order in which it is added up:
// by the cell of a grid (z, y, then x), then by where they came from.
struct PhotonLevel {
  std::vector<float> x, y, z, normal_x, normal_y, normal_z;
  std::vector<float> r, g, b; // the light in the middle of the disk: flux * 2 / (pi r^2), per photon sent out
  std::vector<std::int32_t> cell_x;
  // Row (y, z) of cells holds photons row_begin[z * size_y + y] .. row_begin[z * size_y + y + 1] - 1.
  std::vector<std::uint32_t> row_begin;
  int size_x = 0, size_y = 0, size_z = 0; // cells; their sides are longer than the radius
  Aabb bounds;
  float inverse_side = 0;
  float radius = 0, radius2 = 0, inverse_radius2 = 0;
  float height2 = 0; // of the disks: the square of how far off its plane a photon still counts

  std::size_t size() const noexcept { return cell_x.size(); }
};

// By radius, the widest first. A surface adds up all levels.
struct PhotonMap {
  std::vector<PhotonLevel> levels;
};

// count: how many photons were sent out. radius: of all photons; 0 gives each one that follows how many
// others are near. Photons outside of `reach` are left out: the cells of those that matter would grow with
// them.
PhotonMap make_photon_map(std::vector<Photon> photons, std::uint64_t count, float radius,
                          const Aabb& reach = {Vec3(-infinity), Vec3(infinity)});

} // namespace fastrt
