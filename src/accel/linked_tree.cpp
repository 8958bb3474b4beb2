// SPDX-License-Identifier: Apache-2.0
#include "src/accel/linked_tree.hpp"

#include "src/accel/half_area.hpp"

#include <algorithm>

namespace fastrt {

LinkedTree::LinkedTree(const BinaryTree& tree)
    : nodes_(tree.nodes.size()), parents_(tree.nodes.size()), heights_(tree.nodes.size()) {
  parents_[root] = none;
  // Children come after their parents.
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const BinaryNode& from = tree.nodes[i];
    Node& node = nodes_[i];
    std::copy(from.lower, from.lower + 3, node.lower);
    std::copy(from.upper, from.upper + 3, node.upper);
    node.left = node.right = none;
    heights_[i] = 1;
    if (from.count != 0) continue;
    node.left = from.first;
    node.right = from.first + 1;
    parents_[node.left] = parents_[node.right] = static_cast<std::uint32_t>(i);
    heights_[i] = static_cast<std::uint8_t>(1 + std::max(heights_[node.left], heights_[node.right]));
  }
}

double LinkedTree::half_area(std::uint32_t node) const {
  return fastrt::half_area(nodes_[node].lower, nodes_[node].upper);
}

bool LinkedTree::can_move(std::uint32_t node, std::uint32_t target) const {
  if (!can_leave(node) || target == root || target == parents_[node] || target == sibling(node)) return false;
  int level = 0;
  for (std::uint32_t i = target; i != none; i = parents_[i], ++level)
    if (i == node) return false;
  return level + std::max(heights_[node], heights_[target]) <= max_depth_;
}

double LinkedTree::move(std::uint32_t node, std::uint32_t target) {
  const std::uint32_t parent = parents_[node], before = parents_[parent];
  replace_child(before, parent, sibling(node));
  double growth = refit_upwards(before);
  const std::uint32_t after = parents_[target];
  replace_child(after, target, parent);
  nodes_[parent].left = target;
  nodes_[parent].right = node;
  parents_[target] = parent;
  growth += refit(parent);
  return growth + refit_upwards(after);
}

void LinkedTree::replace_child(std::uint32_t parent, std::uint32_t child, std::uint32_t other) {
  Node& node = nodes_[parent];
  (node.left == child ? node.left : node.right) = other;
  parents_[other] = parent;
}

// Sets the node's box and height from its children's. Returns the growth of its half area.
double LinkedTree::refit(std::uint32_t node) {
  const double before = half_area(node);
  Node& n = nodes_[node];
  const Node &left = nodes_[n.left], &right = nodes_[n.right];
  for (int axis = 0; axis < 3; ++axis) {
    n.lower[axis] = std::min(left.lower[axis], right.lower[axis]);
    n.upper[axis] = std::max(left.upper[axis], right.upper[axis]);
  }
  heights_[node] = static_cast<std::uint8_t>(1 + std::max(heights_[n.left], heights_[n.right]));
  return half_area(node) - before;
}

// The same for the node and those above it, as far as anything changes.
double LinkedTree::refit_upwards(std::uint32_t node) {
  double growth = 0;
  for (; node != none; node = parents_[node]) {
    const Node before = nodes_[node];
    const std::uint8_t height = heights_[node];
    growth += refit(node);
    if (height == heights_[node] && std::equal(before.lower, before.lower + 3, nodes_[node].lower) &&
        std::equal(before.upper, before.upper + 3, nodes_[node].upper))
      break;
  }
  return growth;
}

BinaryTree LinkedTree::in_order(const BinaryTree& original) const {
  BinaryTree tree;
  tree.nodes.resize(nodes_.size());
  tree.group_of_leaf.resize(nodes_.size());
  tree.order.reserve(original.order.size());
  std::uint32_t next = 1;
  put(original, root, 0, next, tree);
  return tree;
}

// Puts a node at an index, and what lies below it from `next` on.
void LinkedTree::put(const BinaryTree& original, std::uint32_t node, std::uint32_t index, std::uint32_t& next,
                     BinaryTree& tree) const {
  BinaryNode& to = tree.nodes[index];
  to = original.nodes[node];
  tree.group_of_leaf[index] = original.group_of_leaf[node];
  if (is_leaf(node)) {
    to.first = static_cast<std::uint32_t>(tree.order.size());
    tree.order.append(original.order.data() + original.nodes[node].first, to.count);
    return;
  }
  std::copy(nodes_[node].lower, nodes_[node].lower + 3, to.lower);
  std::copy(nodes_[node].upper, nodes_[node].upper + 3, to.upper);
  const std::uint32_t first = to.first = next;
  next += 2;
  put(original, left(node), first, next, tree);
  put(original, right(node), first + 1, next, tree);
}

} // namespace fastrt
