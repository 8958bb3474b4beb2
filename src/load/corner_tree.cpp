// SPDX-License-Identifier: Apache-2.0
#include "src/load/corner_tree.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace fastrt {

namespace {

constexpr std::size_t leaf_size = 8;
constexpr std::uint32_t no_leaf = std::numeric_limits<std::uint32_t>::max();

bool within_columns(double low, double high, const CornerTree::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return (high >= a.x || high >= b.x || high >= c.x) && (low <= a.x || low <= b.x || low <= c.x);
}

bool is_corner(const PlanePoint& p, const CornerTree::Triangle& triangle) {
  return p == triangle[0] || p == triangle[1] || p == triangle[2];
}

bool is_within(const PlanePoint& p, const CornerTree::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return within_columns(p.x, p.x, triangle) && !is_corner(p, triangle) && area_of(a, b, p) >= 0 &&
         area_of(b, c, p) >= 0 && area_of(c, a, p) >= 0;
}

// Whether no point of the box can be on the left of the edge. Each operation of area_of rounds to the same
// side wherever the point is, so what holds for the leftmost corner of the box holds for all points.
bool lies_right(const PlanePoint& low, const PlanePoint& high, const PlanePoint& a, const PlanePoint& b) {
  const PlanePoint leftmost{b.y > a.y ? low.x : high.x, b.x > a.x ? high.y : low.y};
  return area_of(a, b, leftmost) < 0;
}

// Never for a box of a point that is within the triangle. A box may be a single place with many corners.
bool misses(const PlanePoint& low, const PlanePoint& high, const CornerTree::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return !within_columns(low.x, high.x, triangle) || lies_right(low, high, a, b) ||
         lies_right(low, high, b, c) || lies_right(low, high, c, a) ||
         (low == high && is_corner(low, triangle));
}

} // namespace

void CornerTree::build(std::span<const PlanePoint> points, std::span<const std::uint32_t> corners) {
  points_ = points;
  corners_.assign(corners.begin(), corners.end());
  leaf_of_.assign(points.size(), no_leaf);
  leaves_ = std::bit_ceil(std::max<std::size_t>(1, (corners.size() + leaf_size - 1) / leaf_size));
  nodes_.resize(2 * leaves_);
  build_below(1, 0, leaves_);
}

// Halves the longer side of the box as often as there are leaves.
void CornerTree::build_below(std::size_t node, std::size_t first_leaf, std::size_t leaves) {
  const auto begin = corners_.begin() + static_cast<std::ptrdiff_t>(first_of(first_leaf));
  const auto end = corners_.begin() + static_cast<std::ptrdiff_t>(first_of(first_leaf + leaves));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Node made{{infinity, infinity}, {-infinity, -infinity}, static_cast<std::uint32_t>(end - begin)};
  for (auto corner = begin; corner != end; ++corner) {
    const PlanePoint& p = points_[*corner];
    made.low = {std::min(made.low.x, p.x), std::min(made.low.y, p.y)};
    made.high = {std::max(made.high.x, p.x), std::max(made.high.y, p.y)};
  }
  nodes_[node] = made;
  if (leaves == 1) {
    for (auto corner = begin; corner != end; ++corner)
      leaf_of_[*corner] = static_cast<std::uint32_t>(first_leaf);
    return;
  }
  const bool is_wide = made.high.x - made.low.x > made.high.y - made.low.y;
  const std::size_t half = leaves / 2;
  const auto middle = corners_.begin() + static_cast<std::ptrdiff_t>(first_of(first_leaf + half));
  std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
    return is_wide ? points_[a].x < points_[b].x : points_[a].y < points_[b].y;
  });
  build_below(2 * node, first_leaf, half);
  build_below(2 * node + 1, first_leaf + half, half);
}

void CornerTree::remove(std::uint32_t corner) {
  const std::uint32_t leaf = leaf_of_[corner];
  if (leaf == no_leaf) return;
  leaf_of_[corner] = no_leaf;
  for (std::size_t node = leaves_ + leaf; node != 0; node /= 2) --nodes_[node].left;
}

bool CornerTree::any_below(std::size_t node, const Triangle& triangle) const {
  if (nodes_[node].left == 0 || misses(nodes_[node].low, nodes_[node].high, triangle)) return false;
  if (node >= leaves_) return any_in_leaf(node - leaves_, triangle);
  return any_below(2 * node, triangle) || any_below(2 * node + 1, triangle);
}

bool CornerTree::any_in_leaf(std::size_t leaf, const Triangle& triangle) const {
  for (std::size_t i = first_of(leaf); i != first_of(leaf + 1); ++i)
    if (leaf_of_[corners_[i]] != no_leaf && is_within(points_[corners_[i]], triangle)) return true;
  return false;
}

} // namespace fastrt
