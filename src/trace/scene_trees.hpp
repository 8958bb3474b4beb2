// SPDX-License-Identifier: Apache-2.0
// The scene's wide trees: one over what is in the world, its instances included, and one over each prototype.
#pragma once

#include "src/accel/tree.hpp"

#include <fastrt/scene.hpp>
#include <fastrt/tracer.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastrt {

// Trees of fewer primitives are built by one thread: the builder would give no other thread anything to do,
// and beside other programs a team waits for its last thread's turn, ten milliseconds and more.
inline constexpr std::size_t parallel_build_from = serial_build_range + 1;

struct PrototypeTree {
  std::uint32_t root;       // among the nodes of all; no_child of an empty prototype
  float largest_coordinate; // of any box in it
};

// All trees in one list of nodes and one of slots; `all.root` and `all.bounds` are the world's.
struct SceneTrees {
  WideTree all;
  std::vector<PrototypeTree> prototypes;
  BvhStats stats; // of the trees alone: not the blocks' number and bytes
};

// Of one tree.
struct TreeStats {
  double sah_cost;
  std::size_t nodes, leaves;
  int depth;
};

// Of the scene's trees together, but for blocks and bytes. bounds: of the world's.
BvhStats stats_of(const Scene& scene, const TreeStats& world, const std::vector<TreeStats>& prototypes,
                  const Aabb& bounds);

// Throws LimitError for too many blocks.
SceneTrees build_scene_trees(const Scene& scene, const BuildSettings& settings);

// The largest |coordinate| of a box, 0 of an empty one.
float largest_magnitude(const Aabb& box);

} // namespace fastrt
