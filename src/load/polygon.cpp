// SPDX-License-Identifier: Apache-2.0
#include "src/load/polygon.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fastrt {

namespace {

// Up to this many corners every pair of edges is tested for a crossing.
constexpr std::size_t most_pairwise = 1024;

// A polygon is called bent when it is thicker than this share of its size.
constexpr double bent_share = 0.1;

} // namespace

PolygonTriangulator::Result PolygonTriangulator::run(std::span<const Vec3> corners,
                                                     std::vector<Triangle>& triangles) {
  triangles.clear();
  Result result = project(corners);
  if (!result.tangled && !is_convex())
    result.tangled = !winds_once() || crosses_itself() || !cut_ears(triangles);
  if (triangles.empty() || result.tangled) fan(triangles);
  return result;
}

// Newell's plane; the polygon is then seen along the axis that the plane faces most.
PolygonTriangulator::Result PolygonTriangulator::project(std::span<const Vec3> corners) {
  const glm::dvec3 origin(corners[0]);
  glm::dvec3 normal(0.0);
  double reach = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const glm::dvec3 a = glm::dvec3(corners[i]) - origin, b = glm::dvec3(corners[i + 1]) - origin;
    normal += glm::cross(a, b);
    reach = std::max({reach, glm::dot(a, a), glm::dot(b, b)});
  }
  points_.resize(corners.size());
  const glm::dvec3 size = glm::abs(normal);
  const double length = glm::length(normal);
  if (!(length > 0) || !std::isfinite(length)) return {true, false};

  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const bool flipped = normal[axis] < 0;
  const int first = (axis + (flipped ? 2 : 1)) % 3, second = (axis + (flipped ? 1 : 2)) % 3;
  double lowest = 0, highest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 p = glm::dvec3(corners[i]) - origin;
    points_[i] = {p[first], p[second]};
    const double height = glm::dot(p, normal) / length;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return {false, highest - lowest > bent_share * std::sqrt(reach)};
}

// Left turns all the way, and around once: the edges point to the right in one run and to the left in
// another.
bool PolygonTriangulator::is_convex() const {
  const std::size_t count = points_.size();
  std::size_t reversals = 0;
  bool rightward = points_[0].x > points_[count - 1].x;
  for (std::size_t i = 0; i < count; ++i) {
    const PlanePoint &a = points_[i], &b = points_[(i + 1) % count], &c = points_[(i + 2) % count];
    if (!(area_of(a, b, c) > 0)) return false;
    const bool now_rightward = b.x > a.x;
    reversals += now_rightward != rightward ? 1 : 0;
    rightward = now_rightward;
  }
  return reversals <= 2;
}

bool PolygonTriangulator::winds_once() const {
  const std::size_t count = points_.size();
  double turned = 0;
  PlanePoint last{0, 0};
  PlanePoint first{0, 0};
  for (std::size_t i = 0; i < count; ++i) {
    const PlanePoint &a = points_[i], &b = points_[(i + 1) % count];
    const PlanePoint edge{b.x - a.x, b.y - a.y};
    if (edge.x == 0 && edge.y == 0) continue;
    if (last.x == 0 && last.y == 0) {
      first = edge;
    } else {
      turned += std::atan2(last.x * edge.y - last.y * edge.x, last.x * edge.x + last.y * edge.y);
    }
    last = edge;
  }
  turned += std::atan2(last.x * first.y - last.y * first.x, last.x * first.x + last.y * first.y);
  return turned > std::numbers::pi && turned < 3 * std::numbers::pi;
}

bool PolygonTriangulator::crosses_itself() const {
  const std::size_t count = points_.size();
  if (count > most_pairwise) return false;
  const auto opposite = [](double a, double b) { return (a > 0 && b < 0) || (a < 0 && b > 0); };
  for (std::size_t i = 0; i < count; ++i) {
    const PlanePoint &a = points_[i], &b = points_[(i + 1) % count];
    const auto [left, right] = std::minmax(a.x, b.x);
    for (std::size_t j = i + 2; j < count; ++j) {
      const PlanePoint &c = points_[j], &d = points_[(j + 1) % count];
      if (std::max(c.x, d.x) < left || std::min(c.x, d.x) > right) continue;
      if (opposite(area_of(a, b, c), area_of(a, b, d)) && opposite(area_of(c, d, a), area_of(c, d, b)))
        return true;
    }
  }
  return false;
}

void PolygonTriangulator::fan(std::vector<Triangle>& triangles) const {
  triangles.clear();
  const auto count = static_cast<std::uint32_t>(points_.size());
  for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.push_back({0, i, i + 1});
}

} // namespace fastrt
