// SPDX-License-Identifier: Apache-2.0
#include "src/accel/half_area.hpp"
#include "src/accel/tree.hpp"

#include <algorithm>
#include <vector>

namespace fastrt {
namespace {

double child_area(const WideNode& node, int i) {
  return half_area({node.lower_x[i], node.lower_y[i], node.lower_z[i]},
                   {node.upper_x[i], node.upper_y[i], node.upper_z[i]});
}

double visits(std::uint32_t child, int run_size) {
  const int blocks = run_size / block_size;
  return is_leaf(child) ? (static_cast<int>(leaf_blocks(child)) + blocks - 1) / blocks : 1;
}

double visits(const BinaryNode& node) { return node.count == 0 ? 1 : node.count; }

} // namespace

double sah_cost(const WideTree& tree, int run_size) {
  if (tree.root == no_child) return 0;
  const double root_area = half_area(tree.bounds);
  double sum = 0;
  for (const WideNode& node : tree.nodes)
    for (int i = 0; i < wide_children && node.child[i] != no_child; ++i)
      sum += child_area(node, i) * visits(node.child[i], run_size);
  return visits(tree.root, run_size) + (root_area > 0 ? sum / root_area : 0);
}

int tree_depth(const WideTree& tree) {
  if (tree.root == no_child) return 0;
  if (is_leaf(tree.root)) return 1;
  // Depth first means that parents come before their children.
  std::vector<int> level(tree.nodes.size(), 1);
  int depth = 1;
  for (std::size_t n = 0; n < tree.nodes.size(); ++n)
    for (int i = 0; i < wide_children && tree.nodes[n].child[i] != no_child; ++i) {
      const std::uint32_t child = tree.nodes[n].child[i];
      depth = std::max(depth, level[n] + 1);
      if (!is_leaf(child)) level[child] = level[n] + 1;
    }
  return depth;
}

std::size_t leaf_count(const WideTree& tree) {
  if (tree.root == no_child) return 0;
  std::size_t count = is_leaf(tree.root) ? 1 : 0;
  for (const WideNode& node : tree.nodes)
    for (const std::uint32_t child : node.child)
      if (child != no_child && is_leaf(child)) ++count;
  return count;
}

double sah_cost(const BinaryTree& tree) {
  if (tree.nodes.empty()) return 0;
  const double root_area = half_area(tree.nodes[0].lower, tree.nodes[0].upper);
  double sum = 0;
  for (std::size_t n = 1; n < tree.nodes.size(); ++n)
    sum += half_area(tree.nodes[n].lower, tree.nodes[n].upper) * visits(tree.nodes[n]);
  return visits(tree.nodes[0]) + (root_area > 0 ? sum / root_area : 0);
}

int tree_depth(const BinaryTree& tree) {
  // Parents come before their children.
  std::vector<int> level(tree.nodes.size(), 1);
  int depth = 0;
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    depth = std::max(depth, level[n]);
    const BinaryNode& node = tree.nodes[n];
    if (node.count == 0) level[node.first] = level[node.first + 1] = level[n] + 1;
  }
  return depth;
}

std::size_t leaf_count(const BinaryTree& tree) {
  std::size_t count = 0;
  for (const BinaryNode& node : tree.nodes) count += node.count != 0 ? 1U : 0U;
  return count;
}

} // namespace fastrt
