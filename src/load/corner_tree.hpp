// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fastrt {

// A point of the plane that a polygon is cut in.
struct PlanePoint {
  double x, y;
  bool operator==(const PlanePoint&) const = default;
};

// Twice the area of the triangle; positive where it turns left.
inline double area_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

// Some corners of a polygon, to be found by where they are. Keeps its memory from one polygon to the next.
class CornerTree {
public:
  using Triangle = std::array<PlanePoint, 3>; // turns left

  // points: of all corners; they must stay where they are. corners: the ones to be found.
  void build(std::span<const PlanePoint> points, std::span<const std::uint32_t> corners);
  // Does nothing if it is not among them.
  void remove(std::uint32_t corner);
  // Whether one of them lies in the triangle or on its rim. One in the same place as a corner of the triangle
  // does not count.
  bool any_within(const Triangle& triangle) const { return any_below(1, triangle); }

private:
  // The box of all that were there, and how many still are. Children of node i are 2 i and 2 i + 1.
  struct Node {
    PlanePoint low, high;
    std::uint32_t left;
  };

  void build_below(std::size_t node, std::size_t first_leaf, std::size_t leaves);
  std::size_t first_of(std::size_t leaf) const { return leaf * corners_.size() / leaves_; }
  bool any_below(std::size_t node, const Triangle& triangle) const;
  bool any_in_leaf(std::size_t leaf, const Triangle& triangle) const;

  std::span<const PlanePoint> points_;
  std::vector<std::uint32_t> corners_; // of one leaf after the other
  std::vector<std::uint32_t> leaf_of_; // of each corner
  std::vector<Node> nodes_;
  std::size_t leaves_ = 1; // a power of two
};

} // namespace fastrt
