// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/film/photon_map.hpp"
#include "src/film/photon_sampling.hpp"

namespace fastrt {

// Which of the radii suits each photon: level 0 is the widest, and each further one is half as wide. It
// follows from the cells of an octree, of which the smallest counts that still holds some tens of photons.
struct PhotonRadii {
  float widest;
  std::vector<std::uint8_t> level; // of each photon
};
PhotonRadii choose_radii(const std::vector<Photon>& photons, const Aabb& bounds);

} // namespace fastrt
