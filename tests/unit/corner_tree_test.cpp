// SPDX-License-Identifier: Apache-2.0
#include "src/load/corner_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace fastrt {
namespace {

// Of whole numbers, so that many points are in one place or on one line.
class RandomPlane {
public:
  PlanePoint point() {
    return {static_cast<double>(number_(random_)), static_cast<double>(number_(random_))};
  }
  CornerTree::Triangle triangle() {
    CornerTree::Triangle t = {point(), point(), point()};
    while (!(area_of(t[0], t[1], t[2]) > 0)) t = {point(), point(), point()};
    return t;
  }
  void shuffle(std::vector<std::uint32_t>& corners) { std::shuffle(corners.begin(), corners.end(), random_); }

private:
  std::mt19937 random_{7};
  std::uniform_int_distribution<int> number_{0, 30};
};

bool is_within(const PlanePoint& p, const CornerTree::Triangle& t) {
  if (p == t[0] || p == t[1] || p == t[2]) return false;
  return area_of(t[0], t[1], p) >= 0 && area_of(t[1], t[2], p) >= 0 && area_of(t[2], t[0], p) >= 0;
}

TEST(CornerTree, AnswersAsALoopOverAllCornersDoes) {
  RandomPlane random;
  CornerTree tree;
  std::size_t found = 0, asked = 0;
  for (std::size_t count = 1; count < 400; count += 7) {
    std::vector<PlanePoint> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(random.point());
    std::vector<std::uint32_t> corners(count);
    std::iota(corners.begin(), corners.end(), 0U);
    random.shuffle(corners);
    corners.resize((count + 1) / 2); // the others are never found
    tree.build(points, corners);
    random.shuffle(corners);
    for (; !corners.empty(); corners.pop_back()) {
      const CornerTree::Triangle triangle = random.triangle();
      const bool expected = std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
        return is_within(points[corner], triangle);
      });
      ASSERT_EQ(tree.any_within(triangle), expected) << count << ' ' << corners.size();
      found += expected ? 1 : 0;
      ++asked;
      tree.remove(corners.back());
    }
    EXPECT_FALSE(tree.any_within({PlanePoint{-100, -100}, PlanePoint{300, -100}, PlanePoint{-100, 300}}));
  }
  EXPECT_GT(found, asked / 4); // both answers are tried
  EXPECT_LT(found, asked - asked / 16);
}

} // namespace
} // namespace fastrt
