// SPDX-License-Identifier: Apache-2.0
#include "src/accel/collapse_plan.hpp"

#include "src/accel/half_area.hpp"
#include "src/accel/parallel.hpp"

#include <algorithm>
#include <vector>

namespace fastrt {
namespace {

constexpr std::uint32_t mixed = max_groups;

double half_area(const BinaryNode& node) { return fastrt::half_area(node.lower, node.upper); }

} // namespace

// What lies below a node, and its least cost as at most k children of a wide node, k = 1 .. 7.
struct CollapsePlan::Part {
  double costs[wide_children];
  std::size_t count;
  std::uint32_t group; // of all its primitives, or mixed
};

double CollapsePlan::leaf_cost(double area, std::size_t count) const {
  return area * static_cast<double>((count + run_size_ - 1) / run_size_);
}

CollapsePlan::CollapsePlan(const BinaryTree& tree, const BuildSettings& settings)
    : tree_(tree), run_size_(static_cast<std::size_t>(settings.run_size)), choices_(tree.nodes.size()) {
  // The nodes near the root, breadth first; the last ones have the subtrees that are left to the tasks.
  std::vector<std::uint32_t> nodes{0};
  std::size_t top_count = 0, inner_count = 1;
  std::vector<std::size_t> left_of;
  const std::size_t enough = tasks_for(tree.nodes.size(), settings.threads);
  while (top_count < nodes.size() && inner_count < enough) {
    const BinaryNode& node = tree.nodes[nodes[top_count++]];
    left_of.push_back(nodes.size());
    if (node.count != 0) continue;
    --inner_count;
    for (std::uint32_t side = 0; side < 2; ++side) {
      nodes.push_back(node.first + side);
      inner_count += tree.nodes[node.first + side].count == 0;
    }
  }
  std::vector<Part> parts(nodes.size());
  TaskFailure failure;
  run_tasks(settings.threads, failure, [&] {
    for_each_index(nodes.size() - top_count,
                   [&](std::size_t i) { parts[top_count + i] = solve(nodes[top_count + i]); });
  });
  for (std::size_t i = top_count; i-- > 0;)
    parts[i] = tree.nodes[nodes[i]].count != 0 ? solve_leaf(nodes[i])
                                               : join(nodes[i], parts[left_of[i]], parts[left_of[i] + 1]);
}

CollapsePlan::Part CollapsePlan::solve(std::uint32_t node) {
  const BinaryNode& binary = tree_.nodes[node];
  if (binary.count != 0) return solve_leaf(node);
  const Part left = solve(binary.first);
  return join(node, left, solve(binary.first + 1));
}

CollapsePlan::Part CollapsePlan::solve_leaf(std::uint32_t node) {
  const BinaryNode& binary = tree_.nodes[node];
  choices_[node] = leaf_choice;
  Part part;
  std::fill(part.costs, part.costs + wide_children, leaf_cost(half_area(binary), binary.count));
  part.count = binary.count;
  part.group = tree_.group_of_leaf[node];
  return part;
}

// The recurrence of Ylitie, Karras & Laine (2017), in the number of children that a subtree gives to a wide
// node.
CollapsePlan::Part CollapsePlan::join(std::uint32_t node, const Part& left, const Part& right) {
  double best[wide_children + 1];
  std::uint32_t choices = 0;
  for (int k = 2; k <= wide_children; ++k) {
    best[k] = left.costs[1] + right.costs[k - 1];
    std::uint32_t share = 1;
    for (int j = 2; j < k; ++j) {
      const double cost = left.costs[j] + right.costs[k - j];
      if (!(cost < best[k])) continue;
      best[k] = cost;
      share = static_cast<std::uint32_t>(j);
    }
    choices |= share << (3 * k - 5);
  }
  Part part;
  part.count = left.count + right.count;
  part.group = left.group == right.group ? left.group : mixed;
  const double area = half_area(tree_.nodes[node]);
  part.costs[1] = area + best[wide_children];
  if (part.group != mixed && part.count <= std::size_t{block_size} * max_leaf_blocks &&
      leaf_cost(area, part.count) <= part.costs[1]) {
    part.costs[1] = leaf_cost(area, part.count);
    choices |= leaf_choice;
  }
  for (int k = 2; k < wide_children; ++k) {
    const bool fewer = part.costs[k - 1] < best[k];
    part.costs[k] = fewer ? part.costs[k - 1] : best[k];
    if (fewer) choices &= ~(7U << (3 * k - 5));
  }
  choices_[node] = choices;
  return part;
}

int CollapsePlan::children_of(std::uint32_t node, std::uint32_t children[wide_children]) const {
  int count = 0;
  expand(node, wide_children, children, count);
  return count;
}

void CollapsePlan::expand(std::uint32_t node, int k, std::uint32_t* children, int& count) const {
  if (tree_.nodes[node].count != 0) k = 1;
  while (k > 1 && left_share(node, k) == 0) --k;
  if (k == 1) {
    children[count++] = node;
    return;
  }
  const std::uint32_t first = tree_.nodes[node].first;
  expand(first, left_share(node, k), children, count);
  expand(first + 1, k - left_share(node, k), children, count);
}

} // namespace fastrt
