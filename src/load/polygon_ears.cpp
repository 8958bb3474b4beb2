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
  left_ = count;
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
  --left_;
}

// Cuts the ears among the candidates; only the neighbours of one that was cut can become ears by that.
void PolygonTriangulator::cut_candidates(std::vector<Triangle>& triangles) {
  for (std::size_t next = 0; next != candidates_.size() && left_ > 3; ++next) {
    const std::uint32_t corner = candidates_[next];
    if (gone_[corner] != 0 || !is_ear(corner)) continue;
    candidates_.push_back(ring_[corner].before);
    candidates_.push_back(ring_[corner].after);
    cut(corner, triangles);
  }
}

// Cuts corners that turn nowhere: the triangles have no area, but may free ears.
void PolygonTriangulator::cut_straight(std::vector<Triangle>& triangles) {
  for (std::uint32_t corner = 0; corner != ring_.size() && left_ > 3; ++corner)
    if (gone_[corner] == 0 && turn_at(corner) == Turn::straight) cut(corner, triangles);
}

// False if there is no ear left before the end: the polygon touches or crosses itself.
bool PolygonTriangulator::cut_ears(std::vector<Triangle>& triangles) {
  make_ring();
  while (left_ > 3) {
    const std::size_t left_before = left_;
    candidates_.clear();
    for (std::uint32_t corner = 0; corner != ring_.size(); ++corner)
      if (gone_[corner] == 0) candidates_.push_back(corner);
    cut_candidates(triangles);
    // Corners on a straight line go last: cutting one early would leave it on the edge of a triangle, not at
    // a corner, and so a gap.
    if (left_ == left_before) cut_straight(triangles);
    if (left_ == left_before) return false;
  }
  const auto corner = static_cast<std::uint32_t>(std::find(gone_.begin(), gone_.end(), 0) - gone_.begin());
  triangles.push_back({ring_[corner].before, corner, ring_[corner].after});
  return turn_at(corner) != Turn::right;
}

} // namespace fastrt
