// SPDX-License-Identifier: Apache-2.0
// The largest nodes of a binary tree as a small tree of its own.
#pragma once

#include "src/accel/tree.hpp"

#include <cstddef>

namespace fastrt {

class TreeTop {
public:
  // The root, then again and again the children of the largest node that has none here yet, until there are
  // max_nodes (at least 1) or all. `whole` must have a node, its nodes in depth-first order, and outlive
  // this.
  TreeTop(const BinaryTree& whole, std::size_t max_nodes);

  // What is below its leaves is left out: each stands for one subtree, and the tree's order has for each the
  // number of that subtree's root in `whole`. Groups are all 0.
  const BinaryTree& tree() const { return tree_; }

  // So many levels the top may have and the whole is surely no deeper than max_tree_depth.
  int max_depth() const;

  // `whole` under another top with the same leaves in any order. Nodes and leaves are in depth-first order.
  BinaryTree below(const BinaryTree& other_top) const;

private:
  const BinaryTree& whole_;
  BinaryTree tree_;
};

} // namespace fastrt
