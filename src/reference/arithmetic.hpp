// SPDX-License-Identifier: Apache-2.0
// The few operations of docs/numerics.md that GLM performs otherwise. glm::dot, glm::cross and glm::normalize
// are the document's own.
#pragma once

#include <fastrt/math.hpp>

#include <cmath>

namespace fastrt::reference {

// glm::min and std::min give their first operand for NaN and for zeros of different sign; these, the second.
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }

inline float largest(const Vec3& v) { return max(v.x, max(v.y, v.z)); }

// glm::abs keeps the sign of -0.
inline Vec3 magnitudes(const Vec3& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
inline float largest_magnitude(const Vec3& v) { return largest(magnitudes(v)); }

} // namespace fastrt::reference
