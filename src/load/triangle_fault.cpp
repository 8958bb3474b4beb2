// SPDX-License-Identifier: Apache-2.0
#include "src/load/triangle_fault.hpp"

#include <algorithm>
#include <cmath>

namespace fastrt {

namespace {

float largest(const Vec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

} // namespace

// With the very cross product that shading normalises later: 0 and overflow have no normal.
TriangleFault fault_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const float size = std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z);
  if (size == 0) return TriangleFault::flat;
  if (size < modest_normal) return TriangleFault::none;
  const float extent = std::max({largest(b - a), largest(c - a), largest(c - b)});
  return size * (16 * extent) < infinity ? TriangleFault::none : TriangleFault::huge;
}

const char* kind_of(TriangleFault fault) {
  return fault == TriangleFault::flat ? "degenerate face" : "huge face";
}

const char* message_of(TriangleFault fault) {
  return fault == TriangleFault::flat ? "triangle without area skipped"
                                      : "triangle too large for single precision skipped";
}

} // namespace fastrt
