// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>

#include <cmath>

namespace fastrt {

inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace fastrt
