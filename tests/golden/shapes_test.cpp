// SPDX-License-Identifier: Apache-2.0
// Cones, disks and polygons against geometry in long double: what is hit, where, and how far from the outline
// an answer may be wrong.
#include "src/reference/intersect.hpp"
#include "tests/golden/cone_truth.hpp"
#include "tests/unit/shape_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fastrt::test {
namespace {

using reference::Intersection;
using reference::Ray;

Answer answer_of(const Intersection& found) { return {found.hit, found.t}; }

struct Tally {
  int hits = 0, wrong = 0;
};

// Cones of all kinds, seen from `distance` times their size, by rays at and around their outline.
Tally shoot_at_cones(float distance, int count) {
  Random random(11);
  Tally tally;
  for (int i = 0; i < count; ++i) {
    SceneBuilder builder;
    add_any_cone(builder, builder.add_material({}), random.in_cube(), 1, random);
    const Scene scene = builder.build();
    const ConeColumns& c = scene.desc().cones;
    const Cone cone{Vec3l(c.base[0]), Vec3l(c.apex[0]), c.base_radius[0], c.apex_radius[0], c.capped[0] != 0};
    const ConeShape& shape = scene.shapes().cones[0];
    for (int k = 0; k < 32; ++k) {
      Ray ray;
      ray.origin = shape.center + distance * random.uniform(1, 3) * random.direction();
      const float z = random.uniform(-1, 1) * shape.half_height;
      const Vec3 side = glm::normalize(
          glm::cross(shape.axis, random.below(2) == 0 ? random.direction() : ray.origin - shape.center));
      const Vec3 target = shape.center + z * shape.axis +
                          (shape.radius + shape.slope * z) * random.uniform(-1.1F, 1.1F) * side;
      ray.direction = target - ray.origin;
      const Judgement judged = judge(cone, Vec3l(ray.origin), Vec3l(ray.direction),
                                     answer_of(reference::intersect(ray, scene, 0)));
      tally.hits += judged.hit ? 1 : 0;
      tally.wrong += judged.wrong ? 1 : 0;
    }
  }
  return tally;
}

TEST(Cones, AreMetWhereGeometrySays) {
  for (const float distance : {0.3F, 3.0F, 100.0F, 1e4F}) {
    const Tally tally = shoot_at_cones(distance, 4000);
    EXPECT_EQ(tally.wrong, 0) << distance;
    EXPECT_GT(tally.hits, 40000) << distance;
  }
}

// The share of rays from far away that a cylinder stops is that of its shadow: 2 r h across the axis.
TEST(Cones, KeepTheirOutlineAtTenThousandRadii) {
  SceneBuilder builder;
  builder.add_cylinder({0, -1, 0}, {0, 1, 0}, 0.5F, builder.add_material({}), false);
  const Scene scene = builder.build();
  const int side = 400;
  int hits = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      Ray ray;
      ray.origin = {5000, 0, 0};
      const float across = (static_cast<float>(x) + 0.5F) / side - 0.5F;
      const float up = (static_cast<float>(y) + 0.5F) / side - 0.5F;
      ray.direction = Vec3(0, 4 * up, 4 * across) - ray.origin;
      hits += reference::intersect(ray, scene, 0).hit ? 1 : 0;
    }
  EXPECT_NEAR(static_cast<double>(hits) * 16 / (side * side), 2.0, 0.01);
}

TEST(Disks, AreMetWithinTheirRadius) {
  Random random(12);
  for (int i = 0; i < 20000; ++i) {
    SceneBuilder builder;
    add_any_disk(builder, builder.add_material({}), random.in_cube(), 1, random);
    const Scene scene = builder.build();
    const Vec3 center = scene.desc().disks.center[0];
    const Vec3l normal = glm::normalize(Vec3l(scene.desc().disks.normal[0]));
    const Real radius = scene.desc().disks.radius[0];
    Ray ray;
    ray.origin = center + 3.0F * random.direction();
    ray.direction = center + scene.desc().disks.radius[0] * 1.5F * random.in_cube() - ray.origin;
    const Vec3l o(ray.origin), d(ray.direction);
    const Real t = glm::dot(Vec3l(center) - o, normal) / glm::dot(d, normal);
    const Real distance = glm::length(o + t * d - Vec3l(center));
    const Real cosine = std::fabs(glm::dot(glm::normalize(d), normal));
    if (std::fabs(distance - radius) * cosine < 1e-5L) continue;
    const Intersection found = reference::intersect(ray, scene, 0);
    ASSERT_EQ(found.hit, distance < radius && t > 0) << i;
    if (found.hit) {
      EXPECT_NEAR(static_cast<double>((found.t - t) * cosine), 0.0, 1e-5);
    }
  }
}

// Even-odd by the angle that each contour turns through: in every direction alike, unlike a half line.
int turns_around(const std::vector<Vec3>& contour, const Vec3& p, const Across& axes) {
  double sum = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec3 a = contour[i] - p, b = contour[(i + 1) % contour.size()] - p;
    const double from = std::atan2(glm::dot(a, axes.y), glm::dot(a, axes.x));
    const double to = std::atan2(glm::dot(b, axes.y), glm::dot(b, axes.x));
    sum += std::remainder(to - from, 2 * std::numbers::pi);
  }
  return static_cast<int>(std::lround(sum / (2 * std::numbers::pi)));
}

double distance_to_edges(const std::vector<Vec3>& contour, const Vec3& p) {
  double least = 1e9;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec3 a = contour[i], ab = contour[(i + 1) % contour.size()] - a;
    const float share = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
    least = std::min(least, static_cast<double>(glm::length(p - (a + share * ab))));
  }
  return least;
}

TEST(Polygons, AreMetInsideTheirContoursAndNotInTheirHoles) {
  Random random(13);
  int hits = 0, holes = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 normal = random.below(4) == 0 ? Vec3(0, 1, 0) : random.direction();
    const Vec3 center = random.in_cube();
    const std::vector<std::vector<Vec3>> contours{
        star(center, normal, 1, 3 + static_cast<int>(random.below(70)), random.uniform(0.3F, 1)),
        star(center, normal, 0.25F, 3, 0.9F)};
    SceneBuilder builder;
    builder.add_polygon(contours, builder.add_material({}));
    const Scene scene = builder.build();
    const Across axes = axes_across(normal);
    for (int k = 0; k < 20; ++k) {
      const Vec3 target = center + random.uniform(-1, 1) * axes.x + random.uniform(-1, 1) * axes.y;
      const Vec3 side = random.direction();
      Ray ray;
      ray.origin =
          target + 3.0F * (side + (glm::dot(side, normal) < 0 ? -0.3F : 0.3F) * glm::normalize(normal));
      ray.direction = target - ray.origin;
      if (distance_to_edges(contours[0], target) < 1e-4 || distance_to_edges(contours[1], target) < 1e-4)
        continue;
      const int outer = turns_around(contours[0], target, axes),
                inner = turns_around(contours[1], target, axes);
      const Intersection found = reference::intersect(ray, scene, 0);
      ASSERT_EQ(found.hit, (outer + inner) % 2 != 0) << i;
      hits += found.hit ? 1 : 0;
      holes += inner != 0 ? 1 : 0;
      if (found.hit) {
        EXPECT_NEAR(found.t, 1.0F, 1e-5F);
      }
    }
  }
  EXPECT_GT(hits, 8000);
  EXPECT_GT(holes, 300);
}

TEST(Planes, AreMetFromBothSidesAndHaveNoBounds) {
  SceneBuilder builder;
  builder.add_plane({0, -1, 0}, {0, 2, 0}, builder.add_material({}));
  const Scene scene = builder.build();
  EXPECT_TRUE(scene.bounds().empty());
  Ray ray;
  ray.origin = {7, 1, 3};
  ray.direction = {1, -4, 0};
  EXPECT_EQ(reference::intersect(ray, scene, 0).t, 0.5F);
  ray.origin.y = -3;
  EXPECT_FALSE(reference::intersect(ray, scene, 0).hit);
  ray.direction.y = 4;
  EXPECT_EQ(reference::intersect(ray, scene, 0).t, 0.5F);
}

// (u, v) of what a ray from `from` to `to` hits.
Vec2 coordinates(const Scene& scene, const Vec3& from, const Vec3& to) {
  Ray ray;
  ray.origin = from;
  ray.direction = to - from;
  const Intersection found = reference::intersect(ray, scene, 0);
  EXPECT_TRUE(found.hit);
  return {found.u, found.v};
}

void expect_near(const Vec2& found, const Vec2& expected) {
  EXPECT_NEAR(found.x, expected.x, 1e-5);
  EXPECT_NEAR(found.y, expected.y, 1e-5);
}

// From x over -z, to the right of who looks at it, and from the lowest point up.
TEST(Coordinates, OfSpheresGoAroundAndUp) {
  SceneBuilder builder;
  builder.add_sphere({1, 2, 3}, 2, builder.add_material({}));
  const Scene scene = builder.build();
  const Vec3 center(1, 2, 3);
  for (int i = 0; i < 100; ++i) {
    const float around = (static_cast<float>(i) + 0.5F) / 100,
                up = (static_cast<float>(i * 37 % 100) + 0.5F) / 100;
    const float longitude = 2 * std::numbers::pi_v<float> * around;
    const float latitude = std::numbers::pi_v<float> * (up - 0.5F);
    const Vec3 side{std::cos(longitude) * std::cos(latitude), std::sin(latitude),
                    -std::sin(longitude) * std::cos(latitude)};
    expect_near(coordinates(scene, center + 5.0F * side, center), {around, up});
  }
}

TEST(Coordinates, OfConesGoAroundAndUp) {
  SceneBuilder builder;
  builder.add_cone({0, 1, 0}, 2, {0, 5, 0}, 1, builder.add_material({}), false);
  const Scene scene = builder.build();
  expect_near(coordinates(scene, {9, 2, 0}, {0, 2, 0}), {0, 0.25F});
  expect_near(coordinates(scene, {0, 4, -9}, {0, 4, 0}), {0.25F, 0.75F});
  expect_near(coordinates(scene, {-9, 3, 0.0001F}, {0, 3, 0}), {0.5F, 0.5F});
}

TEST(Coordinates, OfFlatShapesAreLengthsAndOfDisksGoAround) {
  SceneBuilder plane, disk;
  plane.add_plane({1, 2, 3}, {0, 5, 0}, plane.add_material({}));
  expect_near(coordinates(plane.build(), {3, 9, 4}, {3, 2, 4}), {2, -1});
  disk.add_disk({0, 0, 0}, {0, 0, 1}, 4, disk.add_material({}));
  expect_near(coordinates(disk.build(), {0, 1, 9}, {0, 1, 0}), {0.25F, 0.25F});
}

} // namespace
} // namespace fastrt::test
