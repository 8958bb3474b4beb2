// SPDX-License-Identifier: Apache-2.0
#include "src/accel/check_tree.hpp"
#include "src/accel/numbered_range.hpp"
#include "src/accel/parallel.hpp"
#include "src/accel/subtree.hpp"
#include "src/accel/tree.hpp"
#include "tests/unit/bvh_boxes.hpp"

#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace fastrt {
namespace {

class BuildOf : public testing::TestWithParam<Case> {};

TEST_P(BuildOf, keeps_its_promises) {
  const Column<PrimitiveBox> boxes = GetParam().boxes();
  Column<PrimitiveBox> scratch = boxes;
  const BinaryTree tree = build_binary_tree(scratch, {});
  EXPECT_EQ(check_tree(tree, boxes), "");
  const WideTree wide = collapse(tree, {});
  EXPECT_EQ(check_tree(wide, boxes), "");
  EXPECT_LE(tree_depth(wide), max_tree_depth);
  EXPECT_TRUE(sah_cost(wide) >= 1);
}

TEST_P(BuildOf, is_the_same_for_any_number_of_threads) {
  const Column<PrimitiveBox> boxes = GetParam().boxes();
  Column<PrimitiveBox> scratch = boxes;
  const BinaryTree tree = build_binary_tree(scratch, {1});
  const WideTree wide = collapse(tree, {1});
  for (const int threads : {2, 8}) {
    scratch = boxes;
    const BinaryTree again = build_binary_tree(scratch, {threads});
    EXPECT_TRUE(bytes(tree.nodes) == bytes(again.nodes));
    EXPECT_TRUE(bytes(tree.order) == bytes(again.order));
    EXPECT_TRUE(bytes(tree.group_of_leaf) == bytes(again.group_of_leaf));
    const WideTree wide_again = collapse(tree, {threads});
    EXPECT_TRUE(bytes(wide.nodes) == bytes(wide_again.nodes));
    for (std::size_t g = 0; g < max_groups; ++g)
      EXPECT_TRUE(bytes(wide.slots[g]) == bytes(wide_again.slots[g]));
    EXPECT_EQ(wide.root, wide_again.root);
  }
}

INSTANTIATE_TEST_SUITE_P(Bvh, BuildOf, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Build, takes_any_small_count) {
  for (std::size_t count = 0; count <= 100; ++count) {
    const Case small{"", count, random_box};
    const Column<PrimitiveBox> boxes = small.boxes();
    Column<PrimitiveBox> scratch = boxes;
    const BinaryTree tree = build_binary_tree(scratch, {});
    EXPECT_EQ(check_tree(tree, boxes), "") << count;
    const WideTree wide = collapse(tree, {});
    EXPECT_EQ(check_tree(wide, boxes), "") << count;
    EXPECT_EQ(wide.root == no_child, count == 0);
    if (count >= 1 && count <= block_size) {
      EXPECT_TRUE(is_leaf(wide.root));
    }
  }
}

TEST(Build, makes_groups_share_no_leaf_however_few) {
  Column<PrimitiveBox> boxes{box_around(0, 0, 0, 1, 5, 1), box_around(0, 0, 0, 1, 9, 0)};
  const Column<PrimitiveBox> original = boxes;
  const BinaryTree tree = build_binary_tree(boxes, {});
  EXPECT_EQ(check_tree(tree, original), "");
  EXPECT_EQ(tree.nodes.size(), 3U);
}

// Then there are more nodes than primitives.
TEST(Build, can_make_a_leaf_of_each_primitive) {
  for (const std::size_t count : {64U, 30000U}) {
    const Case apart{"", count, [](std::size_t i, Random&) {
                       return box_around(static_cast<float>(i), 0, 0, 0.25F, i, i % max_groups);
                     }};
    const Column<PrimitiveBox> boxes = apart.boxes();
    for (const int threads : {1, 3}) {
      Column<PrimitiveBox> scratch = boxes;
      const BinaryTree tree = build_binary_tree(scratch, {threads});
      EXPECT_EQ(tree.nodes.size(), 2 * count - 1);
      EXPECT_EQ(check_tree(tree, boxes), "");
    }
  }
}

int depth_below(const NodeList& list, const BinaryNode& node) {
  if (node.count != 0) return 1;
  return 1 +
         std::max(depth_below(list, list.nodes[node.first]), depth_below(list, list.nodes[node.first + 1]));
}

TEST(Build, halves_when_few_levels_are_left) {
  for (const std::size_t count : {20U, 33U, 3000U, 16384U}) {
    for (int spare = 0; spare < 4; ++spare) {
      Column<PrimitiveBox> boxes = Case{"", count, exponential}.boxes();
      Column<PrimitiveBox> other(count);
      Column<std::uint32_t> order(count);
      const BuildContext context{order.data(), {boxes.data(), other.data()}, _mm_set1_ps(0x1p-120F), true};
      BuildRange range;
      range.end = count;
      range.level = max_tree_depth - spare - static_cast<int>(std::bit_width(count - 1));
      std::vector<std::uint32_t> numbers(count);
      std::iota(numbers.begin(), numbers.end(), 0U);
      const NumberedBoxes all{boxes.data(), {numbers.data(), nullptr}};
      measure(all, range);
      Bins bins;
      fill_bins(all, range, BinMapping(range.centroids), bins);
      NodeList list;
      const GroupedNode root = build_range(context, range, bins, list);
      EXPECT_LE(range.level - 1 + depth_below(list, root.node), max_tree_depth) << count << ' ' << spare;
      std::sort(order.begin(), order.end());
      for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i);
    }
  }
}

TEST(Tasks, hand_their_exceptions_on) {
  TaskFailure failure;
  EXPECT_THROW(run_tasks(2, failure,
                         [&] {
                           spawn(failure, [] {});
                           spawn(failure, [] { throw LimitError("planted"); });
                         }),
               LimitError);
}

// The least cost of what lies below a binary node as at most k children of a wide node, by trying everything.
double least_cost(const BinaryTree& tree, std::uint32_t node, int k, unsigned run_size) {
  const BinaryNode& b = tree.nodes[node];
  const double x = static_cast<double>(b.upper[0]) - static_cast<double>(b.lower[0]);
  const double y = static_cast<double>(b.upper[1]) - static_cast<double>(b.lower[1]);
  const double z = static_cast<double>(b.upper[2]) - static_cast<double>(b.lower[2]);
  const double area = x * y + y * z + z * x;
  if (b.count != 0) return area * ((b.count + run_size - 1) / run_size);
  double least = std::numeric_limits<double>::infinity();
  for (int j = 1; j < k; ++j)
    least = std::min(least,
                     least_cost(tree, b.first, j, run_size) + least_cost(tree, b.first + 1, k - j, run_size));
  if (k > 1) return std::min(least, least_cost(tree, node, 1, run_size));
  for (int j = 1; j < wide_children; ++j)
    least = std::min(least, area + least_cost(tree, b.first, j, run_size) +
                                least_cost(tree, b.first + 1, wide_children - j, run_size));
  std::uint32_t first = node, last = node;
  while (tree.nodes[first].count == 0) first = tree.nodes[first].first;
  while (tree.nodes[last].count == 0) last = tree.nodes[last].first + 1;
  const std::uint32_t count = tree.nodes[last].first + tree.nodes[last].count - tree.nodes[first].first;
  if (count <= block_size * max_leaf_blocks)
    least = std::min(least, area * ((count + run_size - 1) / run_size));
  return least;
}

TEST(Collapse, finds_the_least_cost) {
  for (const int run_size : {4, 8})
    for (const std::size_t count : {10U, 25U, 45U}) {
      BuildSettings settings;
      settings.run_size = run_size;
      Column<PrimitiveBox> boxes = Case{"", count, random_box}.boxes();
      const BinaryTree tree = build_binary_tree(boxes, settings);
      const WideTree wide = collapse(tree, settings);
      const Vec3 d = wide.bounds.extent();
      const auto area = static_cast<double>(d.x * d.y + d.y * d.z + d.z * d.x);
      EXPECT_NEAR(sah_cost(wide, run_size), least_cost(tree, 0, 1, static_cast<unsigned>(run_size)) / area,
                  1e-5)
          << count;
    }
}

TEST(Build, fills_its_blocks) {
  const Column<PrimitiveBox> boxes = cases[1].boxes();
  Column<PrimitiveBox> scratch = boxes;
  const WideTree wide = collapse(build_binary_tree(scratch, {}), {});
  EXPECT_GT(static_cast<double>(boxes.size()), 0.8 * static_cast<double>(wide.slots[0].size()));
}

TEST(Build, finds_the_gap_between_clusters) {
  Column<PrimitiveBox> boxes;
  Random random;
  for (std::size_t i = 0; i < 1000; ++i)
    boxes.push_back(
        box_around((i % 2 == 0 ? -10.0F : 10.0F) + random(-1, 1), random(-1, 1), random(-1, 1), 0.1F, i));
  const BinaryTree tree = build_binary_tree(boxes, {});
  const BinaryNode& left = tree.nodes[tree.nodes[0].first];
  const BinaryNode& right = tree.nodes[tree.nodes[0].first + 1];
  EXPECT_LT(left.upper[0], -8);
  EXPECT_GT(right.lower[0], 8);
}

TEST(Statistics, count_by_the_book) {
  Column<PrimitiveBox> boxes;
  for (std::size_t i = 0; i < 16; ++i) boxes.push_back(box_around(i < 8 ? 0.0F : 9.0F, 0, 0, 0.5F, i));
  const WideTree wide = collapse(build_binary_tree(boxes, {}), {});
  ASSERT_EQ(wide.nodes.size(), 1U);
  EXPECT_EQ(leaf_count(wide), 2U);
  EXPECT_EQ(tree_depth(wide), 2);
  // The root's box is 10 x 1 x 1 (area 42), its two leaves of one run are unit cubes (area 6).
  EXPECT_DOUBLE_EQ(sah_cost(wide), 1 + 2 * 6.0 / 42.0);
  EXPECT_EQ(sah_cost(WideTree{}), 0);
  EXPECT_EQ(tree_depth(WideTree{}), 0);
  EXPECT_EQ(leaf_count(WideTree{}), 0U);
}

} // namespace
} // namespace fastrt
