// SPDX-License-Identifier: Apache-2.0
// A binary tree whose subtrees can be moved about: nodes know their parents, and lie anywhere.
#pragma once

#include "src/accel/box_lanes.hpp"

#include <cstddef>
#include <cstdint>

namespace fastrt {

class LinkedTree {
public:
  static constexpr std::uint32_t root = 0;
  static constexpr std::uint32_t none = 0xFFFFFFFFU; // the root's parent, a leaf's children

  // Nodes have the numbers that they have in `tree`, which must have at least one, and keep these however
  // they are moved.
  explicit LinkedTree(const BinaryTree& tree);

  // No move makes the tree deeper than this; max_tree_depth at first.
  void limit_depth(int max_depth) { max_depth_ = max_depth; }

  std::size_t size() const { return nodes_.size(); }
  bool is_leaf(std::uint32_t node) const { return nodes_[node].left == none; }
  std::uint32_t left(std::uint32_t node) const { return nodes_[node].left; }
  std::uint32_t right(std::uint32_t node) const { return nodes_[node].right; }
  std::uint32_t parent(std::uint32_t node) const { return parents_[node]; }
  std::uint32_t sibling(std::uint32_t node) const {
    const Node& parent = nodes_[parents_[node]];
    return parent.left == node ? parent.right : parent.left;
  }
  LaneBox box(std::uint32_t node) const {
    return clear_fourth({_mm_load_ps(nodes_[node].lower), _mm_load_ps(nodes_[node].upper)});
  }

  // Neither the root nor its children can move.
  bool can_leave(std::uint32_t node) const { return parents_[node] != none && parents_[node] != root; }

  double half_area(std::uint32_t node) const;

  // Whether `node` can become the sibling of `target` and the tree stays a tree that is not too deep.
  bool can_move(std::uint32_t node, std::uint32_t target) const;

  // Takes `node` and its parent out, puts the parent where `target` is and both below it. Boxes are as tight
  // afterwards as before. Returns by how much all boxes' half areas together have grown. Moving the node to
  // what was its sibling takes the move back.
  double move(std::uint32_t node, std::uint32_t target);

  // The tree with its nodes in depth-first order; leaves keep the primitives that they have in `original`,
  // from which this was made.
  BinaryTree in_order(const BinaryTree& original) const;

private:
  struct alignas(16) Node {
    float lower[3];
    std::uint32_t left;
    float upper[3];
    std::uint32_t right;
  };

  void replace_child(std::uint32_t parent, std::uint32_t child, std::uint32_t other);
  double refit(std::uint32_t node);
  double refit_upwards(std::uint32_t node);
  void put(const BinaryTree& original, std::uint32_t node, std::uint32_t index, std::uint32_t& next,
           BinaryTree& tree) const;

  Column<Node> nodes_;
  Column<std::uint32_t> parents_;
  Column<std::uint8_t> heights_; // levels from the node down to its lowest leaf
  int max_depth_ = max_tree_depth;
};

} // namespace fastrt
