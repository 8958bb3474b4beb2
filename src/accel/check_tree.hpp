// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/accel/tree.hpp"

#include <string>

namespace fastrt {

// Describe the first broken promise of a tree over `boxes` (in any order); empty if it keeps them all: every
// primitive once, boxes exactly around what they hold, leaves of one group, nodes in depth-first order,
// children by their size, no more than max_tree_depth levels. For tests and debugging: takes its time.
std::string check_tree(const BinaryTree& tree, const Column<PrimitiveBox>& boxes);
std::string check_tree(const WideTree& tree, const Column<PrimitiveBox>& boxes);

} // namespace fastrt
