// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/corner_tree.hpp"

#include <fastrt/math.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fastrt {

// What is to be cut into triangles may not have more corners: that takes time.
inline constexpr std::size_t max_face_corners = 65535;

// Polygons of any shape to triangles. Keeps its memory from one to the next.
class PolygonTriangulator {
public:
  using Triangle = std::array<std::uint32_t, 3>; // of corners
  struct Result {
    bool tangled = false; // crosses itself or has no area: the triangles are a fan
    bool bent = false;    // far from planar
  };

  // corners: at least 3, in order. Puts corners.size() - 2 triangles, turning as the polygon does, into
  // `triangles`: a fan around the first corner if it is convex, else by cutting off ears in the plane that
  // shows most of it.
  Result run(std::span<const Vec3> corners, std::vector<Triangle>& triangles);

private:
  // A corner in the ring of those that are left.
  struct Link {
    std::uint32_t before, after;
  };
  enum class Turn { left, straight, right };

  Result project(std::span<const Vec3> corners);
  Turn turn_at(std::uint32_t corner) const;
  bool is_convex() const;
  bool crosses_itself() const;
  bool winds_once() const;
  void fan(std::vector<Triangle>& triangles) const;
  bool cut_ears(std::vector<Triangle>& triangles);
  void cut_candidates(std::vector<Triangle>& triangles);
  void cut_straight(std::vector<Triangle>& triangles);
  void make_ring();
  bool is_ear(std::uint32_t corner) const;
  void cut(std::uint32_t corner, std::vector<Triangle>& triangles);

  std::vector<PlanePoint> points_; // projected so that the polygon turns left
  std::vector<Link> ring_;
  CornerTree may_block_; // the corners that may lie in an ear
  std::vector<char> gone_;
  std::size_t left_ = 0; // corners in the ring
  std::vector<std::uint32_t> candidates_;
};

} // namespace fastrt
