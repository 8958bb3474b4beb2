// SPDX-License-Identifier: Apache-2.0
// The scalar tree finds what the loop over everything finds, to the bit, for rays chosen to be difficult.
#include "src/reference/hit_finder.hpp"
#include "src/reference/intersect.hpp"
#include "src/trace/scalar_bvh.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <string>

namespace fastrt::test {
namespace {

using reference::Hit;
using reference::Ray;

struct Case {
  std::string name;
  Mesh mesh;
  bool with_spheres = false;
};

Scene scene_of(const Case& which) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  add(builder, which.mesh, material);
  if (which.with_spheres) {
    Random random(77);
    for (int i = 0; i < 60; ++i) {
      const float radius = std::exp(random.uniform(-7, -1));
      builder.add_sphere(random.in_cube(), radius, material);
    }
    builder.add_sphere({0, 0, 0}, 0.5F, material);
    builder.add_sphere({0, 0, 0}, 0.5F, material); // the smaller id wins
  }
  return builder.build();
}

Mesh twice(Mesh mesh) {
  const std::vector<std::uint32_t> again = mesh.indices;
  mesh.indices.insert(mesh.indices.end(), again.begin(), again.end());
  return mesh;
}

std::vector<Case> cases() {
  Random random(5);
  const Vec3 right{1.3F, 0.4F, -0.7F};
  const Vec3 up{-0.3F, 1.1F, 0.9F};
  return {{"sphere", jittered(icosphere(2), 0.05F, random)},
          {"soup", soup(300, 0.3F, random), true},
          {"small_soup", soup(300, 0.01F, random), true},
          {"far_soup", placed(soup(200, 0.3F, random), 1.0F, {1e4F, -2e4F, 5e3F})},
          {"flat_grid", grid(12, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2})},
          {"tilted_grid", grid(12, {-0.5F, -0.6F, 0.1F}, right, up)},
          {"duplicates", twice(jittered(icosphere(1), 0.1F, random)), true}};
}

// Something of the mesh to aim at: a corner, a point of an edge, or any point of a triangle.
Vec3 target_on(const Mesh& mesh, Random& random) {
  const std::size_t triangle = random.below(static_cast<std::uint32_t>(mesh.triangle_count()));
  const std::size_t corner = random.below(3);
  switch (random.below(3)) {
  case 0:
    return mesh.corner(triangle, corner);
  case 1:
    return point_on_edge(mesh, triangle, corner, random.uniform());
  default:
    const Vec3 on_edge = point_on_edge(mesh, triangle, corner, random.uniform());
    return on_edge + random.uniform() * (mesh.corner(triangle, (corner + 2) % 3) - on_edge);
  }
}

Ray aimed(const Vec3& origin, const Vec3& target, Random& random) {
  Ray ray;
  ray.origin = origin;
  ray.direction = std::exp(random.uniform(-5, 5)) * (target - origin);
  return ray;
}

using RayMaker = std::function<Ray(const Mesh&, Random&)>;

std::vector<std::pair<std::string, RayMaker>> ray_makers() {
  return {
      {"aimed",
       [](const Mesh& mesh, Random& random) {
         const Vec3 target = target_on(mesh, random);
         return aimed(target + 3.0F * random.in_cube(), target, random);
       }},
      {"from_far",
       [](const Mesh& mesh, Random& random) {
         const Vec3 target = target_on(mesh, random);
         return aimed(target + std::exp(random.uniform(3, 12)) * random.direction(), target, random);
       }},
      {"axis_parallel",
       [](const Mesh& mesh, Random& random) {
         Ray ray;
         for (int i = 0; i < 3; ++i) ray.direction[i] = random.below(2) == 0 ? 0.0F : -0.0F;
         const auto axis = static_cast<int>(random.below(3));
         ray.direction[axis] = random.below(2) == 0 ? 1.0F : -1.0F;
         ray.origin = target_on(mesh, random);
         ray.origin[axis] -= ray.direction[axis] * random.uniform(-1, 3);
         return ray;
       }},
      {"one_zero",
       [](const Mesh& mesh, Random& random) {
         const Vec3 target = target_on(mesh, random);
         Vec3 from = target + 2.0F * random.in_cube();
         const auto axis = static_cast<int>(random.below(3));
         from[axis] = target[axis];
         return aimed(from, target, random);
       }},
      {"from_surface",
       [](const Mesh& mesh, Random& random) {
         return aimed(target_on(mesh, random), target_on(mesh, random), random);
       }},
      {"bounded",
       [](const Mesh& mesh, Random& random) {
         const Vec3 target = target_on(mesh, random);
         Ray ray = aimed(target + random.in_cube(), target, random);
         ray.direction = target - ray.origin;
         ray.t_min = random.uniform(-1, 1);
         ray.t_max = ray.t_min + random.uniform(0, 1);
         ray.excluded = static_cast<std::int32_t>(random.below(100));
         return ray;
       }},
      {"in_plane",
       [](const Mesh& mesh, Random& random) {
         const std::size_t t = random.below(static_cast<std::uint32_t>(mesh.triangle_count()));
         const Vec3 u = mesh.corner(t, 1) - mesh.corner(t, 0);
         const Vec3 v = mesh.corner(t, 2) - mesh.corner(t, 0);
         const Vec3 origin = mesh.corner(t, 0) + random.uniform(-3, 3) * u + random.uniform(-3, 3) * v;
         return aimed(origin, point_on_edge(mesh, t, random.below(3), random.uniform()), random);
       }},
      {"grazing",
       [](const Mesh& mesh, Random& random) {
         const std::size_t t = random.below(static_cast<std::uint32_t>(mesh.triangle_count()));
         const Vec3 u = mesh.corner(t, 1) - mesh.corner(t, 0);
         const Vec3 v = mesh.corner(t, 2) - mesh.corner(t, 0);
         const Vec3 normal = glm::normalize(glm::cross(u, v));
         const Vec3 origin = mesh.corner(t, 0) + random.uniform(-3, 3) * u + random.uniform(-3, 3) * v;
         const float height = std::exp(random.uniform(-16, -2));
         return aimed(origin + height * normal, point_on_edge(mesh, t, random.below(3), random.uniform()),
                      random);
       }},
  };
}

bool same(const Hit& a, const Hit& b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return a.primitive == b.primitive && a.t == b.t && bits(a.u) == bits(b.u) && bits(a.v) == bits(b.v);
}

struct Tally {
  int hits = 0, wrong = 0;
};

Tally compare(const Case& which, const RayMaker& make_ray, int count) {
  const Scene scene = scene_of(which);
  const reference::BruteForce loop(scene);
  const ScalarBvh tree(scene);
  Random random(1234);
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const Ray ray = make_ray(which.mesh, random);
    const Hit expected = loop.closest(ray);
    tally.hits += expected.found() ? 1 : 0;
    if (!same(expected, tree.closest(ray)) || expected.found() != tree.any(ray)) ++tally.wrong;
  }
  return tally;
}

TEST(ReferenceTree, FindsWhatTheLoopFinds) {
  constexpr int rays_each = 6000;
  Tally sum;
  for (const Case& which : cases())
    for (const auto& [name, make_ray] : ray_makers()) {
      const Tally tally = compare(which, make_ray, rays_each);
      EXPECT_EQ(tally.wrong, 0) << which.name << ", " << name;
      sum.hits += tally.hits;
    }
  EXPECT_GT(sum.hits, 200000); // the rays do hit something
}

TEST(ReferenceTree, OfNothingHitsNothing) {
  SceneBuilder builder;
  const Scene scene = builder.build();
  const ScalarBvh tree(scene);
  Ray ray;
  ray.direction = {0, 0, 1};
  EXPECT_FALSE(tree.closest(ray).found());
  EXPECT_FALSE(tree.any(ray));
}

TEST(ReferenceTree, AMissHasTheRaysEnd) {
  SceneBuilder builder;
  builder.add_sphere({0, 0, 0}, 1, builder.add_material({}));
  const Scene scene = builder.build();
  Ray ray;
  ray.origin = {0, 0, 5};
  ray.direction = {0, 1, 0};
  ray.t_max = 7;
  for (const Hit& hit : {ScalarBvh(scene).closest(ray), reference::BruteForce(scene).closest(ray)}) {
    EXPECT_EQ(hit.primitive, no_primitive);
    EXPECT_EQ(hit.t, 7.0F);
  }
}

} // namespace
} // namespace fastrt::test
