// SPDX-License-Identifier: Apache-2.0
// Transforms, copies, prototypes and instances of scene.toml.
#include "tests/unit/toml_test_support.hpp"

#include <string>

namespace fastrt {
namespace {

using test::TomlTexts;

Vec3 applied(const Affine& map, const Vec3& p) {
  return map.x * p.x + map.y * p.y + map.z * p.z + map.origin;
}

// Where the transform, as a value of TOML, puts the point (1, 2, 3).
Vec3 moved(TomlTexts& texts, const std::string& transform) {
  const SceneDesc desc = texts.desc("[[sphere]]\ntransform = " + transform);
  EXPECT_EQ(desc.instances.size(), 1U);
  return applied(desc.instances.to_world[0], {1, 2, 3});
}

TEST(TomlInstances, TransformsAreWrittenInManyWays) {
  TomlTexts texts;
  EXPECT_EQ(moved(texts, "[]"), Vec3(1, 2, 3));
  EXPECT_EQ(moved(texts, "[10, 20, 30]"), Vec3(11, 22, 33));
  EXPECT_EQ(moved(texts, "{ translate = [10, 20, 30] }"), Vec3(11, 22, 33));
  EXPECT_EQ(moved(texts, "{ scale = 2 }"), Vec3(2, 4, 6));
  EXPECT_EQ(moved(texts, "{ scale = [2, 3, -1] }"), Vec3(2, 6, -3));
  EXPECT_EQ(moved(texts, "{ rotate = { axis = [0, 0, 5], angle = 90 } }"), Vec3(-2, 1, 3));
  EXPECT_EQ(moved(texts, "{ rotate = { axis = [0, 1, 0], angle = -450 } }"), Vec3(-3, 2, 1));
  EXPECT_EQ(moved(texts, "{ shear = { xy = 2 } }"), Vec3(5, 2, 3));
  EXPECT_EQ(moved(texts, "{ shear = { zx = 1, yz = -1 } }"), Vec3(1, -1, 4));
  EXPECT_EQ(moved(texts, "[1, 0, 0, 5,  0, 2, 0, 6,  0, 1, 1, 7]"), Vec3(6, 10, 12));
  EXPECT_EQ(moved(texts, "[1, 0, 0, 5,  0, 2, 0, 6,  0, 1, 1, 7,  0, 0, 0, 1]"), Vec3(6, 10, 12));
  EXPECT_EQ(moved(texts, "{ matrix = [1, 0, 0, 5,  0, 2, 0, 6,  0, 1, 1, 7], scale = 2 }"), Vec3(12, 20, 24));
}

TEST(TomlInstances, StepsComeInOrder) {
  TomlTexts texts;
  // Of one table: scale, shear, rotate, translate, whatever the order in the file.
  EXPECT_EQ(moved(texts, "{ translate = [1, 0, 0], scale = 2 }"), Vec3(3, 4, 6));
  EXPECT_EQ(moved(texts, "{ rotate = { axis = [0, 0, 1], angle = 90 }, scale = [2, 1, 1] }"), Vec3(-2, 2, 3));
  // Of an array: one after the other.
  EXPECT_EQ(moved(texts, "[{ translate = [1, 0, 0] }, { scale = 2 }]"), Vec3(4, 4, 6));
  EXPECT_EQ(moved(texts, "[[1, 0, 0], { scale = 2 }, [0, 0, 1]]"), Vec3(4, 4, 7));
}

TEST(TomlInstances, RotationsKeepLengthsAndTurnLeft) {
  TomlTexts texts;
  const Vec3 p = moved(texts, "{ rotate = { axis = [1, 1, 1], angle = 120 } }");
  EXPECT_NEAR(p.x, 3, 1e-6);
  EXPECT_NEAR(p.y, 1, 1e-6);
  EXPECT_NEAR(p.z, 2, 1e-6);
}

TEST(TomlInstances, AMovedPrimitiveIsAPrototypeAndAnInstance) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc("[material.red]\n[[sphere]]\n[[sphere]]\nradius = 2\nname = 'egg'\n"
                                    "material = 'red'\ntransform = { scale = [1, 2, 1] }\n[[cube]]\n"
                                    "transform = [1, 0, 0]\n");
  ASSERT_EQ(desc.prototypes.size(), 2U);
  EXPECT_EQ(desc.prototypes[0].begin, (std::array<std::uint32_t, 5>{0, 1, 0, 0, 0}));
  EXPECT_EQ(desc.prototypes[0].end, (std::array<std::uint32_t, 5>{0, 2, 0, 0, 0}));
  EXPECT_EQ(desc.prototypes[1].end, (std::array<std::uint32_t, 5>{12, 2, 0, 0, 0}));
  EXPECT_EQ(desc.instances.prototype, (Column<std::uint32_t>{0, 1}));
  EXPECT_EQ(desc.instances.object[0], no_index);
  EXPECT_EQ(desc.instances.material[0], no_index);
  EXPECT_EQ(desc.object_names[desc.spheres.object[1]], "egg");
  EXPECT_EQ(desc.materials[desc.spheres.material[1]].name, "red");
}

TEST(TomlInstances, PlanesAreMovedThemselves) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc(
      "[[plane]]\npoint = [0, 1, 0]\nnormal = [1, 1, 0]\n"
      "transform = { scale = [2, 1, 1], translate = [0, 0, 5] }\nrepeat = { count = 2, step = [0, 9, 0] }");
  EXPECT_TRUE(desc.instances.prototype.empty());
  ASSERT_EQ(desc.planes.size(), 2U);
  EXPECT_EQ(desc.planes.point[0], Vec3(0, 1, 5));
  EXPECT_EQ(desc.planes.point[1], Vec3(0, 10, 5));
  // Square to the images of (1, -1, 0) and (0, 0, 1).
  EXPECT_NEAR(glm::dot(desc.planes.normal[0], Vec3(2, -1, 0)), 0, 1e-6);
  EXPECT_EQ(desc.planes.normal[0].z, 0);
}

TEST(TomlInstances, CopiesByListAndByRepeat) {
  TomlTexts texts;
  const SceneDesc list =
      texts.desc("[prototype.a]\n[[prototype.a.sphere]]\n[[instance]]\nof = 'a'\nname = 'x'\n"
                 "transform = { scale = 2 }\ntransforms = [[1, 0, 0], [0, 1, 0]]\n");
  ASSERT_EQ(list.instances.size(), 2U);
  EXPECT_EQ(applied(list.instances.to_world[0], {1, 1, 1}), Vec3(3, 2, 2));
  EXPECT_EQ(applied(list.instances.to_world[1], {1, 1, 1}), Vec3(2, 3, 2));
  EXPECT_EQ(list.object_names[list.instances.object[0]], "x 1");
  EXPECT_EQ(list.object_names[list.instances.object[1]], "x 2");
  const SceneDesc grid = texts.desc(
      "[[cube]]\ntransform = [0, 0, 1]\nrepeat = [{ count = 3, step = [1, 0, 0] }, { count = 2, step = "
      "{ rotate = { axis = [0, 0, 1], angle = 90 } } }]\n");
  ASSERT_EQ(grid.instances.size(), 6U);
  EXPECT_EQ(applied(grid.instances.to_world[2], Vec3(0.0F)), Vec3(2, 0, 1));
  EXPECT_EQ(applied(grid.instances.to_world[3], Vec3(0.0F)), Vec3(0, 0, 1));
  EXPECT_EQ(applied(grid.instances.to_world[5], Vec3(0.0F)), Vec3(0, 2, 1));
  EXPECT_EQ(grid.prototypes.size(), 1U);
}

// Wherever they stand: planes, and what lies in a prototype.
TEST(TomlInstances, EachCopyOfWhatHasANameIsAnObject) {
  TomlTexts texts;
  const std::string twice = "repeat = { count = 2, step = [0, 9, 0] }\n";
  const SceneDesc planes = texts.desc("[[plane]]\nname = 'p'\n" + twice + "[[plane]]\n" + twice);
  EXPECT_EQ(planes.object_names, (std::vector<std::string>{"p 1", "p 2", "plane 1"}));
  EXPECT_EQ(planes.planes.object, (Column<std::uint32_t>{0, 1, 2, 2}));
  const SceneDesc desc =
      texts.desc("[[prototype.a.sphere]]\nname = 's'\n" + twice + "[[prototype.b.instance]]\nof = 'a'\n" +
                 "[[prototype.b.instance]]\nof = 'a'\nname = 'i'\n" + twice + "[[instance]]\nof = 'b'\n");
  EXPECT_EQ(desc.object_names, (std::vector<std::string>{"s", "s 1", "s 2", "i 1", "i 2"}));
  EXPECT_EQ(desc.instances.object, (Column<std::uint32_t>{1, 2, 3, 3, 4, 4}));
}

TEST(TomlInstances, TenThousandCopiesTakeAFewLines) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc("[[sphere]]\nrepeat = [{ count = 100, step = [3, 0, 0] }, { count = 100, "
                                    "step = [0, 0, 3] }]\n");
  EXPECT_EQ(desc.instances.size(), 10000U);
  EXPECT_EQ(desc.spheres.size(), 1U);
  EXPECT_EQ(applied(desc.instances.to_world[9999], Vec3(0.0F)), Vec3(297, 0, 297));
}

TEST(TomlInstances, PrototypesHoldPrimitivesThatLieAndSuchThatAreMoved) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc(
      "[material.red]\n[material.blue]\n[prototype.tree]\n"
      "cylinder = [{ radius = 0.5 }]\nsphere = [{ transform = { scale = [1, 2, 1] } }, { radius = 3 }]\n"
      "[[instance]]\nof = 'tree'\ntransform = [5, 0, 0]\n[[instance]]\nof = 'tree'\nmaterial = 'blue'\n");
  ASSERT_EQ(desc.prototypes.size(), 2U);
  EXPECT_EQ(desc.prototypes[0].end, (std::array<std::uint32_t, 5>{0, 1, 1, 0, 0}));
  EXPECT_EQ(desc.spheres.radius[0], 3);
  EXPECT_EQ(desc.prototypes[1].begin, (std::array<std::uint32_t, 5>{0, 1, 1, 0, 0}));
  EXPECT_EQ(desc.prototypes[1].end, (std::array<std::uint32_t, 5>{0, 2, 1, 0, 0}));
  EXPECT_EQ(desc.instances.prototype, (Column<std::uint32_t>{0, 1, 0, 1}));
  EXPECT_EQ(applied(desc.instances.to_world[0], {1, 1, 1}), Vec3(6, 1, 1));
  EXPECT_EQ(applied(desc.instances.to_world[1], {1, 1, 1}), Vec3(6, 2, 1));
  EXPECT_EQ(desc.instances.material[1], no_index);
  EXPECT_EQ(desc.materials[desc.instances.material[2]].name, "blue");
}

TEST(TomlInstances, InstancesOfInstancesAreFlattened) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc(
      "[material.red]\n[prototype.a]\n[[prototype.a.sphere]]\n[prototype.b]\n[[prototype.b.instance]]\nof = "
      "'a'\n"
      "transforms = [[1, 0, 0], [2, 0, 0]]\nmaterial = 'red'\n"
      "[[instance]]\nof = 'b'\ntransform = { scale = 10 }\nrepeat = { count = 2, step = [0, 5, 0] }\n");
  ASSERT_EQ(desc.prototypes.size(), 1U);
  ASSERT_EQ(desc.instances.size(), 4U);
  EXPECT_EQ(applied(desc.instances.to_world[1], {1, 0, 0}), Vec3(30, 0, 0));
  EXPECT_EQ(applied(desc.instances.to_world[3], {1, 0, 0}), Vec3(30, 5, 0));
  EXPECT_EQ(desc.materials[desc.instances.material[3]].name, "red");
}

TEST(TomlInstances, WhatMakesNoSenseIsRefused) {
  TomlTexts texts;
  const auto error = [&](const std::string& transform) {
    return texts.error("[[sphere]]\ntransform = " + transform);
  };
  EXPECT_EQ(error("[1, 2]"), "t.toml:2:13: transform: expected 3, 12 or 16 numbers, found an array of 2");
  EXPECT_EQ(error("3"), "t.toml:2:13: transform: expected an array, found a number");
  EXPECT_EQ(error("{ scale = 0 }"), "t.toml:2:23: scale: must not be 0");
  EXPECT_EQ(error("{ turn = 1 }"), "t.toml:2:15: unknown key 'turn' in transform");
  EXPECT_EQ(error("{ rotate = { angle = 1 } }"), "t.toml:2:24: rotate: 'axis' is missing");
  EXPECT_EQ(error("{ matrix = [1, 2, 3] }"),
            "t.toml:2:24: matrix: expected 12 or 16 numbers, found an array of 3");
  EXPECT_EQ(error("[1, 0, 0, 0,  0, 1, 0, 0,  1, 1, 0, 0]"),
            "t.toml:1:1: [[sphere]]: a transform that can't be undone");
  EXPECT_EQ(error("[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2]"),
            "t.toml:2:13: transform: the last row of a matrix must be 0, 0, 0, 1");
  EXPECT_EQ(texts.error("[[sphere]]\nrepeat = { count = 0, step = [1, 0, 0] }"),
            "t.toml:2:20: count: must be a whole number from 1 to 4194304");
  EXPECT_EQ(
      texts.error("[[sphere]]\nrepeat = [{ count = 4194304, step = [1, 0, 0] }, { count = 2, step = [] }]"),
      "t.toml:2:10: repeat: more than 4194304 copies");
  EXPECT_EQ(texts.error("[[sphere]]\nrepeat = { count = 64, step = { scale = 10 } }"),
            "t.toml:1:1: [[sphere]]: a transform that can't be undone");
  EXPECT_EQ(texts.error("[[sphere]]\ntransforms = []"),
            "t.toml:2:14: transforms: expected at least one transform");
  EXPECT_EQ(texts.error("[[instance]]"), "t.toml:1:1: [[instance]]: 'of' is missing");
  EXPECT_EQ(texts.error("[[instance]]\nof = 'a'\n[prototype.a]\nsphere = [{}]"),
            "t.toml:2:6: of: unknown prototype 'a'; a prototype must stand above what shows it");
  EXPECT_EQ(texts.error("[prototype.tree]\nsphere = [{}]\n[[instance]]\nof = 'tere'"),
            "t.toml:4:6: of: unknown prototype 'tere'; did you mean 'tree'?");
  EXPECT_EQ(texts.error("[prototype.a]\n[[prototype.a.plane]]"),
            "t.toml:2:15: unknown key 'plane' in [prototype.a]; it holds spheres, cylinders, cones, disks, "
            "polygons, cubes, meshes and instances");
  EXPECT_EQ(texts.error("[prototype.a]"), "t.toml:1:1: prototype 'a' holds nothing");
  EXPECT_EQ(texts.error("[prototype.a]\n[[prototype.a.instance]]\nof = 'a'"),
            "t.toml:3:6: of: unknown prototype 'a'; a prototype must stand above what shows it");
}

TEST(TomlInstances, PrototypesThatGrowByPowersEnd) {
  TomlTexts texts;
  std::string text = "[prototype.p0]\nsphere = [{}]\n";
  for (int i = 1; i < 20; ++i)
    text += "[prototype.p" + std::to_string(i) + "]\ninstance = [{ of = 'p" + std::to_string(i - 1) +
            "', repeat = { count = 1000, step = [1, 0, 0] } }]\n";
  EXPECT_EQ(texts.error(text), "t.toml:8:13: the prototypes have more than 4194304 parts in all");
}

TEST(TomlInstances, ManyLargePrototypesEnd) {
  TomlTexts texts;
  EXPECT_EQ(texts.error("[prototype.a]\nsphere = [{ repeat = { count = 2100000, step = [3, 0, 0] } }]\n"
                        "[prototype.b]\ninstance = [{ of = 'a' }]\n"),
            "t.toml:4:13: the prototypes have more than 4194304 parts in all");
}

} // namespace
} // namespace fastrt
