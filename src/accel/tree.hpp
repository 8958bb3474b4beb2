// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/accel/wide_node.hpp"

#include <fastrt/bvh_quality.hpp>
#include <fastrt/column.hpp>
#include <fastrt/math.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastrt {

// What the builder knows of a primitive: its box, its id, and the group that it may share a leaf with.
struct PrimitiveBox {
  float lower[3];
  std::uint32_t id;
  float upper[3];
  std::uint32_t group;
};
static_assert(sizeof(PrimitiveBox) == 32);

// A node of the binary tree. count == 0: inner, its children are nodes[first] and nodes[first + 1].
// Otherwise a leaf: primitives order[first] .. order[first + count - 1], all of one group.
struct BinaryNode {
  float lower[3];
  std::uint32_t first;
  float upper[3];
  std::uint32_t count;
};
static_assert(sizeof(BinaryNode) == 32);

// nodes[0] is the root; no nodes at all when there are no primitives.
struct BinaryTree {
  Column<BinaryNode> nodes;
  Column<std::uint32_t> order;        // primitive ids, grouped by leaf
  Column<std::uint8_t> group_of_leaf; // per node: the leaf's group; 0 for inner nodes
};

// Up to so many primitives the builder leaves to one thread.
inline constexpr std::size_t serial_build_range = std::size_t{1} << 12U;

struct BuildSettings {
  int threads = 0;  // 0 takes every core. The tree is the same for any number.
  int run_size = 8; // primitives that are met at once, 4 or 8: what the tree's cost counts
  BvhQuality quality = BvhQuality::standard;
};

// A binary tree by binned SAH (Wald 2007) over boxes and centroids, whose cost counts runs of run_size
// primitives, not primitives; nodes are in depth-first order. Leaves hold 1 .. block_size * max_leaf_blocks
// primitives of one group; at most max_tree_depth levels. Uses `boxes` up: there are none afterwards. Boxes
// must be finite.
BinaryTree split_boxes(Column<PrimitiveBox>& boxes, const BuildSettings& settings);

// The same, with nodes then moved about: of high quality all, otherwise the largest and only where it pays.
// See reinsertion.hpp.
BinaryTree build_binary_tree(Column<PrimitiveBox>& boxes, const BuildSettings& settings);

// The wide tree: nodes in depth-first order, and for each group the primitive ids of its blocks, block_size a
// block, -1 where a block is not full. The root is a child like any other: a node or, for few primitives, a
// leaf.
struct WideTree {
  Column<WideNode> nodes;
  std::array<Column<std::int32_t>, max_groups> slots;
  std::uint32_t root = no_child; // no_child: the tree is empty
  Aabb bounds;
};

// Collapses a binary tree to the wide one of least sah_cost that can be made of its boxes. A leaf may take in
// several leaves of the binary tree. Throws LimitError for more than max_blocks blocks of a group.
WideTree collapse(const BinaryTree& tree, const BuildSettings& settings);

// SAH cost of the wide tree: sum over nodes of area / root area (one visit each), and over leaves of
// area * runs / root area. Units: one node visit = one run of primitives = 1.
double sah_cost(const WideTree& tree, int run_size = 8);
int tree_depth(const WideTree& tree);
std::size_t leaf_count(const WideTree& tree);

// The same of a binary tree, whose primitives are met one by one: each costs 1.
double sah_cost(const BinaryTree& tree);
int tree_depth(const BinaryTree& tree);
std::size_t leaf_count(const BinaryTree& tree);

} // namespace fastrt
