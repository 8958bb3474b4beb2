// SPDX-License-Identifier: Apache-2.0
// The box kernel of every ISA. It only culls, so there is no twin to equal; but it must never cull a box
// whose primitive is hit.
#include "tests/equivalence/isas.hpp"
#include "tests/equivalence/sphere_pairs.hpp"
#include "tests/equivalence/triangle_pairs.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

constexpr std::size_t table_size = 16384;

void put_box(Pair& pair, const Aabb& box) {
  put(pair, 0, box.lower);
  put(pair, 3, box.upper);
}

// Directions whose products with coordinates overflow are nobody's promise.
bool is_moderate(const reference::Ray& ray) { return reference::largest_magnitude(ray.direction) <= 1e30F; }

class BoxKernel : public testing::TestWithParam<Isa> {
protected:
  const std::vector<std::uint8_t>& meet(PairTable& table) {
    kernels_of(GetParam()).meet_boxes(table.columns(), met_.data());
    return met_;
  }
  // How many boxes are met.
  std::size_t count_met(PairTable& table) {
    std::size_t count = 0;
    for (const std::uint8_t met : meet(table)) count += met;
    return count;
  }
  void expect_met(PairTable& table, const std::vector<bool>& expected, int kind) {
    const std::vector<std::uint8_t>& met = meet(table);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < table_size; ++i) lost += expected[i] && met[i] == 0 ? 1 : 0;
    EXPECT_EQ(lost, 0U) << "kind " << kind;
  }

private:
  std::vector<std::uint8_t> met_ = std::vector<std::uint8_t>(table_size);
};

TEST_P(BoxKernel, IsMetWhereverItsTriangleIsHit) {
  Random random(31);
  PairTable table(table_size);
  std::vector<bool> hit(table_size);
  for (int k = 0; k < static_cast<int>(TriangleKind::count); ++k)
    for (int pass = 0; pass < effort(10); ++pass) {
      for (std::size_t i = 0; i < table_size; ++i) {
        Pair& pair = table.pairs()[i];
        pair = triangle_pair(static_cast<TriangleKind>(k), random);
        const auto triangle = triangle_of(pair);
        hit[i] = is_moderate(pair.ray) && intersect_triangle(pair.ray, triangle).hit;
        Aabb box;
        box.extend(triangle.a);
        box.extend(triangle.b);
        box.extend(triangle.c);
        put_box(pair, box);
      }
      expect_met(table, hit, k);
    }
}

TEST_P(BoxKernel, IsMetWhereverItsSphereIsHit) {
  Random random(32);
  PairTable table(table_size);
  std::vector<bool> hit(table_size);
  for (int k = 0; k < static_cast<int>(SphereKind::count); ++k)
    for (int pass = 0; pass < effort(10); ++pass) {
      for (std::size_t i = 0; i < table_size; ++i) {
        Pair& pair = table.pairs()[i];
        pair = sphere_pair(static_cast<SphereKind>(k), random);
        const auto [center, radius] = sphere_of(pair);
        hit[i] = radius > 0.0F && is_moderate(pair.ray) && intersect_sphere(pair.ray, {center, radius}).hit;
        // As wide as the builder makes it: two ulps more than the radius.
        const Vec3 reach{radius + 0x1p-22F * (radius + reference::largest_magnitude(center))};
        put_box(pair, {center - reach, center + reach});
      }
      expect_met(table, hit, k);
    }
}

// A box with 0 to 3 sides of no length, or of very different lengths.
Aabb any_box(Random& random) {
  const float size = any_size(random, -10, 10);
  Aabb box;
  box.lower = size * random.in_cube();
  box.upper = box.lower;
  for (int axis = 0; axis < 3; ++axis)
    if (random.below(4) != 0) box.upper[axis] += size * any_size(random, -8, 0);
  return box;
}

// A point of the box, often on a face, an edge or a corner.
Vec3 point_in(const Aabb& box, Random& random) {
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const float share = reference::min(1.0F, reference::max(0.0F, random.uniform(-0.7F, 1.7F)));
    point[axis] =
        share == 1.0F ? box.upper[axis] : box.lower[axis] + share * (box.upper[axis] - box.lower[axis]);
  }
  return point;
}

TEST_P(BoxKernel, IsMetByRaysAtItsFacesEdgesAndCorners) {
  Random random(33);
  PairTable table(table_size);
  for (int pass = 0; pass < effort(10); ++pass) {
    for (Pair& pair : table.pairs()) {
      const Aabb box = any_box(random);
      put_box(pair, box);
      const Vec3 target = point_in(box, random);
      Vec3 from = target + any_size(random, -3, 3) * glm::length(box.extent()) * random.direction();
      // In the plane of a face, or along an edge.
      for (int axis = 0; axis < 3; ++axis)
        if (random.below(3) == 0) from[axis] = target[axis];
      if (random.below(8) == 0) from = point_in(box, random);
      pair.ray.origin = from;
      pair.ray.direction = any_size(random, -5, 5) * (target - from);
      pair.ray.t_min = 0;
    }
    EXPECT_EQ(count_met(table), table_size);
  }
}

TEST_P(BoxKernel, IsMetFromInsideInEveryDirection) {
  Random random(34);
  PairTable table(table_size);
  for (Pair& pair : table.pairs()) {
    const Aabb box = any_box(random);
    put_box(pair, box);
    pair.ray.origin = point_in(box, random);
    pair.ray.direction = random.below(2) == 0 ? axis_direction(random) : random.direction();
  }
  EXPECT_EQ(count_met(table), table_size);
}

TEST_P(BoxKernel, IsCulledWhereTheRayPassesBeside) {
  Random random(35);
  PairTable table(table_size);
  for (Pair& pair : table.pairs()) {
    put_box(pair, {Vec3(-1), Vec3(1)});
    // Away from the box, or past it in a plane that touches no corner.
    pair.ray.origin = 1.01F * std::sqrt(3.0F) * random.direction();
    pair.ray.direction = random.direction();
    if (random.below(2) == 0)
      pair.ray.direction = glm::cross(pair.ray.direction, pair.ray.origin);
    else if (glm::dot(pair.ray.direction, pair.ray.origin) < 0.0F)
      pair.ray.direction = -pair.ray.direction;
  }
  EXPECT_EQ(count_met(table), 0U);
}

TEST_P(BoxKernel, IsCulledBehindTheRaysStart) {
  Random random(36);
  PairTable table(table_size);
  for (Pair& pair : table.pairs()) {
    put_box(pair, {Vec3(-1), Vec3(1)});
    pair.ray.origin = 3.0F * random.direction();
    pair.ray.direction = -pair.ray.origin;
    pair.ray.t_min = 2;
  }
  EXPECT_EQ(count_met(table), 0U);
}

INSTANTIATE_TEST_SUITE_P(Isas, BoxKernel, testing::ValuesIn(simd_isas()), IsaWord());

} // namespace
} // namespace fastrt::test
