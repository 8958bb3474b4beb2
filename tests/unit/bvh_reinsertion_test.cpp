// SPDX-License-Identifier: Apache-2.0
#include "src/accel/check_tree.hpp"
#include "src/accel/linked_tree.hpp"
#include "src/accel/reinsertion.hpp"
#include "src/accel/tree_top.hpp"
#include "tests/unit/bvh_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace fastrt {
namespace {

constexpr BvhQuality qualities[] = {BvhQuality::standard, BvhQuality::high};

BinaryTree build(Column<PrimitiveBox> boxes, BvhQuality quality, int threads = 0) {
  return build_binary_tree(boxes, {.threads = threads, .quality = quality});
}

// What reinsertion starts from.
BinaryTree split(Column<PrimitiveBox> boxes) { return split_boxes(boxes, {}); }

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
  const BinaryTree before = split(boxes);
  for (const BvhQuality quality : qualities) {
    const BinaryTree tree = build(boxes, quality);
    EXPECT_EQ(check_tree(tree, boxes), "");
    EXPECT_TRUE(leaves(tree) == leaves(before));
    EXPECT_LE(cost(tree), cost(before) * (1 + 1e-12));
    EXPECT_EQ(check_tree(collapse(tree, {}), boxes), "");
  }
}

void expect_same(const BinaryTree& a, const BinaryTree& b) {
  EXPECT_TRUE(bytes(a.nodes) == bytes(b.nodes));
  EXPECT_TRUE(bytes(a.order) == bytes(b.order));
  EXPECT_TRUE(bytes(a.group_of_leaf) == bytes(b.group_of_leaf));
}

void expect_same_for_any_number_of_threads(const Column<PrimitiveBox>& boxes, BvhQuality quality) {
  const BinaryTree tree = build(boxes, quality, 1);
  for (const int threads : {2, 8}) expect_same(tree, build(boxes, quality, threads));
}

TEST_P(ReinsertionOf, is_the_same_for_any_number_of_threads) {
  for (const BvhQuality quality : qualities)
    expect_same_for_any_number_of_threads(GetParam().boxes(), quality);
}

INSTANTIATE_TEST_SUITE_P(Bvh, ReinsertionOf, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Reinsertion, takes_any_small_count) {
  for (std::size_t count = 0; count <= 100; ++count) {
    const Column<PrimitiveBox> boxes = Case{"", count, random_box}.boxes();
    for (const BvhQuality quality : qualities)
      EXPECT_EQ(check_tree(build(boxes, quality, 1), boxes), "") << count;
  }
}

// Beams among pebbles, one in 50: splitting by centroids cannot tell them apart.
Column<PrimitiveBox> beams_among_pebbles(std::size_t count, float length) {
  const auto beam_or_pebble = [length](std::size_t i, Random& r) {
    const float z = r(-1, 1), y = r(-1, 1), x = r(-1, 1); // in this order, whatever the compiler
    PrimitiveBox box = box_around(x, y, z, 0.002F, i);
    box.upper[i % 3] += i % 50 == 0 ? length : 0.0F;
    return box;
  };
  return Case{"", count, beam_or_pebble}.boxes();
}

TEST(Reinsertion, makes_a_tree_of_boxes_of_all_sizes_cheaper) {
  const Column<PrimitiveBox> boxes = beams_among_pebbles(5000, 1.5F);
  const double before = sah_cost(collapse(split(boxes), {}));
  EXPECT_LT(sah_cost(collapse(build(boxes, BvhQuality::standard), {})), 0.97 * before);
  EXPECT_LT(sah_cost(collapse(build(boxes, BvhQuality::high), {})), 0.88 * before); // one round: 0.89
}

TEST(Reinsertion, of_the_largest_leaves_a_tree_alone_that_has_little_to_gain) {
  const Column<PrimitiveBox> boxes = beams_among_pebbles(20000, 0.5F);
  expect_same(build(boxes, BvhQuality::standard), split(boxes));
  EXPECT_LT(cost(build(boxes, BvhQuality::high)), cost(split(boxes)));
}

// So many that the search for the best places of the largest takes several tasks on several threads.
TEST(Reinsertion, of_the_largest_of_many_is_the_same_for_any_number_of_threads) {
  const Column<PrimitiveBox> boxes = beams_among_pebbles(260'000, 1.5F);
  ASSERT_LT(cost(build(boxes, BvhQuality::standard)), cost(split(boxes)));
  expect_same_for_any_number_of_threads(boxes, BvhQuality::standard);
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
  BinaryTree largest = tree;
  const double before = cost(tree);
  reinsert_subtrees(tree, {});
  EXPECT_EQ(check_tree(tree, boxes), "");
  EXPECT_LT(cost(tree), 0.9 * before);
  reinsert_largest_subtrees(largest, {});
  EXPECT_EQ(check_tree(largest, boxes), "");
  EXPECT_LT(cost(largest), before);
}

TEST(TreeTop, with_what_was_below_is_the_tree_again) {
  for (const Case& c : cases) {
    if (c.count > 50'000) continue;
    const Column<PrimitiveBox> boxes = c.boxes();
    const BinaryTree tree = split(boxes);
    for (const std::size_t count : {1U, 2U, 3U, 10U, 101U, 1000'000U}) {
      const TreeTop top(tree, count);
      EXPECT_LE(top.tree().nodes.size(), count);
      expect_same(top.below(top.tree()), tree);
    }
    EXPECT_EQ(TreeTop(tree, tree.nodes.size()).tree().nodes.size(), tree.nodes.size()) << c.name;
  }
}

double half_area(const BinaryNode& node) {
  BinaryTree one;
  one.nodes.push_back(node);
  return cost(one);
}

TEST(TreeTop, has_the_largest_nodes) {
  const BinaryTree tree = split(beams_among_pebbles(5000, 1.5F));
  const TreeTop top(tree, 201);
  ASSERT_EQ(top.tree().nodes.size(), 201U);
  double smallest_inner = infinity, largest_left_out = 0;
  for (const BinaryNode& node : top.tree().nodes) {
    if (node.count == 0) {
      smallest_inner = std::min(smallest_inner, half_area(node));
    } else if (const BinaryNode& whole = tree.nodes[top.tree().order[node.first]]; whole.count == 0) {
      largest_left_out = std::max(largest_left_out, half_area(whole));
    }
  }
  EXPECT_GE(smallest_inner, largest_left_out);
}

TEST(TreeTop, leaves_room_for_the_highest_subtree_below_it) {
  const Column<PrimitiveBox> boxes = Case{"", max_tree_depth, random_box}.boxes();
  const BinaryTree tree = chain(boxes);
  EXPECT_EQ(TreeTop(tree, 1).max_depth(), 1);
  EXPECT_EQ(TreeTop(tree, 3).max_depth(), 2);
  EXPECT_EQ(TreeTop(tree, 11).max_depth(), 6);
  EXPECT_EQ(TreeTop(tree, tree.nodes.size()).max_depth(), max_tree_depth);
}

TEST(LinkedTree, takes_moves_back) {
  const Column<PrimitiveBox> boxes = Case{"", 300, random_box}.boxes();
  const BinaryTree tree = split(boxes);
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
  LinkedTree linked(chain(boxes));
  const std::uint32_t lowest = 2 * max_tree_depth - 2; // the right one of the two lowest leaves
  EXPECT_FALSE(linked.can_move(0, 9));                 // the root
  EXPECT_FALSE(linked.can_move(1, 9));                 // its children
  EXPECT_FALSE(linked.can_move(3, 0));
  EXPECT_FALSE(linked.can_move(3, 2));      // below its parent already
  EXPECT_FALSE(linked.can_move(3, 4));      // beside its sibling already
  EXPECT_FALSE(linked.can_move(4, lowest)); // into itself
  EXPECT_FALSE(linked.can_move(3, lowest)); // a level too many
  EXPECT_TRUE(linked.can_move(lowest, 3));
  EXPECT_TRUE(linked.can_move(1 + 2, 1 + 2 * 10));
  linked.limit_depth(11);
  EXPECT_FALSE(linked.can_move(1 + 2, 1 + 2 * 10));
}

} // namespace
} // namespace fastrt
