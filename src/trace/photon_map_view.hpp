// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace fastrt {

// PhotonMap (src/film/photon_map.hpp), as the kernels see it. Columns may be read 16 rows beyond the last.
struct PhotonMapView {
  const float* point[3];
  const float* normal[3];
  const float* flux[3];
  const std::int32_t* cell_x;
  const std::uint32_t* row_begin;
  std::int32_t size[3]; // cells; 0 of an empty map
  float low[3], high[3];
  float inverse_side, radius, radius2, inverse_radius2, scale;
};

} // namespace fastrt
