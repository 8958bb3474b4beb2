// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/accel/tree.hpp"

#include <cstddef>
#include <cstdint>

namespace fastrt {

// Which binary nodes become wide nodes or leaves, so that the wide tree costs least (in the units of
// sah_cost).
class CollapsePlan {
public:
  // Throws what running out of memory throws.
  CollapsePlan(const BinaryTree& tree, const BuildSettings& settings);

  // Whether the node becomes one leaf with all that lies below it.
  bool is_leaf(std::uint32_t node) const { return (choices_[node] & leaf_choice) != 0; }

  // The binary nodes that become the children of the wide node made of `node`, from left to right.
  int children_of(std::uint32_t node, std::uint32_t children[wide_children]) const;

private:
  // Bit 0: a leaf. Three bits for each k = 2 .. 8 follow: of k children, so many lie below the left child; 0:
  // the node does better with k - 1.
  static constexpr std::uint32_t leaf_choice = 1;

  struct Part;
  Part solve(std::uint32_t node);
  Part solve_leaf(std::uint32_t node);
  double leaf_cost(double area, std::size_t count) const;
  Part join(std::uint32_t node, const Part& left, const Part& right);
  int left_share(std::uint32_t node, int k) const {
    return static_cast<int>(choices_[node] >> (3 * k - 5) & 7U);
  }
  void expand(std::uint32_t node, int k, std::uint32_t* children, int& count) const;

  const BinaryTree& tree_;
  std::size_t run_size_;
  Column<std::uint32_t> choices_;
};

} // namespace fastrt
