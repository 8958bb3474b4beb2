// SPDX-License-Identifier: Apache-2.0
// Cones, disks, polygons and planes as parts of a scene: ids, boxes, and what is refused.
#include "src/scene/shapes.hpp"
#include "tests/unit/shape_scenes.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

using Contours = std::vector<std::vector<Vec3>>;

TEST(SceneShapes, ShareTheIdsInTheOrderOfTheirKinds) {
  SceneBuilder builder;
  const std::uint32_t first = builder.add_material({}), second = builder.add_material({});
  builder.add_plane({0, 0, 0}, {0, 1, 0}, second, "floor");
  builder.add_polygon(Contours{star({0, 0, 0}, {0, 1, 0}, 1, 5, 0.5F)}, first, "star");
  builder.add_disk({0, 0, 0}, {0, 1, 0}, 1, second, "disk");
  builder.add_cone({0, 0, 0}, 1, {0, 1, 0}, 0, first, true, "cone");
  builder.add_cylinder({0, 0, 0}, {0, 1, 0}, 1, second, false, "cylinder");
  builder.add_sphere({0, 0, 0}, 1, first, "ball");
  const Scene scene = builder.build();
  ASSERT_EQ(scene.primitive_count(), 6U);
  constexpr PrimitiveKind kinds[] = {PrimitiveKind::sphere, PrimitiveKind::cone,    PrimitiveKind::cone,
                                     PrimitiveKind::disk,   PrimitiveKind::polygon, PrimitiveKind::plane};
  const char* names[] = {"ball", "cone", "cylinder", "disk", "star", "floor"};
  const std::uint32_t materials[] = {first, first, second, second, first, second};
  for (std::uint32_t id = 0; id < 6; ++id) {
    EXPECT_EQ(scene.kind(id), kinds[id]) << id;
    EXPECT_EQ(scene.desc().object_names[scene.object_of(id)], names[id]);
    EXPECT_EQ(scene.material_of(id), materials[id]);
  }
  EXPECT_EQ(scene.count_of(PrimitiveKind::cone), 2U);
  EXPECT_EQ(scene.first_of(PrimitiveKind::disk), 3U);
}

// Points of a shape, found by its own formula, lie in its box; and the box is not larger than it must be.
TEST(SceneShapes, BoxesAreTight) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add_material({});
    const Vec3 base = random.in_cube(), apex = random.in_cube();
    const float r0 = random.uniform(), r1 = random.uniform();
    builder.add_cone(base, r0, apex, r1, material);
    const Scene scene = builder.build();
    const auto [x, y] = axes_across(apex - base);
    Aabb seen;
    for (int k = 0; k < 2000; ++k) {
      const float angle = static_cast<float>(k) * 0.0031416F;
      const Vec3 side = std::cos(angle) * x + std::sin(angle) * y;
      seen.extend(base + r0 * side);
      seen.extend(apex + r1 * side);
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(scene.bounds().lower[axis], seen.lower[axis], 1e-4);
      EXPECT_NEAR(scene.bounds().upper[axis], seen.upper[axis], 1e-4);
      EXPECT_LE(scene.bounds().lower[axis], seen.lower[axis] + 1e-7F);
      EXPECT_GE(scene.bounds().upper[axis], seen.upper[axis] - 1e-7F);
    }
  }
}

// The message of what building throws; empty if nothing.
template <class Add>
std::string refusal(const Add& add) {
  SceneBuilder builder;
  add(builder, builder.add_material({}));
  try {
    builder.build();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SceneShapes, ThatCantBeAreRefused) {

  const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  EXPECT_EQ(refusal([](auto& b, auto m) {
              b.add_cone({1, 0, 0}, 1, {1, 0, 0}, 1, m);
            }),
            "cone 0: base and apex are the same point");
  EXPECT_EQ(refusal([](auto& b, auto m) {
              b.add_cone({1, 0, 0}, -1, {0, 0, 0}, 1, m);
            }),
            "cone 0: the radii must be finite and not negative");
  EXPECT_EQ(refusal([](auto& b, auto m) {
              b.add_cone({1, 0, 0}, 0, {0, 0, 0}, 0, m);
            }),
            "cone 0: one radius must be greater than 0");
  EXPECT_EQ(refusal([](auto& b, auto m) {
              b.add_cone({std::nanf(""), 0, 0}, 0, {0, 0, 0}, 1, m);
            }),
            "cone 0: the base is not finite");
  EXPECT_EQ(refusal([](auto& b, auto m) {
              b.add_disk({0, 0, 0}, {0, 0, 0}, 1, m);
            }),
            "disk 0: the normal must be finite and not 0");
  EXPECT_EQ(refusal([](auto& b, auto m) {
              b.add_disk({0, 0, 0}, {0, 1, 0}, 0, m);
            }),
            "disk 0: the radius must be greater than 0");
  EXPECT_EQ(refusal([](auto& b, auto m) {
              b.add_plane({0, 0, 0}, {0, 1, 0}, m + 1);
            }),
            "plane 0: refers to material 1, but there are 1");
  EXPECT_EQ(refusal([&](auto& b, auto m) { b.add_polygon(Contours{line}, m); }),
            "polygon 0: its vertices lie on a line");
  EXPECT_EQ(refusal([](auto& b, auto m) {
              b.add_polygon(Contours{{{0, 0, 0}, {1, 0, 0}}}, m);
            }),
            "every contour of a polygon must have its vertices, at least three");
  EXPECT_EQ(refusal([](auto& b, auto m) { b.add_polygon({}, m); }),
            "every polygon must have its contours, at least one");
}

// A contour that crosses itself has no area by its sum, and still lies in a plane.
TEST(SceneShapes, PolygonsThatCrossThemselvesHaveAPlane) {
  SceneBuilder builder;
  const std::vector<Vec3> bow{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  builder.add_polygon(Contours{bow}, builder.add_material({}));
  const Scene scene = builder.build();
  EXPECT_EQ(std::fabs(scene.shapes().polygons[0].normal.z), 1.0F);
  EXPECT_EQ(scene.shapes().polygons[0].edge_count, 2U);
}

} // namespace
} // namespace fastrt::test
