// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/accel/tree.hpp"

namespace fastrt {

// Moves subtrees of a binary tree to where the sum of all boxes' areas is least (after Meister & Bittner
// 2018, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization"), in rounds. Leaves keep their
// primitives; nodes and leaves are in depth-first order before and afterwards, on at most max_tree_depth
// levels. The result is the same for any number of threads.
void reinsert_subtrees(BinaryTree& tree, const BuildSettings& settings);

// The same in a small part of the time, among the largest nodes alone and only if there is much to gain:
// where large primitives lie among small ones.
void reinsert_largest_subtrees(BinaryTree& tree, const BuildSettings& settings);

} // namespace fastrt
