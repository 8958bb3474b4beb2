// SPDX-License-Identifier: Apache-2.0
// The checker of trees finds what is planted for it.
#include "src/accel/check_tree.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace fastrt {
namespace {

Column<PrimitiveBox> row_of_boxes() {
  Column<PrimitiveBox> boxes;
  for (std::uint32_t i = 0; i < 101; ++i) {
    const auto x = static_cast<float>(i);
    boxes.push_back({{x, 0, 0}, i, {x + 1, 1, 1}, i % 10 == 0 ? 1U : 0U});
  }
  return boxes;
}

class CheckTree : public testing::Test {
protected:
  CheckTree() : boxes_(row_of_boxes()) {
    Column<PrimitiveBox> scratch = boxes_;
    binary_ = build_binary_tree(scratch, {});
    wide_ = collapse(binary_, {});
  }

  std::uint32_t first_leaf() const {
    std::uint32_t i = 0;
    while (binary_.nodes[i].count == 0) ++i;
    return i;
  }
  // A slot that holds no primitive.
  std::size_t filler() const {
    std::size_t i = 0;
    while (wide_.slots[0][i] >= 0) ++i;
    return i;
  }
  std::string binary() const { return check_tree(binary_, boxes_); }
  std::string wide() const { return check_tree(wide_, boxes_); }

  Column<PrimitiveBox> boxes_;
  BinaryTree binary_;
  WideTree wide_;
};

TEST_F(CheckTree, accepts_what_is_right) {
  EXPECT_EQ(binary(), "");
  EXPECT_EQ(wide(), "");
  EXPECT_EQ(check_tree(BinaryTree{}, {}), "");
  EXPECT_EQ(check_tree(WideTree{}, {}), "");
}

TEST_F(CheckTree, misses_primitives) {
  EXPECT_NE(check_tree(BinaryTree{}, boxes_), "");
  EXPECT_NE(check_tree(WideTree{}, boxes_), "");
  boxes_.push_back({{0, 0, 0}, 999, {1, 1, 1}, 0});
  EXPECT_NE(binary(), "");
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_a_primitive_that_comes_twice) {
  binary_.order[1] = binary_.order[0];
  wide_.slots[0][1] = wide_.slots[0][0];
  EXPECT_NE(binary(), "");
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_a_box_too_small) {
  binary_.nodes[first_leaf()].upper[1] = 0.5F;
  wide_.nodes[0].upper_y[0] = 0.5F;
  EXPECT_NE(binary(), "");
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_bounds_too_large) {
  binary_.nodes[0].upper[1] = 2;
  wide_.bounds.upper.y = 2;
  EXPECT_NE(binary(), "");
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_a_leaf_of_the_wrong_group) {
  binary_.group_of_leaf[first_leaf()] ^= 1U;
  EXPECT_NE(binary(), "");
  for (std::uint32_t& child : wide_.nodes[0].child)
    if (child != no_child && is_leaf(child)) child ^= 1U << 28U;
  for (WideNode& node : wide_.nodes)
    for (std::uint32_t& child : node.child)
      if (child != no_child && is_leaf(child)) child ^= 1U << 28U;
  std::swap(wide_.slots[0], wide_.slots[1]);
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_children_out_of_range) {
  binary_.nodes[0].first = static_cast<std::uint32_t>(binary_.nodes.size());
  EXPECT_NE(binary(), "");
  wide_.root = static_cast<std::uint32_t>(wide_.nodes.size());
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_nodes_and_blocks_that_nothing_leads_to) {
  binary_.nodes.push_back(binary_.nodes.back());
  binary_.group_of_leaf.push_back(0);
  EXPECT_NE(binary(), "");
  WideTree spare_node = wide_;
  spare_node.nodes.resize(wide_.nodes.size() + 1);
  spare_node.nodes.back() = wide_.nodes.back();
  EXPECT_NE(check_tree(spare_node, boxes_), "");
  for (int i = 0; i < block_size; ++i) wide_.slots[3].push_back(-1);
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_order_that_no_leaf_has) {
  binary_.order.push_back(7);
  EXPECT_NE(binary(), "");
}

TEST_F(CheckTree, finds_ill_formed_blocks) {
  WideTree gap = wide_;
  std::swap(gap.slots[0][filler()], gap.slots[0][filler() - 1]);
  if (filler() % block_size != 1) {
    EXPECT_NE(check_tree(gap, boxes_), "");
  }
  wide_.slots[0][filler()] = -2;
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_ill_formed_unused_children) {
  WideNode* node = wide_.nodes.begin();
  while (node->child[wide_children - 1] != no_child) ++node;
  node->upper_x[wide_children - 1] = 0;
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_a_gap_between_children) {
  wide_.nodes[0].child[1] = no_child;
  EXPECT_NE(wide(), "");
}

TEST_F(CheckTree, finds_too_many_levels) {
  BinaryTree chain;
  Column<PrimitiveBox> boxes;
  for (std::uint32_t i = 0; i < max_tree_depth; ++i) {
    boxes.push_back({{0, 0, 0}, i, {1, 1, 1}, 0});
    chain.order.push_back(i);
    const BinaryNode leaf{{0, 0, 0}, i, {1, 1, 1}, 1};
    if (i + 1 == max_tree_depth) {
      chain.nodes.push_back(leaf);
    } else {
      if (i == 0) chain.nodes.push_back({});
      chain.nodes.back() = {{0, 0, 0}, 2 * i + 1, {1, 1, 1}, 0};
      chain.nodes.push_back(leaf);
      if (i + 2 != max_tree_depth) chain.nodes.push_back({});
    }
  }
  chain.group_of_leaf.resize(chain.nodes.size(), 0);
  EXPECT_EQ(check_tree(chain, boxes), "");
  const auto last = static_cast<std::uint32_t>(chain.nodes.size());
  chain.nodes[last - 1] = {{0, 0, 0}, last, {1, 1, 1}, 0};
  chain.nodes.push_back({{0, 0, 0}, max_tree_depth - 1, {1, 1, 1}, 1});
  chain.nodes.push_back({{0, 0, 0}, max_tree_depth, {1, 1, 1}, 1});
  chain.group_of_leaf.resize(chain.nodes.size(), 0);
  chain.order.push_back(max_tree_depth);
  boxes.push_back({{0, 0, 0}, max_tree_depth, {1, 1, 1}, 0});
  EXPECT_NE(check_tree(chain, boxes).find("too many levels"), std::string::npos);
}

} // namespace
} // namespace fastrt
