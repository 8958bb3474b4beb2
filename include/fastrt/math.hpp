// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <limits>

namespace fastrt {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;

inline constexpr float infinity = std::numeric_limits<float>::infinity();

// An axis-aligned box in world space. The default is empty: it contains nothing and extending it gives the
// other box.
struct Aabb {
  Vec3 lower{infinity};
  Vec3 upper{-infinity};

  void extend(const Vec3& point) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
  }
  void extend(const Aabb& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
  }
  bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
  Vec3 center() const { return 0.5F * lower + 0.5F * upper; }
  Vec3 extent() const { return upper - lower; }
};

// An affine map by what it does to the axes and the origin: a point p goes to x*p.x + y*p.y + z*p.z + origin.
struct Affine {
  Vec3 x{1.0F, 0.0F, 0.0F}, y{0.0F, 1.0F, 0.0F}, z{0.0F, 0.0F, 1.0F};
  Vec3 origin{0.0F};
};

} // namespace fastrt
