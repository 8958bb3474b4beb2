// SPDX-License-Identifier: Apache-2.0
// Cutting ears off a polygon.
#include "src/load/polygon.hpp"

#include <algorithm>

namespace fastrt {

PolygonTriangulator::Turn PolygonTriangulator::turn_at(std::uint32_t corner) const {
  const Link& link = ring_[corner];
  const double turn = area_of(points_[link.before], points_[corner], points_[link.after]);
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
  candidates_.clear();
  for (std::uint32_t i = 0; i < count; ++i)
    if (turn_at(i) != Turn::left) candidates_.push_back(i);
  may_block_.build(points_, candidates_);
}

// Whether another corner lies in the ear or on its rim. One in the same place as a corner of the ear does not
// count: it is the other end of a slit.
bool PolygonTriangulator::is_ear(std::uint32_t corner) const {
  if (turn_at(corner) != Turn::left) return false;
  const Link& ends = ring_[corner];
  return !may_block_.any_within({points_[ends.before], points_[corner], points_[ends.after]});
}

void PolygonTriangulator::cut(std::uint32_t corner, std::vector<Triangle>& triangles) {
  const Link link = ring_[corner];
  triangles.push_back({link.before, corner, link.after});
  ring_[link.before].after = link.after;
  ring_[link.after].before = link.before;
  gone_[corner] = 1;
  may_block_.remove(corner);
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
