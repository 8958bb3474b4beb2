// SPDX-License-Identifier: Apache-2.0
// The builder's inner parts: what they share, and the two that build a subtree on one thread.
#pragma once

#include "src/accel/bins.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace fastrt {

// The same for all of a subtree.
struct BuildContext {
  std::uint32_t* order;     // where leaves put their primitives' ids, as long as a buffer
  PrimitiveBox* buffers[2]; // primitives travel between the two, one way per level
  __m128 scale;             // of areas
  bool one_group;           // all primitives are of one group
  int run_log2 = 3;         // of the primitives that are met at once
};

// Nodes below some node, numbered from 0 in the order they are made; every child comes after its parent.
struct NodeList {
  Column<BinaryNode> nodes;
  Column<std::uint8_t> groups;

  std::uint32_t add_pair() {
    const std::size_t first = nodes.size();
    if (nodes.size() + 2 > nodes_reserved) reserve(nodes_reserved + nodes_reserved / 2);
    nodes.resize(first + 2);
    groups.resize(first + 2);
    return static_cast<std::uint32_t>(first);
  }
  void clear() {
    nodes.clear();
    groups.clear();
  }

private:
  void reserve(std::size_t count) {
    nodes_reserved = count < 64 ? 64 : count;
    nodes.reserve(nodes_reserved);
    groups.reserve(nodes_reserved);
  }

  std::size_t nodes_reserved = 0;
};

// A node with the group of its leaf, not yet in a list.
struct GroupedNode {
  BinaryNode node;
  std::uint8_t group = 0;
};

// Primitives begin .. end - 1 of one of the two buffers, to become one node.
struct BuildRange {
  std::size_t begin = 0, end = 0;
  LaneBox bounds;
  LaneBox centroids;  // doubled ones lie in here
  bool tight = false; // `centroids` is as small as can be
  int buffer = 0;
  int level = 1;

  std::size_t size() const { return end - begin; }
};

// Whether only halving from here on keeps to max_tree_depth: another uneven split might need a level too
// many.
inline bool must_halve(int level, std::size_t count) {
  return level + 1 + static_cast<int>(std::bit_width(count - 1)) > max_tree_depth;
}

inline GroupedNode make_node(const LaneBox& bounds, std::size_t first, std::size_t count,
                             std::uint32_t group) {
  GroupedNode made;
  _mm_storeu_ps(made.node.lower, bounds.lower);
  _mm_storeu_ps(made.node.upper, bounds.upper);
  made.node.first = static_cast<std::uint32_t>(first);
  made.node.count = static_cast<std::uint32_t>(count);
  made.group = static_cast<std::uint8_t>(group);
  return made;
}

inline void put_node(NodeList& list, std::uint32_t index, const GroupedNode& made) {
  list.nodes[index] = made.node;
  list.groups[index] = made.group;
}

// Ranges up to this size are split by sorting, not by binning.
inline constexpr std::size_t small_range = 32;

// Builds the nodes below a range of at most small_range primitives into `list` and returns the range's own.
GroupedNode build_small_range(const BuildContext& context, const BuildRange& range, NodeList& list);

// The same for any range; `bins` holds its primitives as BinMapping(range.centroids) puts them.
GroupedNode build_range(const BuildContext& context, const BuildRange& range, const Bins& bins,
                        NodeList& list);

// When so few bins of the best axis are in use, the centroids lie closer together than was thought.
inline constexpr int few_bins = bin_count / 4;

// The first or second half of a range; its bounds are still those of the whole.
BuildRange half_of(const BuildRange& range, std::uint32_t side);

// How the two sides of a split go on.
struct SplitSides {
  BuildRange ranges[2];
  BinMapping mappings[2];
  std::size_t next[2]; // where the side's next primitive goes
};

// The ranges on both sides of a plane between the bins of `range`.
SplitSides split_sides(const BuildRange& range, const Bins& bins, const BinSplit& split);

} // namespace fastrt
