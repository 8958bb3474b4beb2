// SPDX-License-Identifier: Apache-2.0
// Primitives and meshes of scene.toml.
#include "tests/unit/toml_test_support.hpp"

#include <string>

namespace fastrt {
namespace {

using test::Loaded;
using test::TomlTexts;

TEST(TomlShapes, EveryKindLandsInItsColumns) {
  TomlTexts texts;
  const SceneDesc desc =
      texts.desc("[material.red]\ndiffuse = [1, 0, 0]\n"
                 "[[sphere]]\ncenter = [1, 2, 3]\nradius = 4\nmaterial = 'red'\nname = 'ball'\n"
                 "[[cylinder]]\nbase = [0, 0, 0]\napex = [0, 2, 0]\nradius = 0.5\ncapped = false\n"
                 "[[cone]]\nbase = [0, 0, 0]\napex = [0, 3, 0]\nbase_radius = 2\napex_radius = 1\n"
                 "[[disk]]\ncenter = [5, 0, 0]\nnormal = [0, 1, 0]\nradius = 6\n"
                 "[[polygon]]\npoints = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]\n"
                 "holes = [[[1, 1, 0], [2, 1, 0], [1, 2, 0]]]\n"
                 "[[plane]]\npoint = [0, -1, 0]\nnormal = [0, 2, 0]\n");
  ASSERT_EQ(desc.spheres.size(), 1U);
  EXPECT_EQ(desc.spheres.y[0], 2);
  EXPECT_EQ(desc.spheres.radius[0], 4);
  EXPECT_EQ(desc.materials[desc.spheres.material[0]].name, "red");
  EXPECT_EQ(desc.object_names[desc.spheres.object[0]], "ball");
  ASSERT_EQ(desc.cones.size(), 2U);
  EXPECT_EQ(desc.cones.apex[0], Vec3(0, 2, 0));
  EXPECT_EQ(desc.cones.base_radius[0], 0.5F);
  EXPECT_EQ(desc.cones.apex_radius[0], 0.5F);
  EXPECT_EQ(desc.cones.capped[0], 0U);
  EXPECT_EQ(desc.cones.base_radius[1], 2);
  EXPECT_EQ(desc.cones.apex_radius[1], 1);
  EXPECT_EQ(desc.cones.capped[1], 1U);
  EXPECT_EQ(desc.materials[desc.cones.material[0]].name, "default");
  EXPECT_EQ(desc.disks.center[0], Vec3(5, 0, 0));
  EXPECT_EQ(desc.disks.radius[0], 6);
  ASSERT_EQ(desc.polygons.size(), 1U);
  EXPECT_EQ(desc.polygons.vertex_end, (Column<std::uint32_t>{4, 7}));
  EXPECT_EQ(desc.polygons.contour_end, (Column<std::uint32_t>{2}));
  EXPECT_EQ(desc.planes.point[0], Vec3(0, -1, 0));
  EXPECT_EQ(desc.planes.normal[0], Vec3(0, 1, 0));
  EXPECT_EQ(desc.object_names,
            (std::vector<std::string>{"ball", "cylinder 1", "cone 1", "disk 1", "polygon 1", "plane 1"}));
  EXPECT_TRUE(desc.prototypes.empty());
  EXPECT_NO_THROW(Scene{desc});
}

TEST(TomlShapes, WithoutNumbersTheyAreOfUnitSize) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc("[[cone]]\n[[sphere]]\n[[cylinder]]\n[[disk]]\n[[plane]]\n[[cube]]");
  EXPECT_EQ(desc.spheres.radius[0], 1);
  EXPECT_EQ(desc.cones.base[0], Vec3(0, 0, -1));
  EXPECT_EQ(desc.cones.apex[0], Vec3(0, 0, 1));
  EXPECT_EQ(desc.cones.apex_radius[0], 0);
  EXPECT_EQ(desc.cones.apex_radius[1], 1);
  EXPECT_EQ(desc.disks.normal[0], Vec3(0, 0, 1));
  EXPECT_EQ(desc.planes.normal[0], Vec3(0, 1, 0));
  // In the order of the file.
  EXPECT_EQ(desc.object_names.front(), "cone 1");
  EXPECT_EQ(desc.object_names.back(), "cube 1");
  EXPECT_NO_THROW(Scene{desc});
}

TEST(TomlShapes, CubesTurnOutwards) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc("[[cube]]\nlower = [1, 2, 3]\nupper = [3, 5, 7]");
  ASSERT_EQ(desc.triangles.size(), 12U);
  const Vec3 middle(2, 3.5F, 5);
  float area = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const Vec3 a = desc.positions[desc.triangles.v0[i]], b = desc.positions[desc.triangles.v1[i]],
               c = desc.positions[desc.triangles.v2[i]];
    const Vec3 normal = glm::cross(b - a, c - a);
    EXPECT_GT(glm::dot(normal, a - middle), 0) << i;
    area += 0.5F * glm::length(normal);
  }
  EXPECT_FLOAT_EQ(area, 2 * (2 * 3 + 3 * 4 + 2 * 4));
  EXPECT_TRUE(test::is_sound(desc));
}

TEST(TomlShapes, ManyCubesLeaveRoomForMore) {
  TomlTexts texts;
  std::string text = "[[mesh]]\npoints = [[0, 0, 0], [1, 0, 0], [1, 1, 0]]\nfaces = [[0, 1, 2]]\n"
                     "normals = [[0, 0, 1], [0, 0, 1], [0, 1, 1]]\ncolors = [1, 1, 1]\n";
  for (int i = 0; i < 100; ++i) text += "[[cube]]\n";
  const SceneDesc desc = texts.desc(text);
  const TriangleColumns& t = desc.triangles;
  ASSERT_EQ(t.size(), 1201U);
  // Columns that have none would be copied once for each cube.
  const auto has_room = [](const auto& column) {
    return column.bytes() > (column.size() + column_padding) * sizeof(column[0]);
  };
  for (const auto* column : {&t.v0, &t.n0, &t.t0, &t.material, &t.object}) EXPECT_TRUE(has_room(*column));
  EXPECT_TRUE(has_room(desc.colors.x));
  EXPECT_EQ(t.n2[1200], no_index);
  EXPECT_EQ(desc.colors[desc.positions.size() - 1], Vec3(1.0F));
}

TEST(TomlShapes, MeshesThatAreWrittenOut) {
  TomlTexts texts;
  const SceneDesc desc =
      texts.desc("[[cube]]\n[[mesh]]\nname = 'roof'\npoints = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\n"
                 "faces = [[0, 1, 2, 3], [0, 1, 2]]\nnormals = [[0, 0, 1], [0, 0, 1], [0, 1, 1], [0, 0, 1]]\n"
                 "uvs = [[0, 0], [1, 0], [1, 1], [0, 1]]\ncolors = [1, 0.5, [1, 0, 0], 0]\n[[cube]]\n");
  ASSERT_EQ(desc.triangles.size(), 27U);
  EXPECT_EQ(desc.triangles.v2[14], 8U + 2U);
  EXPECT_EQ(desc.normals[desc.triangles.n2[14]], Vec3(0, 1, 1));
  EXPECT_EQ(desc.triangles.n0[0], no_index);
  EXPECT_EQ(desc.triangles.n0[26], no_index);
  EXPECT_EQ(desc.uvs.x[desc.triangles.t1[14]], 1);
  EXPECT_EQ(desc.colors[8 + 2], Vec3(1, 0, 0));
  EXPECT_EQ(desc.colors[0], Vec3(1.0F));
  EXPECT_EQ(desc.colors.size(), desc.positions.size());
  EXPECT_EQ(desc.object_names[desc.triangles.object[12]], "roof");
  EXPECT_NO_THROW(Scene{desc});
}

constexpr const char* two_materials = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no a\nusemtl red\nf 1 2 3\n"
                                      "o b\nusemtl blue\nf 1 3 2\n";

TEST(TomlShapes, MeshesOfFilesBringTheirMaterials) {
  TomlTexts texts;
  texts.folder().write("sub/m.obj", two_materials);
  texts.folder().write("sub/m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nmap_Kd t.pgm\n");
  texts.folder().write("sub/t.pgm", "P2 1 1 255\n255\n");
  texts.folder().write("p.ply",
                       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                       "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                       "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  texts.folder().write("n.nff", "b 1 1 1\nl 1 1 1\nf 1 0 0 1 0 1 0 1\ns 0 0 0 2\nc 0 0 0 1 0 1 0 1\n"
                                "p 4 0 0 0 2 0 0 2 2 0 0 2 0\n");
  const Loaded loaded =
      texts.read("[material.gold]\ndiffuse_texture = { checker = [0, 1] }\n[[sphere]]\nmaterial = 'gold'\n"
                 "[[mesh]]\nfile = 'sub/m.obj'\n[[mesh]]\nfile = 'p.ply'\n[[mesh]]\nfile = 'n.nff'\n"
                 "[[mesh]]\nfile = 'sub/m.obj'\nmaterial = 'gold'\nname = 'golden'\n"
                 "[[mesh]]\nfile = 'sub/m.obj'\nmaterials = { blue = 'gold' }\n");
  EXPECT_EQ(loaded.diagnostics.count(), 0U);
  const SceneDesc& desc = loaded.desc;
  const auto material = [&](std::size_t i) { return desc.materials[desc.triangles.material[i]].name; };
  const auto object = [&](std::size_t i) { return desc.object_names[desc.triangles.object[i]]; };
  ASSERT_EQ(desc.triangles.size(), 7U);
  EXPECT_EQ(material(0), "red");
  EXPECT_EQ(material(1), "blue");
  EXPECT_EQ(desc.textures[desc.materials[desc.triangles.material[1]].diffuse_texture].name, "t.pgm");
  EXPECT_EQ(object(0), "a");
  EXPECT_EQ(object(1), "b");
  EXPECT_EQ(object(2), "p");
  EXPECT_EQ(material(3), "gold");
  EXPECT_EQ(object(3), "golden");
  EXPECT_EQ(object(4), "golden");
  EXPECT_EQ(material(5), "red");
  EXPECT_EQ(material(6), "gold");
  EXPECT_EQ(desc.positions[desc.triangles.v1[2]], Vec3(1, 0, 0));
  EXPECT_EQ(desc.spheres.radius[1], 2);
  EXPECT_EQ(desc.cones.size(), 1U);
  EXPECT_EQ(desc.polygons.size(), 1U);
  EXPECT_EQ(desc.positions[desc.polygons.vertex[2]], Vec3(2, 2, 0));
  EXPECT_TRUE(desc.lights.empty()); // a mesh's lights are not the scene's
  EXPECT_FALSE(desc.background);
  EXPECT_NO_THROW(Scene{desc});
}

TEST(TomlShapes, ManyMaterialsOfAFileAreReplaced) {
  TomlTexts texts;
  std::string library, object = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", text, replaced;
  for (int i = 0; i < 5000; ++i) {
    const std::string number = std::to_string(i);
    library += "newmtl own" + number + '\n';
    object += "usemtl own" + number + "\nf 1 2 3\n";
    text += "[material.m" + number + "]\n";
    if (i % 2 == 0) replaced += "own" + number + " = 'm" + number + "',";
  }
  texts.folder().write("m.obj", object);
  texts.folder().write("m.mtl", library);
  replaced.pop_back();
  const SceneDesc desc = texts.desc(text + "[[mesh]]\nfile = 'm.obj'\nmaterials = { " + replaced + " }\n");
  ASSERT_EQ(desc.triangles.size(), 5000U);
  for (std::size_t i = 0; i < 5000; ++i)
    ASSERT_EQ(desc.materials[desc.triangles.material[i]].name,
              (i % 2 == 0 ? "m" : "own") + std::to_string(i));
}

TEST(TomlShapes, WhatMakesNoSenseIsRefused) {
  TomlTexts texts;
  texts.folder().write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  texts.folder().write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(texts.error("[[cylinder]]\nbase = [1, 1, 1]\napex = [1, 1, 1]"),
            "t.toml:1:1: [[cylinder]]: base and apex are the same point");
  EXPECT_EQ(texts.error("[[cone]]\nbase_radius = 0"),
            "t.toml:1:1: [[cone]]: one radius must be greater than 0");
  EXPECT_EQ(texts.error("[[disk]]\nnormal = [0, 0, 0]"), "t.toml:2:10: normal: must not be 0");
  EXPECT_EQ(texts.error("[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0]]"),
            "t.toml:2:10: points: expected at least 3 points, found 2");
  EXPECT_EQ(texts.error("[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]"),
            "t.toml:1:1: [[polygon]]: its points lie on a line");
  EXPECT_EQ(texts.error("[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 0]]"),
            "t.toml:1:1: [[polygon]]: it is not flat");
  EXPECT_EQ(texts.error("[[polygon]]"), "t.toml:1:1: [[polygon]]: 'points' is missing");
  EXPECT_EQ(texts.error("[[cube]]\nlower = [0, 1, 0]"),
            "t.toml:1:1: [[cube]]: 'upper' must be greater than 'lower' in x, y and z");
  EXPECT_EQ(texts.error("[material.red]\n[[sphere]]\nmaterial = 'rde'"),
            "t.toml:3:12: material: unknown material 'rde'; did you mean 'red'?");
  EXPECT_EQ(texts.error("[[mesh]]\nfile = 'none.obj'"),
            "t.toml:2:8: file: mesh file 'none.obj' does not exist");
  EXPECT_EQ(texts.error("[[mesh]]\nfile = '../m.obj'"),
            "t.toml:2:8: file: mesh file '../m.obj' lies outside the scene directory, and external files are "
            "not allowed");
  EXPECT_EQ(texts.error("[[mesh]]\nfile = '.'"), "t.toml:2:8: file: mesh file '.' is not a regular file");
  EXPECT_EQ(texts.error("[[mesh]]\nfile = 't.toml'"),
            "t.toml:2:8: file: cannot tell the format of 't.toml'; known: .obj .ply .nff");
  EXPECT_EQ(texts.error("[[mesh]]\nfile = 'bad.obj'"),
            "bad.obj:2:5: face refers to vertex 2, but only 1 are defined");
  EXPECT_EQ(texts.error("[[mesh]]\nfile = 'm.obj'\npoints = []"),
            "t.toml:3:1: [[mesh]] has both 'file' and 'points'");
  EXPECT_EQ(texts.error("[material.a]\n[[mesh]]\nfile = 'm.obj'\nmaterials = { b = 'a' }"),
            "t.toml:4:15: materials: the mesh has no material 'b'");
  const std::string points = "[[mesh]]\npoints = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n";
  EXPECT_EQ(texts.error(points + "faces = [[0, 1, 3]]"),
            "t.toml:3:17: faces: must be a whole number from 0 to 2");
  EXPECT_EQ(texts.error(points + "faces = [[0, 1]]"),
            "t.toml:3:10: faces: expected the numbers of three points or more, found 2");
  std::string long_face;
  for (int i = 0; i < 65536; ++i) long_face += "0,";
  EXPECT_EQ(texts.error(points + "faces = [[" + long_face + "]]"),
            "t.toml:3:10: faces: a face has at most 65535 points");
  EXPECT_EQ(texts.error(points + "faces = []"), "t.toml:3:9: faces: expected at least one face");
  EXPECT_EQ(texts.error(points + "faces = [[0, 1, 2]]\nuvs = [[0, 0]]"),
            "t.toml:4:7: uvs: expected one for each of the 3 points, found 1");
}

TEST(TomlShapes, FacesThatNoRayMeetsAreSkipped) {
  TomlTexts texts;
  const std::string mesh =
      "[[mesh]]\npoints = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1e13, 0, 0], [0, 1e13, 0]]\n";
  const Loaded loaded = texts.read(mesh + "faces = [[0, 1, 2], [0, 0, 1], [0, 3, 4], [0, 1, 0, 1]]\n");
  EXPECT_EQ(loaded.desc.triangles.size(), 1U);
  const auto lines = loaded.warnings();
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(texts.without_folder(lines[0]), "t.toml:3:21: triangle without area skipped");
  EXPECT_EQ(texts.without_folder(lines[1]), "t.toml:3:32: triangle too large for single precision skipped");
  EXPECT_TRUE(test::contains(lines[2], "t.toml:3:43: the polygon crosses itself or has no area"));
  EXPECT_NO_THROW(Scene{loaded.desc});
  const Loaded cubes = texts.read("[[cube]]\n[[cube]]\nlower = [0, 0, 0]\nupper = [1e13, 1e13, 1]\n");
  EXPECT_EQ(cubes.desc.triangles.size(), 12U + 8U);
  ASSERT_EQ(cubes.diagnostics.count(), 4U);
  EXPECT_EQ(texts.without_folder(cubes.warnings()[0]),
            "t.toml:2:1: triangle too large for single precision skipped");
  LoadOptions strict;
  strict.strict = true;
  EXPECT_EQ(texts.error(mesh + "faces = [[0, 0, 1]]", strict), "t.toml:3:10: triangle without area skipped");
}

} // namespace
} // namespace fastrt
