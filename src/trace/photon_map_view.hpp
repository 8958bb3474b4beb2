// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace fastrt {

// PhotonLevel (src/film/photon_map.hpp), as the kernels see it. Columns may be read 16 rows beyond the last.
struct PhotonLevelView {
  const float* point[3];
  const float* normal[3];
  const float* flux[3];
  const std::int32_t* cell_x;
  const std::uint32_t* row_begin;
  std::int32_t size[3]; // cells
  float low[3], high[3];
  float inverse_side, radius, radius2, inverse_radius2, height2;
};

struct PhotonMapView {
  const PhotonLevelView* levels;
  int level_count;
};

} // namespace fastrt
