// SPDX-License-Identifier: Apache-2.0
// What an OBJ file may hold, and what the scene has then.
#include "tests/unit/obj_test_support.hpp"

namespace fastrt {
namespace {

using namespace test;

constexpr const char* quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::vector<std::uint32_t> values(const Column<std::uint32_t>& column) {
  return {column.begin(), column.end()};
}
using Indices = std::vector<std::uint32_t>;

TEST(ObjStatements, ReadsATriangle) {
  const Loaded loaded = parse("# hello\nv 1 2 3\nv 4.5 -6 7e1\nv .5 +2 0\nf 1 2 3\n");
  const SceneDesc& desc = loaded.desc;
  ASSERT_EQ(desc.positions.size(), 3U);
  EXPECT_EQ(desc.positions[0], Vec3(1, 2, 3));
  EXPECT_EQ(desc.positions[1], Vec3(4.5F, -6, 70));
  EXPECT_EQ(desc.positions[2], Vec3(0.5F, 2, 0));
  ASSERT_EQ(desc.triangles.size(), 1U);
  EXPECT_EQ(desc.triangles.v0[0], 0U);
  EXPECT_EQ(desc.triangles.v1[0], 1U);
  EXPECT_EQ(desc.triangles.v2[0], 2U);
  EXPECT_TRUE(desc.triangles.n0.empty());
  EXPECT_TRUE(desc.triangles.t0.empty());
  ASSERT_EQ(desc.materials.size(), 1U);
  EXPECT_EQ(desc.materials[0].diffuse, Vec3(0.8F));
  EXPECT_EQ(desc.materials[0].ambient, Vec3(0.8F));
  EXPECT_EQ(desc.object_names, std::vector<std::string>{"stem"});
  EXPECT_EQ(loaded.diagnostics.count(), 0U);
}

// All line ends, blanks and continuations mean the same scene.
TEST(ObjStatements, LayoutDoesNotMatter) {
  const Loaded plain = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\no a b\nf 1 2 3\n");
  for (const std::string text :
       {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\no a b\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\ro a b\rf 1 2 3\r", "v 0 0 0\nv 1 0 0\nv 0 1 0\no a b\nf 1 2 3",
        "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\no a b\nf 1 2 3\n",
        "  v\t0  0 0 \t\n\tv 1 0 0\n\n\n v 0 1 0\no\t a b \n  f  1\t2 3  \n",
        "v 0 0 0 # c\nv 1 0 0 #c\nv 0 1 0\no a b\nf 1 2 3 # 4 5 6\n#f 1 2 2",
        "v 0 \\\n0 0\nv 1 0 0\nv \\\n\\\n0 1 0\no a \\\nb\nf 1 2\\\n3\n",
        "v 0 \\\r\n0 0\r\nv 1 0 0\r\nv 0 1 0\r\no a b\r\nf 1 2 \\\r\n 3\r\n",
        "\\\nv 0 0 0\nv 1 0 0\nv 0 1 0\no a b\nf 1 2 3\n",
        "# a comment is not continued \\\nv 0 0 0\nv 1 0 0\nv 0 1 0\no a b\nf 1 2 3\n",
        "v 0 0 0 1\nv 1 0 0 .5\nv 0 1 0 1.0\no a b\nf 1 2 3\n"}) {
    Loaded other = parse(text);
    if (text.find("o a \\") != std::string::npos) other.desc.object_names = plain.desc.object_names;
    EXPECT_TRUE(same_columns(plain.desc, other.desc)) << text;
    EXPECT_EQ(other.diagnostics.count(), 0U) << text;
  }
}

// They are sRGB codes; positions without one are white.
TEST(ObjStatements, PositionsMayHaveColors) {
  const std::string rest = "v 3 3 3 2\nf 1 2 3\n";
  for (const std::string& text :
       {"v 1 2 3 1 0.5 0\nv 4 5 6\nv 0 0 9 0.5 1 0.5 0.04\n" + rest,
        "v 1 2 3  1.0 .5 0.0 # warm\nv 4 5 6\nv 0 0 9\t1 1e0 5e-1 \\\n .04\n" + rest}) {
    const Loaded loaded = parse(text);
    EXPECT_EQ(loaded.diagnostics.count(), 0U);
    const Columns3& colors = loaded.desc.colors;
    ASSERT_EQ(colors.size(), 4U);
    EXPECT_EQ(loaded.desc.positions[0], Vec3(1, 2, 3));
    EXPECT_EQ(colors.x[0], 1.0F);
    EXPECT_NEAR(colors.y[0], 0.21404114, 1e-7);
    EXPECT_EQ(colors.z[0], 0.0F);
    EXPECT_EQ(colors[1], Vec3(1.0F));
    EXPECT_EQ(colors.x[2], 1.0F);
    EXPECT_NEAR(colors.z[2], 0.04 / 12.92, 1e-8);
    EXPECT_EQ(colors[3], Vec3(1.0F)); // only a weight
    ASSERT_EQ(loaded.desc.materials.size(), 1U);
    EXPECT_TRUE(loaded.desc.materials[0].vertex_colors);
    EXPECT_EQ(loaded.desc.materials[0].diffuse, Vec3(1.0F));
    EXPECT_EQ(loaded.desc.materials[0].ambient, Vec3(1.0F));
    EXPECT_NO_THROW(Scene(SceneDesc(loaded.desc)));
  }
  const Loaded plain = parse(quad + std::string("f 1 2 3\n"));
  EXPECT_EQ(plain.desc.colors.size(), 0U);
  EXPECT_FALSE(plain.desc.materials[0].vertex_colors);
}

TEST(ObjStatements, OddColorsAreWarnedAbout) {
  const Loaded loaded = parse("v 0 0 0 2 -1 0.5\nv 1 0 0 1 1\nv 0 1 0 1 0 0 0 0.5\nf 1 2 3\n");
  const auto lines = loaded.warnings();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(contains(lines[0], "t.obj:1:1: a colour's numbers go from 0 to 1"));
  EXPECT_TRUE(contains(lines[1], "t.obj:2:1: 5 numbers after 'v'"));
  EXPECT_TRUE(contains(lines[2], "t.obj:3:1: 8 numbers after 'v'"));
  EXPECT_EQ(loaded.desc.colors.x[0], 1.0F);
  EXPECT_EQ(loaded.desc.colors.y[0], 0.0F);
  EXPECT_NEAR(loaded.desc.colors.z[0], 0.21404114, 1e-7);
  EXPECT_EQ(loaded.desc.colors[1], Vec3(1.0F));
  EXPECT_EQ(loaded.desc.colors[2], Vec3(1.0F));
  EXPECT_TRUE(contains(error_of("v 0 0 0\nv 1 2 3 0.5 x 1\n"), "t.obj:2:13: not a number: 'x'"));
}

TEST(ObjStatements, CornersMayNameTextureCoordinatesAndNormals) {
  const std::string head = std::string(quad) + "vt 0 0\nvt 1 0 0\nvt .5\nvn 0 0 1\nvn 0 0 2\n";
  const Loaded all = parse(head + "f 1/1/1 2/2/2 3/3/1\n");
  EXPECT_EQ(values(all.desc.triangles.t1), Indices{1});
  EXPECT_EQ(values(all.desc.triangles.t2), Indices{2});
  EXPECT_EQ(values(all.desc.triangles.n1), Indices{1});
  EXPECT_EQ(all.desc.uvs.x[2], 0.5F);
  EXPECT_EQ(all.desc.uvs.y[2], 0.0F);
  EXPECT_EQ(all.desc.normals[1], Vec3(0, 0, 2));
  const Loaded uvs = parse(head + "f 1/1 2/2 3/3\n");
  EXPECT_TRUE(uvs.desc.triangles.n0.empty());
  EXPECT_EQ(values(uvs.desc.triangles.t2), Indices{2});
  const Loaded normals = parse(head + "f 1//1 2//2 3//1\n");
  EXPECT_TRUE(normals.desc.triangles.t0.empty());
  EXPECT_EQ(values(normals.desc.triangles.n2), Indices{0});
  const Loaded none = parse(head + "# http://\nf 1 2 3\n");
  EXPECT_TRUE(none.desc.triangles.n0.empty());
  const Loaded some = parse(head + "f 1//1 2//1 3//1\nf 1 2 4\n");
  EXPECT_EQ(values(some.desc.triangles.n0), (Indices{0, no_index}));
  EXPECT_EQ(some.diagnostics.count(), 0U);
}

// As some exporters write what has no texture coordinates or no normals.
TEST(ObjStatements, CornersMayEndInSlashes) {
  const std::string head = std::string(quad) + "vt 0 0\nvn 0 0 1\n";
  for (const std::string bare :
       {"f 1 2 3\n", "f 1// 2// 3//\n", "f 1/ 2/ 3/\n", "f  1// 2/ -2\t\n", "f 1// \\\n2/ 3//\n"}) {
    const Loaded loaded = parse(head + bare);
    EXPECT_EQ(values(loaded.desc.triangles.v2), Indices{2}) << bare;
    EXPECT_TRUE(loaded.desc.triangles.t0.empty()) << bare;
    EXPECT_TRUE(loaded.desc.triangles.n0.empty()) << bare;
    EXPECT_EQ(loaded.diagnostics.count(), 0U) << bare;
  }
  const Loaded uvs = parse(head + "f 1/1/ 2/1/ 3/-1/ 4/1\n");
  EXPECT_EQ(values(uvs.desc.triangles.t0), (Indices{0, 0}));
  EXPECT_TRUE(uvs.desc.triangles.n0.empty());
  EXPECT_EQ(uvs.diagnostics.count(), 0U);
}

TEST(ObjStatements, MixedCornersAreKeptWithAWarning) {
  const Loaded loaded = parse(std::string(quad) + "vt 0 0\nvn 0 0 1\nf 1/1 2//1 3\n");
  EXPECT_EQ(loaded.desc.triangles.t0[0], 0U);
  EXPECT_EQ(loaded.desc.triangles.n0[0], no_index);
  EXPECT_EQ(loaded.desc.triangles.t1[0], no_index);
  EXPECT_EQ(loaded.desc.triangles.n1[0], 0U);
  EXPECT_EQ(loaded.desc.triangles.t2[0], no_index);
  ASSERT_EQ(loaded.warnings().size(), 1U);
  EXPECT_TRUE(contains(loaded.warnings()[0], "t.obj:7:1: "));
}

TEST(ObjStatements, NegativeIndicesCountBack) {
  const Loaded loaded =
      parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf -3/-1 -2/-1 -1/-1\nv 5 5 5\nf -4 -3 -1\n");
  EXPECT_EQ(values(loaded.desc.triangles.v0), (Indices{0, 0}));
  EXPECT_EQ(values(loaded.desc.triangles.v1), (Indices{1, 1}));
  EXPECT_EQ(values(loaded.desc.triangles.v2), (Indices{2, 3}));
}

TEST(ObjStatements, PositiveIndicesMayComeBeforeTheirVertices) {
  const Loaded loaded = parse("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_EQ(loaded.desc.triangles.size(), 1U);
  EXPECT_EQ(loaded.diagnostics.count(), 0U);
}

TEST(ObjStatements, ObjectsAreCounted) {
  const std::string face = "f 1 2 3\n";
  const Loaded loaded = parse(quad + face + "o one\n" + face + face + "g group\n" + face + "o two words \n" +
                              face + "o\n" + face);
  EXPECT_EQ(loaded.desc.object_names, (std::vector<std::string>{"stem", "one", "two words", "default"}));
  EXPECT_EQ(values(loaded.desc.triangles.object), (Indices{0, 1, 1, 1, 2, 3}));
  const Loaded named = parse(quad + ("o one\n" + face) + "o two\n" + face);
  EXPECT_EQ(named.desc.object_names, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(values(named.desc.triangles.object), (Indices{0, 1}));
}

TEST(ObjStatements, GroupsAreObjectsWhereThereAreNone) {
  const std::string face = "f 1 2 3\n";
  const Loaded loaded = parse(quad + face + "g a\n" + face + "g\n" + face + "g a\n" + face);
  EXPECT_EQ(loaded.desc.object_names, (std::vector<std::string>{"stem", "a", "default", "a"}));
  EXPECT_EQ(values(loaded.desc.triangles.object), (Indices{0, 1, 2, 3}));
}

TEST(ObjStatements, OtherStatementsAreSkippedWithOneWarningEach) {
  const Loaded loaded =
      parse(std::string(quad) + "l 1 2\np 1\nl 2 3\nvp 1 2\ncurv 0 1 1 2\nfoo 1 2\nfoo 3\nv1 2 3\nf 1 2 3\n");
  const auto lines = loaded.warnings();
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_TRUE(contains(lines[0], "t.obj:5:1: statements 'l'"));
  EXPECT_TRUE(contains(lines[1], "t.obj:6:1: statements 'p'"));
  EXPECT_TRUE(contains(lines[4], "t.obj:10:1: unknown keyword 'foo'"));
  EXPECT_TRUE(contains(lines[5], "unknown keyword 'v1'"));
  EXPECT_EQ(loaded.desc.triangles.size(), 1U);
}

TEST(ObjStatements, AnEmptyFileHasNoPrimitives) {
  for (const char* text : {"", "# nothing\n# here", "\n\n", "v 0 0 0\n", "\\", "\xEF\xBB\xBF"}) {
    const Loaded loaded = parse(text);
    EXPECT_EQ(loaded.desc.triangles.size(), 0U);
    EXPECT_EQ(loaded.desc.materials.size(), 1U);
    ASSERT_FALSE(loaded.warnings().empty());
    EXPECT_EQ(loaded.warnings().back(), "t.obj: no primitives");
  }
}

TEST(ObjStatements, SmoothingGroupsMakeNormals) {
  // Two faces of a roof: one group gives the ridge a mean normal, two groups or none give each its own.
  const std::string roof = "v 0 0 0\nv 0 0 1\nv 1 -1 0\nv -1 -1 0\n";
  const Loaded one = parse(roof + "s 1\nf 1 2 3\nf 2 1 4\n");
  const TriangleColumns& rows = one.desc.triangles;
  ASSERT_EQ(rows.n0.size(), 2U);
  EXPECT_EQ(rows.n0[0], rows.n1[1]);
  EXPECT_EQ(rows.n1[0], rows.n0[1]);
  const Vec3 ridge = one.desc.normals[rows.n0[0]];
  EXPECT_NEAR(ridge.x, 0, 1e-6);
  EXPECT_NEAR(ridge.y, 1, 1e-6);
  EXPECT_NEAR(glm::length(one.desc.normals[rows.n2[0]]), 1, 1e-6);

  const Loaded two = parse(roof + "s 1\nf 1 2 3\ns 2\nf 2 1 4\n");
  EXPECT_NE(two.desc.triangles.n0[0], two.desc.triangles.n1[1]);
  EXPECT_NEAR(two.desc.normals[two.desc.triangles.n0[0]].x, std::sqrt(0.5F), 1e-6);

  const Loaded off = parse(roof + "s 1\ns off\nf 1 2 3\ns 0\nf 2 1 4\n");
  ASSERT_EQ(off.desc.triangles.n0.size(), 2U);
  EXPECT_EQ(values(off.desc.triangles.n0), (Indices{no_index, no_index}));
  EXPECT_TRUE(parse(roof + "f 1 2 3\n").desc.triangles.n0.empty());
}

TEST(ObjStatements, NormalsInTheFileWinOverSmoothing) {
  const Loaded loaded =
      parse("v 0 0 0\nv 0 0 1\nv 1 -1 0\nv -1 -1 0\nvn 0 1 0\ns 3\nf 1//1 2//1 3//1\nf 2 1 4\n");
  EXPECT_EQ(loaded.desc.triangles.n0[0], 0U);
  EXPECT_NE(loaded.desc.triangles.n0[1], no_index);
  EXPECT_GT(loaded.desc.normals.size(), 1U);
  EXPECT_TRUE(is_sound(loaded.desc));
}

// A wide face counts by its angle at the corner, not by its area or by the number of its triangles.
TEST(ObjStatements, SmoothNormalsAreWeightedByAngle) {
  const Loaded loaded = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 9 9 0\ns 1\n"
                              "f 1 2 5\nf 1 5 3\n" // the right angle in z = 0 split in two
                              "f 1 3 4\nf 1 4 2\n");
  const Vec3 corner = loaded.desc.normals[loaded.desc.triangles.n0[0]];
  EXPECT_NEAR(corner.x, corner.z, 1e-6);
  EXPECT_NEAR(corner.y, corner.z, 1e-6);
}

TEST(ObjStatements, MaterialNamesMayHoldBlanksAndHashes) {
  const Loaded loaded = parse(
      std::string(quad) + "usemtl Material #25\nf 1 2 3\nusemtl red # the wall\nf 1 2 3\nusemtl\nf 1 2 3\n");
  const auto lines = loaded.warnings();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(contains(lines[0], "t.obj:5:1: material 'Material #25' is not defined"));
  EXPECT_TRUE(contains(lines[1], "material 'red' is not defined"));
  EXPECT_TRUE(contains(lines[2], "without a name"));
}

TEST(ObjStatements, ZeroNormalsGiveWayToTheFace) {
  const Loaded loaded = parse(std::string(quad) + "vn 0 0 0\nvn 0 0 1\nf 1//1 2//2 3//2\n");
  EXPECT_EQ(loaded.desc.triangles.n0[0], no_index);
  EXPECT_EQ(loaded.desc.triangles.n1[0], 1U);
  ASSERT_EQ(loaded.warnings().size(), 1U);
  EXPECT_TRUE(contains(loaded.warnings()[0], "t.obj:5:1: "));
}

} // namespace
} // namespace fastrt
