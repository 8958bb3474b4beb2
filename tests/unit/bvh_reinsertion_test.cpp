// SPDX-License-Identifier: Apache-2.0
#include "src/accel/check_tree.hpp"
#include "src/accel/linked_tree.hpp"
#include "src/accel/reinsertion.hpp"
#include "tests/unit/bvh_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace fastrt {
namespace {

BuildSettings high_quality(int threads = 0) {
  BuildSettings settings;
  settings.threads = threads;
  settings.quality = BvhQuality::high;
  return settings;
}

BinaryTree build(Column<PrimitiveBox> boxes, const BuildSettings& settings) {
  return build_binary_tree(boxes, settings);
}

// What reinsertion makes less: the half areas of all boxes, leaves' too, which stay as they are.
double cost(const BinaryTree& tree) {
  double sum = 0;
  for (const BinaryNode& node : tree.nodes) {
    double side[3];
    for (int axis = 0; axis < 3; ++axis)
      side[axis] = static_cast<double>(node.upper[axis]) - static_cast<double>(node.lower[axis]);
    sum += side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
  }
  return sum;
}

// The primitives of each leaf, in the order of their first one.
std::vector<std::vector<std::uint32_t>> leaves(const BinaryTree& tree) {
  std::vector<std::vector<std::uint32_t>> result;
  for (const BinaryNode& node : tree.nodes) {
    const std::uint32_t* first = tree.order.data() + node.first;
    if (node.count != 0) result.emplace_back(first, first + node.count);
  }
  std::sort(result.begin(), result.end());
  return result;
}

class ReinsertionOf : public testing::TestWithParam<Case> {};

TEST_P(ReinsertionOf, keeps_what_a_tree_promises_and_its_leaves) {
  const Column<PrimitiveBox> boxes = GetParam().boxes();
  const BinaryTree standard = build(boxes, {}), high = build(boxes, high_quality());
  EXPECT_EQ(check_tree(high, boxes), "");
  EXPECT_TRUE(leaves(high) == leaves(standard));
  EXPECT_LE(cost(high), cost(standard) * (1 + 1e-12));
  const WideTree wide = collapse(high, high_quality());
  EXPECT_EQ(check_tree(wide, boxes), "");
}

TEST_P(ReinsertionOf, is_the_same_for_any_number_of_threads) {
  const Column<PrimitiveBox> boxes = GetParam().boxes();
  const BinaryTree tree = build(boxes, high_quality(1));
  for (const int threads : {2, 8}) {
    const BinaryTree again = build(boxes, high_quality(threads));
    EXPECT_TRUE(bytes(tree.nodes) == bytes(again.nodes));
    EXPECT_TRUE(bytes(tree.order) == bytes(again.order));
    EXPECT_TRUE(bytes(tree.group_of_leaf) == bytes(again.group_of_leaf));
  }
}

INSTANTIATE_TEST_SUITE_P(Bvh, ReinsertionOf, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Reinsertion, takes_any_small_count) {
  for (std::size_t count = 0; count <= 100; ++count) {
    const Column<PrimitiveBox> boxes = Case{"", count, random_box}.boxes();
    EXPECT_EQ(check_tree(build(boxes, high_quality(1)), boxes), "") << count;
  }
}

TEST(Reinsertion, makes_a_tree_of_boxes_of_all_sizes_cheaper) {
  const auto long_box = [](std::size_t i, Random& r) {
    PrimitiveBox box = box_around(r(-1, 1), r(-1, 1), r(-1, 1), 0.002F, i);
    box.upper[i % 3] += i % 5 == 0 ? 0.5F : 0.0F;
    return box;
  };
  const Column<PrimitiveBox> boxes = Case{"", 5000, long_box}.boxes();
  const WideTree standard = collapse(build(boxes, {}), {});
  const WideTree high = collapse(build(boxes, high_quality()), {});
  EXPECT_LT(sah_cost(high), 0.98 * sah_cost(standard));
}

// One primitive a leaf, at the end of its own branch of a chain of so many levels.
BinaryTree chain(const Column<PrimitiveBox>& boxes) {
  BinaryTree tree;
  const auto count = static_cast<std::uint32_t>(boxes.size());
  for (std::uint32_t i = 0; i < 2 * count - 1; ++i) tree.nodes.push_back({{}, i + 1, {}, 0});
  tree.group_of_leaf.resize(tree.nodes.size(), 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    tree.order.push_back(i);
    const std::size_t leaf = i + 1 == count ? 2 * i : 2 * i + 1;
    tree.nodes[leaf].first = i;
    tree.nodes[leaf].count = 1;
  }
  for (std::uint32_t i = 0; i + 1 < count; ++i) tree.nodes[2 * i].first = 2 * i + 1;
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    BinaryNode& node = tree.nodes[i];
    for (int axis = 0; axis < 3; ++axis) {
      const BinaryNode *a = &tree.nodes[node.first], *b = a + 1;
      node.lower[axis] =
          node.count != 0 ? boxes[node.first].lower[axis] : std::min(a->lower[axis], b->lower[axis]);
      node.upper[axis] =
          node.count != 0 ? boxes[node.first].upper[axis] : std::max(a->upper[axis], b->upper[axis]);
    }
  }
  return tree;
}

TEST(Reinsertion, shortens_a_chain_as_deep_as_trees_may_be) {
  const Column<PrimitiveBox> boxes = Case{"", max_tree_depth, random_box}.boxes();
  BinaryTree tree = chain(boxes);
  ASSERT_EQ(check_tree(tree, boxes), "");
  const double before = cost(tree);
  reinsert_subtrees(tree, high_quality());
  EXPECT_EQ(check_tree(tree, boxes), "");
  EXPECT_LT(cost(tree), 0.9 * before);
}

TEST(LinkedTree, takes_moves_back) {
  const Column<PrimitiveBox> boxes = Case{"", 300, random_box}.boxes();
  const BinaryTree tree = build(boxes, {});
  LinkedTree linked(tree);
  std::size_t moves = 0;
  for (std::uint32_t node = 0; node < linked.size(); ++node) {
    for (std::uint32_t target = 0; target < linked.size(); ++target) {
      if (!linked.can_move(node, target)) continue;
      const std::uint32_t sibling = linked.sibling(node);
      const double growth = linked.move(node, target);
      ASSERT_EQ(linked.sibling(node), target);
      const BinaryTree moved = linked.in_order(tree);
      ASSERT_EQ(check_tree(moved, boxes), "") << node << ' ' << target;
      ++moves;
      ASSERT_NEAR(cost(moved) - cost(tree), growth, 1e-9);
      linked.move(node, sibling);
    }
  }
  EXPECT_GT(moves, 1000U);
  EXPECT_NEAR(cost(linked.in_order(tree)), cost(tree), 1e-9);
}

TEST(LinkedTree, refuses_what_makes_no_tree_or_one_too_deep) {
  const Column<PrimitiveBox> boxes = Case{"", max_tree_depth, random_box}.boxes();
  const LinkedTree linked(chain(boxes));
  const std::uint32_t lowest = 2 * max_tree_depth - 2; // the right one of the two lowest leaves
  EXPECT_FALSE(linked.can_move(0, 9));                 // the root
  EXPECT_FALSE(linked.can_move(1, 9));                 // its children
  EXPECT_FALSE(linked.can_move(3, 0));
  EXPECT_FALSE(linked.can_move(3, 2));      // below its parent already
  EXPECT_FALSE(linked.can_move(3, 4));      // beside its sibling already
  EXPECT_FALSE(linked.can_move(4, lowest)); // into itself
  EXPECT_FALSE(linked.can_move(3, lowest)); // a level too many
  EXPECT_TRUE(linked.can_move(lowest, 3));
}

} // namespace
} // namespace fastrt
