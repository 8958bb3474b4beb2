// SPDX-License-Identifier: Apache-2.0
// Where rays meet cones, in long double by the quadratic equation as it stands; and whether an answer agrees.
#pragma once

#include <fastrt/math.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fastrt::test {

using Real = long double;
using Vec3l = glm::vec<3, long double, glm::defaultp>;

// Wrong answers are allowed this near to an outline, as a share of the distance and the size.
inline constexpr Real outline_tolerance = 1e-6L;

struct Cone {
  Vec3l base, apex;
  Real r0, r1;
  bool capped;
  Vec3l axis() const { return glm::normalize(apex - base); }
  Real height() const { return glm::length(apex - base); }
  Real radius_at(Real z) const { return r0 + (r1 - r0) * z / height(); }
};

// A point of the surface that a ray meets.
struct Crossing {
  Real t;
  Real cosine; // of the angle to the normal
  Real rim;    // distance from the nearest rim
};

inline void add_crossing(std::vector<Crossing>& crossings, const Cone& cone, const Vec3l& d,
                         const Vec3l& normal, Real t, Real z, Real distance) {
  const Real rim =
      std::min(std::hypot(z, distance - cone.r0), std::hypot(z - cone.height(), distance - cone.r1));
  crossings.push_back({t, std::fabs(glm::dot(glm::normalize(d), glm::normalize(normal))), rim});
}

// By the quadratic equation as it stands.
inline std::vector<Crossing> crossings_of(const Cone& cone, const Vec3l& o, const Vec3l& d) {
  const Vec3l u = cone.axis();
  const Real height = cone.height(), slope = (cone.r1 - cone.r0) / height;
  const Vec3l f = o - cone.base;
  const Real m = glm::dot(f, u), n = glm::dot(d, u);
  const Vec3l g = f - m * u, e = d - n * u;
  const Real k = cone.r0 + slope * m, s = slope * n;
  const Real a = glm::dot(e, e) - s * s, b = glm::dot(g, e) - k * s, c = glm::dot(g, g) - k * k;
  std::vector<Crossing> crossings;
  const Real discriminant = b * b - a * c;
  if (discriminant >= 0) {
    for (const Real sign : {-1.0L, 1.0L}) {
      const Real t = (-b + sign * std::sqrt(discriminant)) / a;
      const Real z = m + t * n;
      const Vec3l q = g + t * e;
      if (z >= 0 && z <= height)
        add_crossing(crossings, cone, d, q - slope * glm::length(q) * u, t, z, glm::length(q));
    }
  }
  if (cone.capped) {
    for (const Real z : {Real(0), height}) {
      const Real t = (z - m) / n;
      const Real distance = glm::length(g + t * e);
      if (distance <= cone.radius_at(z)) add_crossing(crossings, cone, d, u, t, z, distance);
    }
  }
  std::sort(crossings.begin(), crossings.end(), [](const auto& x, const auto& y) { return x.t < y.t; });
  return crossings;
}

// How far a point is from the cone's mantle or from one of its discs.
inline Real distance_from(const Cone& cone, const Vec3l& p) {
  const Vec3l u = cone.axis();
  const Real z = glm::dot(p - cone.base, u);
  const Real across = glm::length(p - cone.base - z * u);
  const Real height = cone.height();
  const Real outside = std::max({Real(0), -z, z - height});
  const Real mantle = std::hypot(across - cone.radius_at(std::clamp(z, Real(0), height)), outside);
  if (!cone.capped) return mantle;
  const Real at_base = std::hypot(z, std::max(Real(0), across - cone.r0));
  const Real at_apex = std::hypot(z - height, std::max(Real(0), across - cone.r1));
  return std::min({mantle, at_base, at_apex});
}

// A hit at t, or none.
struct Answer {
  bool hit;
  float t;
};

struct Judgement {
  bool wrong;
  bool hit;
};

// A hit must lie on the surface; and a crossing that was passed over must be one that the ray touches at its
// outline: at a grazing angle, or at a rim.
inline Judgement judge(const Cone& cone, const Vec3l& o, const Vec3l& d, const Answer& found) {
  const Real size = std::max({cone.r0, cone.r1, cone.height()});
  const Real slack = outline_tolerance * (glm::length(o - cone.base) + size);
  if (found.hit && distance_from(cone, o + Real(found.t) * d) > 4 * slack) {
    // Along a grazing ray a small change of the angle moves the point far.
    const Vec3l p = o + Real(found.t) * d;
    bool near_grazing = false;
    for (const Crossing& crossing : crossings_of(cone, o, d))
      near_grazing = near_grazing || (glm::length(o + crossing.t * d - p) * crossing.cosine < 8 * slack);
    if (!near_grazing) return {true, true};
  }
  for (const Crossing& crossing : crossings_of(cone, o, d)) {
    if (crossing.t <= 0) continue;
    const Real way = slack / std::max(crossing.cosine, 1e-9L) / glm::length(d);
    if (found.hit && Real(found.t) <= crossing.t + 4 * way) break;
    const bool grazes = crossing.cosine * crossing.cosine * size < 16 * slack;
    const bool at_rim = crossing.rim * crossing.cosine < 8 * slack;
    if (!grazes && !at_rim) return {true, found.hit};
  }
  return {false, found.hit};
}

} // namespace fastrt::test
