// SPDX-License-Identifier: Apache-2.0
// A closed mesh has no cracks: every ray from its inside hits it, also one aimed exactly at a vertex or at an
// edge. Rays in random directions would prove nothing: they never meet an edge.
#include "src/reference/hit_finder.hpp"
#include "src/trace/scalar_bvh.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

using reference::Ray;

struct Place {
  float scale;
  float offset;
};

Scene scene_of(const Mesh& mesh) {
  SceneBuilder builder;
  add(builder, mesh, builder.add_material({}));
  return builder.build();
}

// From somewhere around the middle, at a vertex or at a point of an edge.
Ray ray_from_inside(const Mesh& mesh, const Place& place, bool at_vertex, Random& random) {
  Ray ray;
  ray.origin = Vec3(place.offset) + 0.3F * place.scale * random.in_cube();
  const std::size_t triangle = random.below(static_cast<std::uint32_t>(mesh.triangle_count()));
  const std::size_t corner = random.below(3);
  const Vec3 target = point_on_edge(mesh, triangle, corner, at_vertex ? 0.0F : random.uniform());
  ray.direction = std::exp(random.uniform(-3, 3)) * (target - ray.origin);
  return ray;
}

class Watertight : public testing::TestWithParam<Place> {};

TEST_P(Watertight, NoRayLeaksThroughAVertexOrAnEdge) {
  constexpr int rays_each = 30000;
  Random random(99);
  const Mesh mesh = placed(jittered(icosphere(1), 0.05F, random), GetParam().scale, Vec3(GetParam().offset));
  const Scene scene = scene_of(mesh);
  const reference::BruteForce loop(scene);
  const ScalarBvh tree(scene);
  for (const bool at_vertex : {true, false}) {
    int leaks = 0;
    int tree_leaks = 0;
    for (int i = 0; i < rays_each; ++i) {
      const Ray ray = ray_from_inside(mesh, GetParam(), at_vertex, random);
      leaks += loop.any(ray) ? 0 : 1;
      tree_leaks += tree.any(ray) && tree.closest(ray).found() ? 0 : 1;
    }
    EXPECT_EQ(leaks, 0) << (at_vertex ? "vertices" : "edges");
    EXPECT_EQ(tree_leaks, 0) << (at_vertex ? "vertices" : "edges") << ", tree";
  }
}

// Where the numbers have no digits left for the mesh, there is no mesh: 1e-3 large at 1e5 is left out.
INSTANTIATE_TEST_SUITE_P(Places, Watertight,
                         testing::Values(Place{1e-3F, 0}, Place{1e-3F, 1e2F}, Place{1, 0}, Place{1, 1e2F},
                                         Place{1, 1e5F}, Place{1e2F, 1e5F}, Place{1e4F, 0}, Place{1e4F, 1e2F},
                                         Place{1e4F, 1e5F}));

// A fan whose centre is on the ray: no triangle of it is hit anywhere but at its tip.
TEST(WatertightFan, ItsCentreIsHitFromEverywhere) {
  Mesh mesh;
  constexpr std::uint32_t blades = 17;
  mesh.positions.emplace_back(0.1F, 0.2F, 0.3F);
  for (std::uint32_t i = 0; i < blades; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(blades);
    mesh.positions.push_back(mesh.positions[0] + Vec3(std::cos(angle), std::sin(angle), -0.2F));
    mesh.add_triangle(0, 1 + i, 1 + (i + 1) % blades);
  }
  const Scene scene = scene_of(mesh);
  const reference::BruteForce loop(scene);
  Random random(3);
  int leaks = 0;
  for (int i = 0; i < 100000; ++i) {
    Ray ray;
    ray.origin = mesh.positions[0] + Vec3(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(4, 9));
    ray.direction = mesh.positions[0] - ray.origin;
    leaks += loop.any(ray) ? 0 : 1;
  }
  EXPECT_EQ(leaks, 0);
}

} // namespace
} // namespace fastrt::test
