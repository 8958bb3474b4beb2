// SPDX-License-Identifier: Apache-2.0
#include "src/reference/hit_finder.hpp"
#include "src/reference/surface.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

using reference::BruteForce;
using reference::Ray;
using reference::Surface;

Surface surface_seen(const Scene& scene, const Vec3& origin, const Vec3& direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  return surface_at(scene, ray, BruteForce(scene).closest(ray));
}

Scene triangle_with_normals(const std::vector<Vec3>& normals) {
  SceneBuilder builder;
  const std::vector<Vec3> positions{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const std::vector<std::uint32_t> indices{0, 1, 2};
  builder.add_mesh(positions, indices, builder.add_material({}), normals);
  return builder.build();
}

TEST(ReferenceSurface, OfATriangleFacesTheViewerFromBothSides) {
  const Scene scene = triangle_with_normals({});
  const Surface front = surface_seen(scene, {1, 1, 3}, {0, 0, -2});
  EXPECT_EQ(front.point, Vec3(1, 1, 0));
  EXPECT_EQ(front.geometric_normal, Vec3(0, 0, 1));
  EXPECT_EQ(front.shading_normal, Vec3(0, 0, 1));
  EXPECT_EQ(front.incident, Vec3(0, 0, -1));
  EXPECT_EQ(front.to_viewer, Vec3(0, 0, 1));
  EXPECT_EQ(front.distance, 3.0F);
  EXPECT_EQ(front.magnitude, 4.0F);
  EXPECT_EQ(front.planar, 0);
  const Surface back = surface_seen(scene, {1, 1, -3}, {0, 0, 1});
  EXPECT_EQ(back.geometric_normal, Vec3(0, 0, -1));
  EXPECT_EQ(back.shading_normal, Vec3(0, 0, -1));
}

TEST(ReferenceSurface, InterpolatesNormals) {
  const Vec3 tilted = glm::normalize(Vec3(1, 0, 1));
  const Scene scene = triangle_with_normals({{0, 0, 1}, tilted, {0, 0, 1}});
  const Surface at_tilted = surface_seen(scene, {3.9999F, 0, 3}, {0, 0, -1});
  EXPECT_NEAR(glm::dot(at_tilted.shading_normal, tilted), 1, 1e-6F);
  EXPECT_EQ(at_tilted.geometric_normal, Vec3(0, 0, 1));
  const Surface between = surface_seen(scene, {2, 0, 3}, {0, 0, -1});
  EXPECT_NEAR(glm::dot(between.shading_normal, glm::normalize(Vec3(0, 0, 1) + tilted)), 1, 1e-6F);
  EXPECT_NEAR(glm::length(between.shading_normal), 1, 1e-6F);
  const Surface from_below = surface_seen(scene, {2, 0, -3}, {0, 0, 1});
  EXPECT_EQ(from_below.shading_normal, -between.shading_normal);
}

TEST(ReferenceSurface, NormalsThatCancelOutGiveWayToTheGeometry) {
  const Scene scene = triangle_with_normals({{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}});
  EXPECT_EQ(surface_seen(scene, {2, 0, 3}, {0, 0, -1}).shading_normal, Vec3(0, 0, 1));
}

TEST(ReferenceSurface, OfASphereLiesOnIt) {
  SceneBuilder builder;
  const Vec3 center{10, -20, 30};
  builder.add_sphere(center, 2, builder.add_material({}));
  const Scene scene = builder.build();
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 origin = center + 100.0F * random.direction();
    const Surface surface = surface_seen(scene, origin, center + random.in_cube() - origin);
    EXPECT_NEAR(glm::length(surface.point - center), 2, 5e-6F);
    EXPECT_NEAR(glm::dot(surface.point - center, surface.geometric_normal), 2, 5e-6F);
    EXPECT_NEAR(glm::length(surface.point - origin), surface.distance, 1e-3F);
    EXPECT_EQ(surface.magnitude, 32.0F);
    EXPECT_EQ(surface.planar, no_primitive);
  }
  const Surface inside = surface_seen(scene, center, {0, 1, 0});
  EXPECT_EQ(inside.geometric_normal, Vec3(0, -1, 0));
}

// A ray that leaves a surface must not meet it again, wherever the scene lies and however large it is.
TEST(ReferenceSurface, OffsetLeavesTheSurface) {
  Random random(6);
  for (const float scale : {1e-3F, 1.0F, 1e4F})
    for (const float offset : {0.0F, 1e2F, 1e5F}) {
      if (offset > 1e6F * scale) continue;
      const Mesh mesh = placed(icosphere(1), scale, Vec3(offset));
      SceneBuilder builder;
      const std::uint32_t material = builder.add_material({});
      add(builder, mesh, material);
      builder.add_sphere(Vec3(offset) + Vec3(3 * scale, 0, 0), scale, material);
      const Scene scene = builder.build();
      const BruteForce finder(scene);
      int self_hits = 0;
      for (int i = 0; i < 5000; ++i) {
        Ray ray;
        const Vec3 middle = Vec3(offset) + Vec3(i % 2 == 0 ? 0.0F : 3 * scale, 0, 0);
        ray.origin = middle + 5 * scale * random.direction();
        ray.direction = middle + 0.5F * scale * random.in_cube() - ray.origin;
        const reference::Hit hit = finder.closest(ray);
        ASSERT_TRUE(hit.found());
        const Surface surface = surface_at(scene, ray, hit);
        Ray away;
        away.origin = surface.point + reference::offset_for(surface.magnitude) * surface.geometric_normal;
        away.direction = random.direction();
        if (glm::dot(away.direction, surface.geometric_normal) < 0) away.direction = -away.direction;
        away.excluded = surface.planar;
        const reference::Hit next = finder.closest(away);
        self_hits += next.primitive == hit.primitive ? 1 : 0;
      }
      EXPECT_EQ(self_hits, 0) << scale << " at " << offset;
    }
}

} // namespace
} // namespace fastrt::test
