// SPDX-License-Identifier: Apache-2.0
#include "src/reference/hit_finder.hpp"
#include "src/reference/intersect.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace fastrt::test {
namespace {

using reference::BruteForce;
using reference::Hit;
using reference::intersect_sphere;
using reference::intersect_triangle;
using reference::Intersection;
using reference::Ray;
using reference::SphereShape;
using reference::TriangleVertices;
using Real = long double;
using RealVec = glm::vec<3, Real>;

Ray ray_of(const Vec3& origin, const Vec3& direction, float t_min = 0, float t_max = infinity) {
  return {origin, direction, t_min, t_max, no_primitive};
}

const TriangleVertices right_triangle{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};

TEST(ReferenceTriangle, IsHitWhereItsWeightsSay) {
  const Intersection found = intersect_triangle(ray_of({0.5F, 1.0F, 4}, {0, 0, -2}), right_triangle);
  ASSERT_TRUE(found.hit);
  EXPECT_EQ(found.t, 2.0F);
  EXPECT_EQ(found.u, 0.25F);
  EXPECT_EQ(found.v, 0.5F);
}

TEST(ReferenceTriangle, IsHitFromBothSidesWithTheSameWeights) {
  const Intersection front = intersect_triangle(ray_of({0.5F, 1, 4}, {0, 0, -1}), right_triangle);
  const Intersection back = intersect_triangle(ray_of({0.5F, 1, -4}, {0, 0, 1}), right_triangle);
  ASSERT_TRUE(front.hit && back.hit);
  EXPECT_EQ(front.t, back.t);
  EXPECT_EQ(front.u, back.u);
  EXPECT_EQ(front.v, back.v);
}

TEST(ReferenceTriangle, IncludesItsBorder) {
  for (const Vec3& point :
       {Vec3(0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)})
    EXPECT_TRUE(intersect_triangle(ray_of(point + Vec3(1, 2, 3), {-1, -2, -3}), right_triangle).hit);
}

TEST(ReferenceTriangle, IsMissedBesideBehindAndAlongItsPlane) {
  EXPECT_FALSE(intersect_triangle(ray_of({1.1F, 1, 4}, {0, 0, -1}), right_triangle).hit);
  EXPECT_FALSE(intersect_triangle(ray_of({-0.01F, 1, 4}, {0, 0, -1}), right_triangle).hit);
  EXPECT_FALSE(intersect_triangle(ray_of({0.5F, 0.5F, 4}, {0, 0, 1}), right_triangle).hit);
  EXPECT_FALSE(intersect_triangle(ray_of({0.5F, 0.5F, 4}, {1, 0, 0}), right_triangle).hit);
  EXPECT_FALSE(intersect_triangle(ray_of({-1, 0.5F, 0}, {1, 0, 0}), right_triangle).hit);
}

TEST(ReferenceTriangle, BothEndsOfTheRayAreOutside) {
  const auto hit = [](float t_min, float t_max) {
    return intersect_triangle(ray_of({0.5F, 0.5F, 4}, {0, 0, -1}, t_min, t_max), right_triangle).hit;
  };
  EXPECT_TRUE(hit(0, 5));
  EXPECT_FALSE(hit(4, 5));
  EXPECT_FALSE(hit(0, 4));
  EXPECT_TRUE(hit(std::nextafter(4.0F, 0.0F), std::nextafter(4.0F, 5.0F)));
}

TEST(ReferenceTriangle, WithoutAreaIsNeverHit) {
  EXPECT_FALSE(intersect_triangle(ray_of({0, 0, 4}, {0, 0, -1}), {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).hit);
  EXPECT_FALSE(intersect_triangle(ray_of({0, 0, 4}, {0, 0, -1}), {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}).hit);
}

TEST(ReferenceTriangle, NumbersThatAreNotFiniteHitNothing) {
  const float nan = std::nanf("");
  EXPECT_FALSE(intersect_triangle(ray_of({nan, 0.5F, 4}, {0, 0, -1}), right_triangle).hit);
  EXPECT_FALSE(intersect_triangle(ray_of({0.5F, 0.5F, 4}, {0, nan, -1}), right_triangle).hit);
  EXPECT_FALSE(intersect_triangle(ray_of({0.5F, 0.5F, 4}, {0, 0, 0}), right_triangle).hit);
  EXPECT_FALSE(intersect_sphere(ray_of({nan, 0, 4}, {0, 0, -1}), {{0, 0, 0}, 1}).hit);
  EXPECT_FALSE(intersect_sphere(ray_of({0, 0, 4}, {0, 0, 0}), {{0, 0, 0}, 1}).hit);
}

// Cramer's rule in long double.
struct ExactTriangleHit {
  Real t, u, v, cosine;
};
ExactTriangleHit exact(const Ray& ray, const TriangleVertices& triangle) {
  const RealVec d(ray.direction);
  const RealVec e1 = RealVec(triangle.b) - RealVec(triangle.a);
  const RealVec e2 = RealVec(triangle.c) - RealVec(triangle.a);
  const RealVec s = RealVec(ray.origin) - RealVec(triangle.a);
  const RealVec p = glm::cross(d, e2);
  const RealVec q = glm::cross(s, e1);
  const Real determinant = glm::dot(e1, p);
  const Real cosine = std::fabs(determinant) / (glm::length(d) * glm::length(glm::cross(e1, e2)));
  return {glm::dot(e2, q) / determinant, glm::dot(s, p) / determinant, glm::dot(d, q) / determinant, cosine};
}

TEST(ReferenceTriangle, AgreesWithLongDouble) {
  Random random(8);
  int hits = 0;
  for (int i = 0; i < 200000; ++i) {
    const TriangleVertices triangle{random.in_cube(), random.in_cube(), random.in_cube()};
    const Vec3 origin = 5.0F * random.in_cube();
    const Ray ray = ray_of(origin, random.in_cube() - origin);
    const ExactTriangleHit truth = exact(ray, triangle);
    const Real inside = std::min({truth.u, truth.v, 1 - truth.u - truth.v, truth.t});
    const Intersection found = intersect_triangle(ray, triangle);
    if (truth.cosine < 0.01L) continue;
    if (inside > 1e-4L) {
      ASSERT_TRUE(found.hit) << i;
    }
    if (inside < -1e-4L) {
      ASSERT_FALSE(found.hit) << i;
    }
    if (!found.hit) continue;
    ++hits;
    const Real area =
        glm::length(glm::cross(RealVec(triangle.b - triangle.a), RealVec(triangle.c - triangle.a)));
    const Real tolerance = 2e-5L / (truth.cosine * area);
    EXPECT_NEAR(static_cast<double>(truth.t), found.t, static_cast<double>(tolerance));
    EXPECT_NEAR(static_cast<double>(truth.u), found.u, static_cast<double>(tolerance));
    EXPECT_NEAR(static_cast<double>(truth.v), found.v, static_cast<double>(tolerance));
  }
  EXPECT_GT(hits, 10000);
}

TEST(ReferenceSphere, IsHitAtItsNearSideFromOutside) {
  const Intersection found = intersect_sphere(ray_of({0, 0, 5}, {0, 0, -2}), {{0, 0, 0}, 1});
  ASSERT_TRUE(found.hit);
  EXPECT_EQ(found.t, 2.0F);
  EXPECT_EQ(found.u, 0.75F);
  EXPECT_EQ(found.v, 0.5F);
}

TEST(ReferenceSphere, IsHitAtItsFarSideFromInside) {
  EXPECT_EQ(intersect_sphere(ray_of({0, 0, 0.5F}, {0, 0, -1}), {{0, 0, 0}, 1}).t, 1.5F);
  EXPECT_EQ(intersect_sphere(ray_of({0, 0, 0}, {1, 0, 0}), {{0, 0, 0}, 2}).t, 2.0F);
}

TEST(ReferenceSphere, IsHitAtItsFarSideBehindTMin) {
  const Intersection found = intersect_sphere(ray_of({0, 0, 5}, {0, 0, -1}, 4.5F), {{0, 0, 0}, 1});
  ASSERT_TRUE(found.hit);
  EXPECT_EQ(found.t, 6.0F);
  EXPECT_FALSE(intersect_sphere(ray_of({0, 0, 5}, {0, 0, -1}, 4.0F, 6.0F), {{0, 0, 0}, 1}).hit);
}

TEST(ReferenceSphere, IsMissedBesideAndBehind) {
  EXPECT_FALSE(intersect_sphere(ray_of({1.001F, 0, 5}, {0, 0, -1}), {{0, 0, 0}, 1}).hit);
  EXPECT_TRUE(intersect_sphere(ray_of({0.999F, 0, 5}, {0, 0, -1}), {{0, 0, 0}, 1}).hit);
  EXPECT_FALSE(intersect_sphere(ray_of({0, 0, 5}, {0, 0, 1}), {{0, 0, 0}, 1}).hit);
}

TEST(ReferenceSphere, IsGrazedAtOnePoint) {
  const Intersection found = intersect_sphere(ray_of({1, 0, 5}, {0, 0, -1}), {{0, 0, 0}, 1});
  ASSERT_TRUE(found.hit);
  EXPECT_EQ(found.t, 5.0F);
}

TEST(ReferenceSphere, IsHitWhateverTheLengths) {
  for (const float radius : {1e-12F, 1e-8F, 1.0F, 1e8F, 1e12F})
    for (const float length : {1e-12F, 1e-8F, 1.0F, 1e8F, 1e12F}) {
      const Vec3 side(0, 0.6F * radius, 0), way(0, 0, -length);
      const float t = radius / length;
      const Intersection outside =
          intersect_sphere(ray_of(side + Vec3(0, 0, 3 * radius), way), {{0, 0, 0}, radius});
      ASSERT_TRUE(outside.hit) << radius << ' ' << length;
      EXPECT_NEAR(outside.t / t, 2.2, 1e-5) << radius << ' ' << length;
      const Intersection inside = intersect_sphere(ray_of(side, way), {{0, 0, 0}, radius});
      ASSERT_TRUE(inside.hit) << radius << ' ' << length;
      EXPECT_NEAR(inside.t / t, 0.8, 1e-5) << radius << ' ' << length;
    }
}

std::optional<Real> exact(const Ray& ray, const SphereShape& sphere) {
  const RealVec d(ray.direction);
  const RealVec f = RealVec(ray.origin) - RealVec(sphere.center);
  const Real a = glm::dot(d, d);
  const Real b = glm::dot(f, d);
  const Real discriminant = b * b - a * (glm::dot(f, f) - static_cast<Real>(sphere.radius) * sphere.radius);
  if (discriminant < 0) return std::nullopt;
  return (-b - std::sqrt(discriminant)) / a;
}

// The textbook's b^2 - 4ac in float is wrong for a third of the rays from 1e4 radii away.
TEST(ReferenceSphere, AgreesWithLongDoubleFromFarAway) {
  Random random(21);
  for (const float distance : {3.0F, 1e2F, 1e4F}) {
    int wrong = 0;
    int hits = 0;
    for (int i = 0; i < 100000; ++i) {
      const SphereShape sphere{random.in_cube(), 1};
      const Vec3 origin = sphere.center + distance * random.direction();
      const Ray ray = ray_of(origin, sphere.center + 1.2F * random.in_cube() - origin);
      const std::optional<Real> truth = exact(ray, sphere);
      const Intersection found = intersect_sphere(ray, sphere);
      wrong += truth.has_value() == found.hit ? 0 : 1;
      if (!truth || !found.hit) continue;
      ++hits;
      // Seen at a grazing angle the error of the point becomes one of its root.
      const Real error = std::fabs(found.t - *truth) * static_cast<Real>(glm::length(ray.direction));
      EXPECT_LT(error, 6e-4L * std::sqrt(static_cast<Real>(distance)));
    }
    EXPECT_LE(wrong, 100) << distance;
    EXPECT_GT(hits, 40000);
  }
}

TEST(ReferenceLoop, KeepsTheSmallestIdOfEqualHits) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  const std::vector<Vec3> positions{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const std::vector<std::uint32_t> indices{0, 1, 2, 1, 2, 0, 2, 0, 1};
  builder.add_mesh(positions, indices, material);
  const Scene scene = builder.build();
  Ray ray = ray_of({0.5F, 0.5F, 4}, {0, 0, -1});
  EXPECT_EQ(BruteForce(scene).closest(ray).primitive, 0);
  ray.excluded = 0;
  EXPECT_EQ(BruteForce(scene).closest(ray).primitive, 1);
  EXPECT_TRUE(BruteForce(scene).any(ray));
}

TEST(ReferenceLoop, SpheresComeAfterTriangles) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  builder.add_sphere({0, 0, 2}, 1, material);
  const std::vector<Vec3> positions{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}};
  const std::vector<std::uint32_t> indices{0, 1, 2};
  builder.add_mesh(positions, indices, material);
  const Scene scene = builder.build();
  const Hit first = BruteForce(scene).closest(ray_of({0, 0, 9}, {0, 0, -1}));
  EXPECT_EQ(first.primitive, 1);
  EXPECT_EQ(first.t, 6.0F);
  EXPECT_EQ(BruteForce(scene).closest(ray_of({0, 0, -9}, {0, 0, 1})).primitive, 0);
}

} // namespace
} // namespace fastrt::test
