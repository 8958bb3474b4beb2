// SPDX-License-Identifier: Apache-2.0
// Triangles that no ray can meet, which all readers leave out with a warning.
#pragma once

#include <fastrt/math.hpp>

namespace fastrt {

enum class TriangleFault { none, flat, huge };

// Triangles whose normal is smaller than this, as |x| + |y| + |z| of the cross product of two sides, are not
// huge.
inline constexpr float modest_normal = 1e20F;

// flat: without area, or with less than single precision can hold. huge: where a ray meets its plane can't be
// computed, for the product of its normal and the way from the eye, taken for 16 times its size, is too
// large.
TriangleFault fault_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

// The kind of warning, and what it says.
const char* kind_of(TriangleFault fault);
const char* message_of(TriangleFault fault);

} // namespace fastrt
