// SPDX-License-Identifier: Apache-2.0
#include "src/trace/scene_trees.hpp"

#include "src/accel/half_area.hpp"
#include "src/scene/shapes.hpp"
#include "src/trace/primitive_boxes.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace fastrt {
namespace {

// The binary tree is let go as soon as the wide one has been made of it.
WideTree build_tree(Column<PrimitiveBox> boxes, BuildSettings settings) {
  if (boxes.size() < parallel_build_from) settings.threads = 1;
  const BinaryTree binary = build_binary_tree(boxes, settings);
  return collapse(binary, settings);
}

// A child of a tree whose nodes and blocks are moved behind those of `all`.
std::uint32_t moved(std::uint32_t child, const WideTree& all) {
  if (child == no_child) return child;
  if (!is_leaf(child)) return child + static_cast<std::uint32_t>(all.nodes.size());
  return child + static_cast<std::uint32_t>(all.slots[leaf_group(child)].size() / block_size);
}

// Puts a tree behind the others; returns its root there.
std::uint32_t append(WideTree& all, WideTree tree) {
  for (std::size_t group = 0; group < max_groups; ++group)
    if ((all.slots[group].size() + tree.slots[group].size()) / block_size > max_blocks)
      throw LimitError("too many primitives for one tree: more than " + std::to_string(max_blocks) +
                       " blocks");
  for (WideNode& node : tree.nodes)
    for (std::uint32_t& child : node.child) child = moved(child, all);
  const std::uint32_t root = moved(tree.root, all);
  all.nodes.append(tree.nodes.data(), tree.nodes.size());
  for (std::size_t group = 0; group < max_groups; ++group)
    all.slots[group].append(tree.slots[group].data(), tree.slots[group].size());
  return root;
}

TreeStats stats_of(const WideTree& tree, int run_size) {
  return {sah_cost(tree, run_size), tree.nodes.size(), leaf_count(tree), tree_depth(tree)};
}

// A ray that meets an instance's box goes through its prototype's tree.
double cost_of_instances(const Scene& scene, const std::vector<TreeStats>& prototypes, const Aabb& bounds) {
  double sum = 0;
  for (std::size_t i = 0; i < scene.instance_count(); ++i)
    sum +=
        half_area(scene.shapes().instances[i].box) * prototypes[scene.desc().instances.prototype[i]].sah_cost;
  return half_area(bounds) > 0 ? sum / half_area(bounds) : 0.0;
}

} // namespace

float largest_magnitude(const Aabb& box) {
  if (box.empty()) return 0.0F;
  const Vec3 v = glm::max(glm::abs(box.lower), glm::abs(box.upper));
  return std::fmax(v.x, std::fmax(v.y, v.z));
}

BvhStats stats_of(const Scene& scene, const TreeStats& world, const std::vector<TreeStats>& prototypes,
                  const Aabb& bounds) {
  BvhStats stats;
  stats.node_count = world.nodes;
  stats.leaf_count = world.leaves;
  int depth = 0;
  for (const TreeStats& prototype : prototypes) {
    stats.node_count += prototype.nodes;
    stats.leaf_count += prototype.leaves;
    depth = std::max(depth, prototype.depth);
  }
  stats.sah_cost = world.sah_cost + cost_of_instances(scene, prototypes, bounds);
  stats.depth = world.depth + depth;
  return stats;
}

SceneTrees build_scene_trees(const Scene& scene, const BuildSettings& settings) {
  SceneTrees trees;
  trees.all = build_tree(world_boxes(scene), settings);
  const TreeStats world = stats_of(trees.all, settings.run_size);
  std::vector<TreeStats> prototypes;
  for (const Prototype& prototype : scene.desc().prototypes) {
    WideTree tree = build_tree(prototype_boxes(scene, prototype), settings);
    prototypes.push_back(stats_of(tree, settings.run_size));
    const float largest = largest_magnitude(tree.bounds);
    trees.prototypes.push_back({append(trees.all, std::move(tree)), largest});
  }
  trees.stats = stats_of(scene, world, prototypes, trees.all.bounds);
  return trees;
}

} // namespace fastrt
