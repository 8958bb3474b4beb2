// SPDX-License-Identifier: Apache-2.0
// Photons dealt out in pieces.
#pragma once

#include "src/scene/photon_lights.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace fastrt {

// Photons first .. last - 1 of a row of the plan.
struct PhotonChunk {
  std::uint32_t row, first, last;
};

inline constexpr std::uint32_t photons_per_chunk = 8192;

inline std::vector<PhotonChunk> photon_chunks(const PhotonPlan& plan) {
  std::vector<PhotonChunk> chunks;
  for (std::uint32_t row = 0; row < plan.lights.size(); ++row)
    for (std::uint32_t first = 0; first < plan.lights[row].count; first += photons_per_chunk)
      chunks.push_back({row, first, std::min(first + photons_per_chunk, plan.lights[row].count)});
  return chunks;
}

} // namespace fastrt
