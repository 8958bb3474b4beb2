// SPDX-License-Identifier: Apache-2.0
#include "src/accel/check_tree.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

namespace fastrt {
namespace {

Aabb box_of(const PrimitiveBox& box) {
  return {{box.lower[0], box.lower[1], box.lower[2]}, {box.upper[0], box.upper[1], box.upper[2]}};
}

Aabb box_of(const BinaryNode& node) {
  return {{node.lower[0], node.lower[1], node.lower[2]}, {node.upper[0], node.upper[1], node.upper[2]}};
}

Aabb box_of(const WideNode& node, int i) {
  return {{node.lower_x[i], node.lower_y[i], node.lower_z[i]},
          {node.upper_x[i], node.upper_y[i], node.upper_z[i]}};
}

bool same(const Aabb& a, const Aabb& b) { return a.lower == b.lower && a.upper == b.upper; }

bool inverted(const Aabb& box) { return same(box, Aabb{}); }

// The primitives by id, each of which may be taken once.
class Primitives {
public:
  explicit Primitives(const Column<PrimitiveBox>& boxes) {
    for (const PrimitiveBox& box : boxes) untaken_.emplace(box.id, box);
  }

  // Extends `bounds` by the primitive's box, or says why not.
  std::string take(std::uint32_t id, std::uint32_t group, Aabb& bounds) {
    const auto found = untaken_.find(id);
    if (found == untaken_.end()) return "primitive " + std::to_string(id) + " is unknown or comes twice";
    if (found->second.group != group)
      return "primitive " + std::to_string(id) + " is in a leaf of another group";
    bounds.extend(box_of(found->second));
    untaken_.erase(found);
    return {};
  }

  std::string all_taken() const {
    if (untaken_.empty()) return {};
    return std::to_string(untaken_.size()) + " primitives are in no leaf";
  }

private:
  std::unordered_map<std::uint32_t, PrimitiveBox> untaken_;
};

class BinaryChecker {
public:
  BinaryChecker(const BinaryTree& tree, const Column<PrimitiveBox>& boxes)
      : tree_(tree), primitives_(boxes) {}

  std::string check() {
    if (tree_.group_of_leaf.size() != tree_.nodes.size()) return "nodes and group_of_leaf differ in length";
    std::size_t met = 0;
    if (!tree_.nodes.empty()) open_.emplace_back(0, 1);
    for (; !open_.empty(); ++met) {
      const auto [index, level] = open_.back();
      open_.pop_back();
      std::string trouble = level > max_tree_depth ? "too many levels" : check_node(index, level);
      if (!trouble.empty()) return "node " + std::to_string(index) + ": " + trouble;
    }
    if (met != tree_.nodes.size()) return "nodes that nothing leads to";
    if (next_primitive_ != tree_.order.size()) return "order holds more than the leaves";
    return primitives_.all_taken();
  }

private:
  std::string check_node(std::uint32_t index, int level) {
    const BinaryNode& node = tree_.nodes[index];
    Aabb bounds;
    if (node.count != 0) {
      std::string trouble = check_leaf(node, tree_.group_of_leaf[index], bounds);
      if (!trouble.empty()) return trouble;
    } else {
      if (node.first <= index || node.first + 1U >= tree_.nodes.size()) return "children out of range";
      if (tree_.group_of_leaf[index] != 0) return "an inner node has a group";
      bounds = box_of(tree_.nodes[node.first]);
      bounds.extend(box_of(tree_.nodes[node.first + 1]));
      open_.emplace_back(node.first + 1, level + 1);
      open_.emplace_back(node.first, level + 1);
    }
    return same(bounds, box_of(node)) ? "" : "its box is not the box around what it holds";
  }

  std::string check_leaf(const BinaryNode& node, std::uint32_t group, Aabb& bounds) {
    if (node.count > block_size * max_leaf_blocks) return "too many primitives in a leaf";
    if (node.first != next_primitive_) return "leaves are not in order";
    if (node.first + std::size_t{node.count} > tree_.order.size()) return "primitives out of range";
    for (; next_primitive_ < node.first + node.count; ++next_primitive_) {
      std::string trouble = primitives_.take(tree_.order[next_primitive_], group, bounds);
      if (!trouble.empty()) return trouble;
    }
    return {};
  }

  const BinaryTree& tree_;
  Primitives primitives_;
  std::vector<std::pair<std::uint32_t, int>> open_;
  std::size_t next_primitive_ = 0;
};

class WideChecker {
public:
  WideChecker(const WideTree& tree, const Column<PrimitiveBox>& boxes) : tree_(tree), primitives_(boxes) {}

  std::string check() {
    if (tree_.root != no_child) {
      open_.push_back({tree_.root, tree_.bounds, 1});
      if (is_leaf(tree_.root)) check_leaf(tree_.root, tree_.bounds);
    } else if (!inverted(tree_.bounds)) {
      return "an empty tree has bounds";
    }
    while (trouble_.empty() && !open_.empty()) {
      const Child child = open_.back();
      open_.pop_back();
      if (!is_leaf(child.index)) check_node(child);
    }
    if (!trouble_.empty()) return trouble_;
    if (next_node_ != tree_.nodes.size()) return "nodes that nothing leads to";
    for (int group = 0; group < max_groups; ++group)
      if (next_block_[group] * block_size != tree_.slots[static_cast<std::size_t>(group)].size())
        return "group " + std::to_string(group) + ": blocks that no leaf has";
    return primitives_.all_taken();
  }

private:
  struct Child {
    std::uint32_t index;
    Aabb bounds;
    int level;
  };

  void check_node(const Child& parent) {
    const std::string name = "node " + std::to_string(parent.index) + ": ";
    if (parent.index != next_node_++) return fail(name + "out of depth-first order");
    if (parent.index >= tree_.nodes.size()) return fail(name + "out of range");
    if (parent.level >= max_tree_depth) return fail(name + "too many levels");
    const WideNode& node = tree_.nodes[parent.index];
    const auto used = std::find(node.child, node.child + wide_children, no_child) - node.child;
    if (used < 2) return fail(name + "fewer than two children");
    if (!std::is_sorted(node.size, node.size + used)) return fail(name + "a child before a smaller one");
    Aabb bounds;
    for (int i = wide_children - 1; i >= 0; --i) {
      const Aabb box = box_of(node, i);
      if (node.child[i] == no_child && !inverted(box)) return fail(name + "an unused child has a box");
      if (i >= used && node.child[i] != no_child) return fail(name + "a gap between its children");
      if (node.child[i] != no_child && box.empty()) return fail(name + "an empty child");
      if (node.child[i] != no_child) open_.push_back({node.child[i], box, parent.level + 1});
      bounds.extend(box);
    }
    if (!same(bounds, parent.bounds)) return fail(name + "its box is not the box around what it holds");
    for (int i = 0; i < used && trouble_.empty(); ++i)
      if (is_leaf(node.child[i])) check_leaf(node.child[i], box_of(node, i));
  }

  void check_leaf(std::uint32_t leaf, const Aabb& box) {
    const std::uint32_t group = leaf_group(leaf);
    const std::string name =
        "block " + std::to_string(leaf_first_block(leaf)) + " of group " + std::to_string(group) + ": ";
    if (leaf_first_block(leaf) != next_block_[group]) return fail(name + "out of order");
    next_block_[group] += leaf_blocks(leaf);
    const Column<std::int32_t>& slots = tree_.slots[group];
    if (next_block_[group] * block_size > slots.size()) return fail(name + "out of range");
    const std::size_t begin = leaf_first_block(leaf) * std::size_t{block_size};
    const std::size_t end = next_block_[group] * block_size;
    Aabb bounds;
    for (std::size_t i = begin; i < end; ++i) {
      if (slots[i] < 0) {
        if (slots[i] != -1 || i <= end - block_size) return fail(name + "an empty block or a wrong filler");
        continue;
      }
      if (i > begin && slots[i - 1] < 0) return fail(name + "a gap between its primitives");
      const std::string trouble = primitives_.take(static_cast<std::uint32_t>(slots[i]), group, bounds);
      if (!trouble.empty()) return fail(name + trouble);
    }
    if (!same(bounds, box)) fail(name + "its box is not the box around what it holds");
  }

  void fail(const std::string& what) {
    if (trouble_.empty()) trouble_ = what;
  }

  const WideTree& tree_;
  Primitives primitives_;
  std::vector<Child> open_;
  std::size_t next_node_ = 0;
  std::size_t next_block_[max_groups] = {};
  std::string trouble_;
};

} // namespace

std::string check_tree(const BinaryTree& tree, const Column<PrimitiveBox>& boxes) {
  return BinaryChecker(tree, boxes).check();
}

std::string check_tree(const WideTree& tree, const Column<PrimitiveBox>& boxes) {
  return WideChecker(tree, boxes).check();
}

} // namespace fastrt
