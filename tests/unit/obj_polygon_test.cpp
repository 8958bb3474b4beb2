// SPDX-License-Identifier: Apache-2.0
#include "src/load/polygon.hpp"
#include "tests/unit/obj_test_support.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

namespace fastrt {
namespace {

using namespace test;
using Triangle = PolygonTriangulator::Triangle;

struct Split {
  PolygonTriangulator::Result result;
  std::vector<Triangle> triangles;
};

Split split(const std::vector<Vec3>& corners) {
  Split made;
  PolygonTriangulator triangulator;
  made.result = triangulator.run(corners, made.triangles);
  return made;
}

Vec3 cross_of(const std::vector<Vec3>& corners, const Triangle& t) {
  return glm::cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]);
}

Vec3 newell(const std::vector<Vec3>& corners) {
  Vec3 sum(0.0F);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

// n - 2 triangles that all turn as the polygon does and together have its area: so they neither overlap nor
// leave anything out.
void expect_whole(const std::vector<Vec3>& corners, const char* what) {
  const Split made = split(corners);
  EXPECT_FALSE(made.result.tangled) << what;
  EXPECT_FALSE(made.result.bent) << what;
  ASSERT_EQ(made.triangles.size(), corners.size() - 2) << what;
  const Vec3 whole = newell(corners);
  double area = 0;
  for (const Triangle& t : made.triangles) {
    const Vec3 part = cross_of(corners, t);
    EXPECT_GE(glm::dot(part, whole), -1e-4F * glm::dot(whole, whole)) << what;
    area += static_cast<double>(glm::length(part));
  }
  EXPECT_NEAR(area / static_cast<double>(glm::length(whole)), 1, 1e-4) << what;
}

std::vector<Vec3> turned(const std::vector<Vec3>& flat, int axis, bool backwards) {
  std::vector<Vec3> corners;
  for (const Vec3& p : flat)
    corners.push_back(axis == 0   ? Vec3(0.3F * p.x + 0.1F * p.y, p.x, p.y)
                      : axis == 1 ? Vec3(p.y, 5, p.x)
                                  : Vec3(p.x, p.y, -7));
  if (backwards) std::reverse(corners.begin(), corners.end());
  return corners;
}

void expect_whole_everywhere(const std::vector<Vec3>& flat, const char* what) {
  for (int axis = 0; axis < 3; ++axis)
    for (const bool backwards : {false, true}) {
      std::vector<Vec3> corners = turned(flat, axis, backwards);
      for (std::size_t start = 0; start < std::min<std::size_t>(corners.size(), 8); ++start) {
        expect_whole(corners, what);
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      }
    }
}

TEST(ObjPolygon, ConvexOnesBecomeFans) {
  const Split made = split({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}});
  EXPECT_EQ(made.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(ObjPolygon, ConcaveOnesKeepTheirArea) {
  expect_whole_everywhere({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 0}}, "dart");
  expect_whole_everywhere({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}}, "concave pentagon");
  expect_whole_everywhere({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, "L");
  expect_whole_everywhere(
      {{0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0}, {0, 4, 0}, {4, 4, 0}, {4, 1, 0}, {0, 1, 0}}, "U");
  expect_whole_everywhere({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}},
                          "corners on edges");
  std::vector<Vec3> star, comb;
  for (int i = 0; i < 60; ++i) {
    const double angle = std::numbers::pi * i / 30;
    const double r = i % 2 == 0 ? 3 : 1;
    star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
  }
  expect_whole_everywhere(star, "star");
  for (int i = 0; i < 50; ++i) comb.emplace_back(i, i % 2 == 0 ? 1 : 9, 0);
  comb.emplace_back(49, 0, 0);
  comb.emplace_back(0, 0, 0);
  std::reverse(comb.begin(), comb.end());
  expect_whole_everywhere(comb, "comb");
}

TEST(ObjPolygon, AHoleWithASlitKeepsItsArea) {
  expect_whole({{0, 0, 0},
                {6, 0, 0},
                {6, 6, 0},
                {0, 6, 0},
                {0, 0, 0},
                {2, 2, 0},
                {2, 4, 0},
                {4, 4, 0},
                {4, 2, 0},
                {2, 2, 0}},
               "frame");
}

TEST(ObjPolygon, RandomStarShapesKeepTheirArea) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> radius(0.2F, 5.0F);
  for (int count = 4; count < 200; count += 3) {
    std::vector<Vec3> corners;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      const float r = radius(random);
      corners.emplace_back(r * static_cast<float>(std::cos(angle)), r * static_cast<float>(std::sin(angle)),
                           0);
    }
    expect_whole(corners, "random star");
  }
}

TEST(ObjPolygon, LargeSpiralsAreQuick) {
  std::vector<Vec3> corners;
  constexpr int count = 20000;
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < count; ++k) {
      const int i = side == 0 ? k : count - 1 - k;
      const double angle = 0.005 * i, r = 1 + 0.001 * i + 0.3 * side;
      corners.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
  std::reverse(corners.begin(), corners.end());
  const Split made = split(corners);
  EXPECT_FALSE(made.result.tangled);
  EXPECT_EQ(made.triangles.size(), corners.size() - 2);
}

// A band whose rims zigzag, seen along `angle`.
std::vector<Vec3> zigzag(std::size_t count, double height, double angle) {
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < count; ++i) {
    const bool upper = i >= count / 2;
    const std::size_t k = upper ? count - 1 - i : i;
    const double x = 0.05 * static_cast<double>(k), y = height * ((k % 2 == 0 ? 0 : 1) + (upper ? 0.5 : 0));
    corners.emplace_back(x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle),
                         0);
  }
  return corners;
}

// Testing each ear against each corner takes 20 s for the slowest of these, a minute for all. In Debug, with
// sanitizers, they take 6 s.
TEST(ObjPolygon, LargeZigzagsAreQuick) {
  expect_whole_everywhere(zigzag(100, 3, 0.5), "zigzag");
  const auto start = std::chrono::steady_clock::now();
  for (const double degrees : {0.0, 0.001, 30.0, 45.0, 89.999, 90.0}) {
    const std::vector<Vec3> corners = zigzag(max_face_corners - 1, 1000, degrees * std::numbers::pi / 180);
    const Split made = split(corners);
    EXPECT_FALSE(made.result.tangled) << degrees;
    EXPECT_EQ(made.triangles.size(), corners.size() - 2) << degrees;
  }
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 30);
}

TEST(ObjPolygon, TangledOnesBecomeFans) {
  std::vector<Vec3> pentagram;
  for (int i = 0; i < 5; ++i) {
    const double angle = 4 * std::numbers::pi * i / 5;
    pentagram.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (const auto& corners :
       {pentagram, std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},
        std::vector<Vec3>{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 1, 0}},
        std::vector<Vec3>{
            {0, 0, 0}, {6, 0, 0}, {6, 3, 0}, {2, 3, 0}, {2, -2, 0}, {4, -2, 0}, {4, 5, 0}, {0, 5, 0}},
        std::vector<Vec3>{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}) {
    const Split made = split(corners);
    EXPECT_TRUE(made.result.tangled);
    ASSERT_EQ(made.triangles.size(), corners.size() - 2);
    for (std::uint32_t i = 0; i < made.triangles.size(); ++i)
      EXPECT_EQ(made.triangles[i], (Triangle{0, i + 1, i + 2}));
  }
}

TEST(ObjPolygon, BentOnesAreReported) {
  EXPECT_TRUE(split({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}).result.bent);
  EXPECT_FALSE(split({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.02F}, {0, 1, 0}}).result.bent);
}

TEST(ObjPolygon, FacesOfAFileKeepTheirCornersTogether) {
  const Loaded loaded =
      parse("v 0 0 0\nv 4 0 0\nv 4 3 0\nv 2 1 0\nv 0 3 0\n"
            "vt 0 0\nvt 4 0\nvt 4 3\nvt 2 1\nvt 0 3\nvn 0 0 1\nvn 0 0 2\nvn 0 0 3\nvn 0 0 4\nvn 0 0 5\n"
            "f 1/1/1 2/2/2 3/3/3 4/4/4 5/5/5\n");
  const TriangleColumns& rows = loaded.desc.triangles;
  ASSERT_EQ(rows.size(), 3U);
  float area = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rows.v0[i], rows.t0[i]);
    EXPECT_EQ(rows.v1[i], rows.t1[i]);
    EXPECT_EQ(rows.v2[i], rows.n2[i]);
    EXPECT_EQ(rows.v0[i], rows.n0[i]);
    const Vec3 a = loaded.desc.positions[rows.v0[i]];
    area += 0.5F * glm::length(glm::cross(loaded.desc.positions[rows.v1[i]] - a,
                                          loaded.desc.positions[rows.v2[i]] - a));
  }
  EXPECT_FLOAT_EQ(area, 8);
  EXPECT_EQ(loaded.diagnostics.count(), 0U);
}

TEST(ObjPolygon, TangledFacesOfAFileAreWarnedAbout) {
  const Loaded loaded =
      parse("v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 1 0\nf 1 2 3\n  f 1 2 3 4 # bow tie\nv 1 1 1\nf 1 3 2 5\n");
  const auto lines = loaded.warnings();
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(contains(lines[0], "t.obj:6:3: the polygon crosses itself"));
}

} // namespace
} // namespace fastrt
