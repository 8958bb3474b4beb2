// SPDX-License-Identifier: Apache-2.0
#include <fastrt/error.hpp>
#include <fastrt/scene.hpp>

#include <gtest/gtest.h>

#include <array>

namespace fastrt {
namespace {

const std::array<Vec3, 4> corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
const std::array<Vec3, 4> normals = {Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 1, 0)};
const std::array<std::uint32_t, 6> square = {0, 1, 2, 0, 2, 3};

TEST(SceneBuilder, IdsCountFromZero) {
  SceneBuilder builder;
  EXPECT_EQ(builder.add_material({}), 0U);
  EXPECT_EQ(builder.add_material({}), 1U);
  EXPECT_EQ(builder.add_mesh(corners, square, 0, {}, "square"), 0U);
  EXPECT_EQ(builder.add_sphere({0, 0, 0}, 1, 1, "ball"), 1U);
  EXPECT_EQ(builder.add_mesh(corners, square, 1), 2U);
  Light light;
  light.position = {1, 2, 3};
  builder.add_light(light);
  builder.set_ambient(Vec3(0.25F));
  builder.set_background(Vec3(0.5F));
  const Scene scene = builder.build();
  EXPECT_EQ(scene.triangle_count(), 4U);
  EXPECT_EQ(scene.sphere_count(), 1U);
  EXPECT_EQ(scene.desc().object_names, (std::vector<std::string>{"square", "ball", ""}));
  EXPECT_EQ(scene.triangles().v2, (Column<std::uint32_t>{2, 3, 6, 7}));
  EXPECT_EQ(scene.triangles().object, (Column<std::uint32_t>{0, 0, 2, 2}));
  EXPECT_EQ(scene.triangles().material, (Column<std::uint32_t>{0, 0, 1, 1}));
  EXPECT_TRUE(scene.triangles().n0.empty());
  EXPECT_EQ(scene.lights().size(), 1U);
  EXPECT_EQ(scene.desc().ambient, Vec3(0.25F));
  EXPECT_EQ(scene.desc().background, Vec3(0.5F));
}

TEST(SceneBuilder, MeshesWithAndWithoutNormalsMix) {
  SceneBuilder builder;
  builder.add_material({});
  builder.add_mesh(corners, square, 0);
  builder.add_mesh(corners, square, 0, normals);
  builder.add_mesh(corners, square, 0);
  builder.add_mesh(corners, square, 0, normals);
  const Scene scene = builder.build();
  EXPECT_EQ(scene.triangles().n0,
            (Column<std::uint32_t>{no_index, no_index, 0, 0, no_index, no_index, 4, 4}));
  EXPECT_EQ(scene.triangles().n2,
            (Column<std::uint32_t>{no_index, no_index, 2, 3, no_index, no_index, 6, 7}));
  EXPECT_EQ(scene.normals().size(), 8U);
  EXPECT_EQ(scene.normals()[7], Vec3(0, 1, 0));
}

TEST(SceneBuilder, BuildLeavesItEmpty) {
  SceneBuilder builder;
  builder.add_material({});
  builder.add_sphere({0, 0, 0}, 1, 0);
  EXPECT_EQ(builder.build().primitive_count(), 1U);
  const Scene again = builder.build();
  EXPECT_EQ(again.primitive_count(), 0U);
  EXPECT_TRUE(again.materials().empty());
}

TEST(SceneBuilder, ARefusedMeshLeavesNoTrace) {
  SceneBuilder builder;
  builder.add_material({});
  const std::array<std::uint32_t, 4> four = {0, 1, 2, 3};
  const std::array<std::uint32_t, 3> outside = {0, 1, 4};
  EXPECT_THROW(builder.add_mesh(corners, four, 0), InputError);
  EXPECT_THROW(builder.add_mesh(corners, outside, 0), InputError);
  EXPECT_THROW(builder.add_mesh(corners, square, 0, std::span(normals).first(3)), InputError);
  EXPECT_EQ(builder.add_mesh(corners, square, 0), 0U);
  EXPECT_EQ(builder.build().positions().size(), 4U);
}

TEST(SceneBuilder, BuildChecksWhatWasAdded) {
  SceneBuilder builder;
  builder.add_mesh(corners, square, 0);
  EXPECT_THROW(builder.build(), InputError); // no material 0
  builder.add_material({});
  builder.add_sphere({0, 0, 0}, -1, 0);
  EXPECT_THROW(builder.build(), InputError);
}

} // namespace
} // namespace fastrt
