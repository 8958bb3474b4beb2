// SPDX-License-Identifier: Apache-2.0
// Cutting ears off a polygon.
#include "src/load/polygon.hpp"

#include <algorithm>

namespace fastrt {

PolygonTriangulator::Turn PolygonTriangulator::turn_at(std::uint32_t corner) const {
  const Link& link = ring_[corner];
  const double turn = area(points_[link.before], points_[corner], points_[link.after]);
  return turn > 0 ? Turn::left : turn < 0 ? Turn::right : Turn::straight;
}

void PolygonTriangulator::make_ring() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  ring_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i)
    ring_[i] = {i == 0 ? count - 1 : i - 1, i + 1 == count ? 0 : i + 1};
  gone_.assign(count, 0);
  // A corner that turns left now always will: only the others can come to lie in an ear.
  by_x_.clear();
  for (std::uint32_t i = 0; i < count; ++i)
    if (turn_at(i) != Turn::left) by_x_.push_back(i);
  const auto by_x = [this](std::uint32_t a, std::uint32_t b) {
    return points_[a].x < points_[b].x || (points_[a].x == points_[b].x && a < b);
  };
  std::sort(by_x_.begin(), by_x_.end(), by_x);
}

// Whether another corner lies in the ear or on its rim. One in the same place as a corner of the ear does not
// count: it is the other end of a slit.
bool PolygonTriangulator::blocks(std::uint32_t other, const Link& ends, std::uint32_t corner) const {
  const Point& p = points_[other];
  for (const std::uint32_t own : {ends.before, corner, ends.after})
    if (other == own || (p.x == points_[own].x && p.y == points_[own].y)) return false;
  const Point &a = points_[ends.before], &b = points_[corner], &c = points_[ends.after];
  return area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
}

bool PolygonTriangulator::is_ear(std::uint32_t corner) const {
  if (turn_at(corner) != Turn::left) return false;
  const Link& ends = ring_[corner];
  const auto [left, right] = std::minmax({points_[ends.before].x, points_[corner].x, points_[ends.after].x});
  const auto before = [this](std::uint32_t a, double x) { return points_[a].x < x; };
  for (auto other = std::lower_bound(by_x_.begin(), by_x_.end(), left, before);
       other != by_x_.end() && points_[*other].x <= right; ++other)
    if (gone_[*other] == 0 && blocks(*other, ends, corner)) return false;
  return true;
}

void PolygonTriangulator::cut(std::uint32_t corner, std::vector<Triangle>& triangles) {
  const Link link = ring_[corner];
  triangles.push_back({link.before, corner, link.after});
  ring_[link.before].after = link.after;
  ring_[link.after].before = link.before;
  gone_[corner] = 1;
}

// False if there is no ear left before the end: the polygon touches or crosses itself.
bool PolygonTriangulator::cut_ears(std::vector<Triangle>& triangles) {
  make_ring();
  std::size_t left = points_.size();
  std::size_t since_last_cut = 0;
  bool accept_straight = false;
  std::uint32_t corner = 0;
  while (left > 3) {
    const std::uint32_t next = ring_[corner].after;
    // Corners on a straight line go last: cutting one early would leave it on the edge of a triangle, not at
    // a corner, and so a gap.
    if (is_ear(corner) || (accept_straight && turn_at(corner) == Turn::straight)) {
      cut(corner, triangles);
      --left;
      since_last_cut = 0;
      accept_straight = false;
      corner = ring_[next].after; // skipping one avoids slivers around one corner
      continue;
    }
    corner = next;
    if (++since_last_cut <= left) continue;
    if (accept_straight) return false;
    accept_straight = true;
    since_last_cut = 0;
  }
  triangles.push_back({ring_[corner].before, corner, ring_[corner].after});
  return turn_at(corner) != Turn::right;
}

} // namespace fastrt
