// SPDX-License-Identifier: Apache-2.0
#include "src/accel/tree_top.hpp"

#include "src/accel/box_lanes.hpp"

#include <algorithm>
#include <queue>
#include <utility>
#include <vector>

namespace fastrt {
namespace {

// A leaf of the top that may get children: numbers in the whole tree and in the top.
struct Open {
  float area; // scaled
  std::uint32_t whole, top;

  bool operator<(const Open& other) const {
    return area < other.area || (area == other.area && top > other.top);
  }
};

LaneBox box_of(const BinaryNode& node) {
  return clear_fourth({_mm_loadu_ps(node.lower), _mm_loadu_ps(node.upper)});
}

// Copies subtrees behind one another. Depth first, all nodes below a node are neighbours, and so are the
// primitives of all leaves below it.
class Assembler {
public:
  Assembler(const BinaryTree& whole, const BinaryTree& top) : whole_(whole), top_(top) {
    tree_.nodes.resize(whole.nodes.size());
    tree_.group_of_leaf.resize(whole.nodes.size());
    tree_.order.reserve(whole.order.size());
  }

  BinaryTree run() {
    put(0, 0);
    return std::move(tree_);
  }

private:
  void put(std::uint32_t top, std::uint32_t index) {
    const BinaryNode& node = top_.nodes[top];
    if (node.count != 0) return put_subtree(top_.order[node.first], index);
    tree_.nodes[index] = node;
    tree_.group_of_leaf[index] = 0;
    const std::uint32_t first = tree_.nodes[index].first = next_;
    next_ += 2;
    put(node.first, first);
    put(node.first + 1, first + 1);
  }

  void put_subtree(std::uint32_t root, std::uint32_t index) {
    const std::uint32_t begin = whole_.nodes[root].first, end = end_below(root);
    std::uint32_t first_leaf = root;
    while (whole_.nodes[first_leaf].count == 0) first_leaf = whole_.nodes[first_leaf].first;
    const std::uint32_t first_primitive = whole_.nodes[first_leaf].first;
    const Shift shift{next_ - begin, static_cast<std::uint32_t>(tree_.order.size()) - first_primitive};
    std::uint32_t count = put_node(root, index, shift);
    if (whole_.nodes[root].count == 0)
      for (std::uint32_t i = begin; i < end; ++i) count += put_node(i, next_++, shift);
    tree_.order.append(whole_.order.data() + first_primitive, count);
  }

  // How far numbers of nodes and of primitives move.
  struct Shift {
    std::uint32_t node, primitive;
  };

  // Returns how many primitives the node has itself.
  std::uint32_t put_node(std::uint32_t from, std::uint32_t to, const Shift& shift) {
    BinaryNode node = whole_.nodes[from];
    node.first += node.count == 0 ? shift.node : shift.primitive;
    tree_.nodes[to] = node;
    tree_.group_of_leaf[to] = whole_.group_of_leaf[from];
    return node.count;
  }

  // The number after the last node below one.
  std::uint32_t end_below(std::uint32_t node) const {
    std::uint32_t end = node;
    while (whole_.nodes[node].count == 0) {
      const std::uint32_t left = whole_.nodes[node].first, right = left + 1;
      end = right + 1;
      node = whole_.nodes[right].count == 0 ? right : left;
    }
    return end;
  }

  const BinaryTree& whole_;
  const BinaryTree& top_;
  BinaryTree tree_;
  std::uint32_t next_ = 1;
};

} // namespace

TreeTop::TreeTop(const BinaryTree& whole, std::size_t max_nodes) : whole_(whole) {
  const __m128 scale = area_scale(box_of(whole.nodes[0]));
  std::priority_queue<Open> open;
  Column<std::uint32_t> origins;
  const auto add = [&](std::uint32_t node) {
    const auto top = static_cast<std::uint32_t>(origins.size());
    tree_.nodes.push_back(whole.nodes[node]);
    tree_.nodes[top].count = 1;
    origins.push_back(node);
    if (whole.nodes[node].count != 0) return;
    const float area = half_area(box_of(whole.nodes[node]), scale);
    // An area that is not a number has no place in an order.
    open.push({area >= 0 ? area : 0.0F, node, top});
  };
  add(0);
  while (!open.empty() && origins.size() + 2 <= max_nodes) {
    const Open largest = open.top();
    open.pop();
    tree_.nodes[largest.top].count = 0;
    tree_.nodes[largest.top].first = static_cast<std::uint32_t>(origins.size());
    const std::uint32_t first = whole.nodes[largest.whole].first;
    add(first);
    add(first + 1);
  }
  for (std::size_t i = 0; i < origins.size(); ++i) {
    if (tree_.nodes[i].count == 0) continue;
    tree_.nodes[i].first = static_cast<std::uint32_t>(tree_.order.size());
    tree_.order.push_back(origins[i]);
  }
  tree_.group_of_leaf.resize(tree_.nodes.size(), 0);
}

int TreeTop::max_depth() const {
  std::vector<std::uint8_t> heights(whole_.nodes.size(), 1);
  // Children come after their parents.
  for (std::size_t i = heights.size(); i-- > 0;) {
    const BinaryNode& node = whole_.nodes[i];
    if (node.count != 0) continue;
    heights[i] = static_cast<std::uint8_t>(1 + std::max(heights[node.first], heights[node.first + 1]));
  }
  int highest = 1;
  for (const std::uint32_t root : tree_.order) highest = std::max<int>(highest, heights[root]);
  return max_tree_depth + 1 - highest;
}

BinaryTree TreeTop::below(const BinaryTree& other_top) const { return Assembler(whole_, other_top).run(); }

} // namespace fastrt
