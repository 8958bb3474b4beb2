// SPDX-License-Identifier: Apache-2.0
#include "src/accel/tree.hpp"

#include <algorithm>
#include <vector>

namespace fastrt {
namespace {

double area(double x, double y, double z) { return 2 * (x * y + y * z + z * x); }

double child_area(const WideNode& node, int i) {
  return area(static_cast<double>(node.upper_x[i]) - static_cast<double>(node.lower_x[i]),
              static_cast<double>(node.upper_y[i]) - static_cast<double>(node.lower_y[i]),
              static_cast<double>(node.upper_z[i]) - static_cast<double>(node.lower_z[i]));
}

double visits(std::uint32_t child, int run_size) {
  const int blocks = run_size / block_size;
  return is_leaf(child) ? (static_cast<int>(leaf_blocks(child)) + blocks - 1) / blocks : 1;
}

} // namespace

double sah_cost(const WideTree& tree, int run_size) {
  if (tree.root == no_child) return 0;
  const Vec3 lower = tree.bounds.lower, upper = tree.bounds.upper;
  const double root_area = area(static_cast<double>(upper.x) - static_cast<double>(lower.x),
                                static_cast<double>(upper.y) - static_cast<double>(lower.y),
                                static_cast<double>(upper.z) - static_cast<double>(lower.z));
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

} // namespace fastrt
