// SPDX-License-Identifier: Apache-2.0
// NFF statements and what becomes of them, and what is said of those that are wrong.
#include "src/load/nff_reader.hpp"

#include <fastrt/error.hpp>
#include <fastrt/render.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

namespace fastrt {
namespace {

struct Read {
  SceneDesc desc;
  Diagnostics diagnostics;
};

Read read(std::string_view text, bool strict = false) {
  Read result;
  result.desc = read_nff(Source::memory(text, "t.nff"), strict, result.diagnostics);
  return result;
}

std::string error_of(std::string_view text, bool strict = false) {
  try {
    read(text, strict);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::string warning_of(std::string_view text) {
  const Read result = read(text);
  return result.diagnostics.count() == 0 ? "" : result.diagnostics.lines().front();
}

const std::string fill = "f 1 0.5 0.25 0.8 0.2 30 0 1\n";

TEST(Nff, TakesTheViewInAnyOrder) {
  const Read result = read("v\nresolution 512 257 angle 45\nup 0 0 1 from 1 2 3 # eye\nat 4 5 6 hither 1\n" +
                           fill + "s 0 0 0 1");
  ASSERT_TRUE(result.desc.camera);
  const Camera& camera = *result.desc.camera;
  EXPECT_EQ(camera.eye, Vec3(1, 2, 3));
  EXPECT_EQ(camera.look_at, Vec3(4, 5, 6));
  EXPECT_EQ(camera.up, Vec3(0, 0, 1));
  EXPECT_EQ(result.desc.width, 512);
  EXPECT_EQ(result.desc.height, 257);
  // 45 degrees between the middles of the first and the last row.
  const CameraFrame frame = make_camera_frame(camera, 512, 257);
  const auto direction = [&](float row) {
    return glm::normalize(frame.corner + 256.0F * frame.du + row * frame.dv);
  };
  EXPECT_NEAR(std::acos(glm::dot(direction(0.5F), direction(256.5F))) * 180 / 3.14159265, 45, 1e-3);
  EXPECT_EQ(result.diagnostics.count(), 0U);
}

TEST(Nff, AByteOrderMarkIsNoWord) {
  const Read result = read("\xEF\xBB\xBFv from 1 2 3 at 4 5 6 up 0 0 1 angle 45\n" + fill + "s 0 0 0 1\n");
  ASSERT_TRUE(result.desc.camera);
  EXPECT_EQ(result.desc.camera->eye, Vec3(1, 2, 3));
  EXPECT_EQ(result.diagnostics.count(), 0U);
  EXPECT_EQ(warning_of("\xEF\xBB\xBFq 1\n").substr(0, 34), "t.nff:1:1: unknown statement 'q': ");
}

TEST(Nff, LightsWithoutAColourShareTheRootOfTheirNumber) {
  const SceneDesc desc = read("l 1 2 3 l 4 5 6 0.5 0.6 0.7\nl 7 8 9\nl 1 1 1 b 0.1 0.2 0.3").desc;
  ASSERT_EQ(desc.lights.size(), 4U);
  EXPECT_EQ(desc.lights[0].intensity, Vec3(0.5F));
  EXPECT_EQ(desc.lights[1].intensity, Vec3(0.5F, 0.6F, 0.7F));
  EXPECT_EQ(desc.lights[3].position, Vec3(1, 1, 1));
  EXPECT_EQ(desc.background, Vec3(0.1F, 0.2F, 0.3F));
}

TEST(Nff, MaterialsAreOfTheFormatsOwnShading) {
  const SceneDesc desc =
      read(fill + "s 0 0 0 1\nf 1 0.5 0.25 0.1 0.125 100 0.75 1.5 s 1 1 1 1\n" + fill + "s 0 0 0 2").desc;
  ASSERT_EQ(desc.materials.size(), 2U); // the first once more
  const Material& opaque = desc.materials[0];
  EXPECT_EQ(opaque.diffuse, 0.8F * Vec3(1, 0.5F, 0.25F));
  EXPECT_EQ(opaque.specular, Vec3(0.2F));
  EXPECT_EQ(opaque.mirror, Vec3(0.2F));
  EXPECT_EQ(opaque.shininess, 30);
  EXPECT_EQ(opaque.specular_model, SpecularModel::phong);
  EXPECT_EQ(opaque.opacity, 1);
  const Material& glass = desc.materials[1];
  EXPECT_EQ(glass.opacity, 1 - 0.75F);
  EXPECT_EQ(glass.opacity * glass.specular, Vec3(0.125F));
  EXPECT_EQ(glass.mirror, Vec3(0.125F));
  EXPECT_EQ(glass.transmission, Vec3(1, 0.5F, 0.25F));
  EXPECT_EQ(glass.ior, 1.5F);
  EXPECT_EQ(desc.spheres.material[2], 0U);
  EXPECT_EQ(desc.spheres.object[2], 2U);
}

TEST(Nff, ManyFillsAreToldApart) {
  std::string text;
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 100000; ++i) text += "f " + std::to_string(i) + " 1 1 1 0 0 0 0\ns 0 0 0 1\n";
  text += "f -0 1 1 1 0 0 0 0\ns 0 0 0 1\nf 0 1 1 1 0 0 1 1\ns 0 0 0 1\nf 0 1 1 1 0 0 1 1\ns 0 0 0 1\n";
  const SceneDesc desc = read(text).desc;
  EXPECT_EQ(desc.materials.size(), 100002U);
  EXPECT_EQ(desc.spheres.material[99999], 99999U);
  EXPECT_EQ(desc.spheres.material[199999], 99999U);
  EXPECT_EQ(desc.spheres.material[200000], 0U);
  EXPECT_EQ(desc.spheres.material[200002], 100001U); // glass, each its own
}

TEST(Nff, ConesMayStandOnOneLineOrTwo) {
  const SceneDesc desc =
      read(fill + "c 0 0 0 1 0 2 0 0.5\nc\n1 1 1 0.25\n2 2 2 0.25\nc 0 0 0 -1 0 1 0 -1").desc;
  ASSERT_EQ(desc.cones.size(), 3U);
  EXPECT_EQ(desc.cones.apex[0], Vec3(0, 2, 0));
  EXPECT_EQ(desc.cones.apex_radius[0], 0.5F);
  EXPECT_EQ(desc.cones.base[1], Vec3(1));
  EXPECT_EQ(desc.cones.capped[0], 0U);
  EXPECT_EQ(desc.cones.base_radius[2], 1);
}

TEST(Nff, PolygonsStayPolygonsAndPatchesBecomeTriangles) {
  const SceneDesc desc = read(fill + "p 3 0 0 0 1 0 0 0 1 0\n"
                                     "p 5 0 0 0 2 0 0 2 2 0 1 0.5 0 0 2 0\n"
                                     "pp 4 0 0 0 0 0 1 1 0 0 0 0 1 1 1 0 0 0 1 0 1 0 0 0 0\n")
                             .desc;
  ASSERT_EQ(desc.polygons.size(), 1U);
  EXPECT_EQ(desc.polygons.vertex.size(), 5U);
  ASSERT_EQ(desc.triangles.size(), 3U);
  EXPECT_EQ(desc.triangles.n0[0], no_index);
  EXPECT_EQ(desc.normals[desc.triangles.n1[1]], Vec3(0, 0, 1));
  EXPECT_EQ(desc.triangles.n2[2], no_index); // a normal of 0 is none
  EXPECT_NO_THROW(Scene{desc});
}

TEST(Nff, TrianglesThatNoRayMeetsAreSkipped) {
  const Read result = read(fill + "p 4 0 0 0 1e13 0 0 1e13 1e13 1e12 0 1e13 0\ns 0 0 0 1\n"
                                  "pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n");
  EXPECT_EQ(result.desc.triangles.size(), 1U);
  EXPECT_EQ(result.diagnostics.lines(),
            (std::vector<std::string>{"t.nff:2:1: a polygon is not flat: it is cut into triangles",
                                      "t.nff:2:1: triangle too large for single precision skipped",
                                      "t.nff:2:1: triangle too large for single precision skipped"}));
}

TEST(Nff, FilesOfStatementsWithoutObjectsAreScenes) {
  EXPECT_EQ(read("").desc.object_names.size(), 0U);
  for (const char* text : {"", "# nothing", "b 0 0 0 l 1 2 3"}) {
    EXPECT_EQ(warning_of(text), "t.nff: no primitives");
    EXPECT_EQ(error_of(text, true), "t.nff: no primitives");
  }
  EXPECT_EQ(warning_of(fill + "s 0 0 0 1"), "");
}

TEST(Nff, ErrorsNameTheirPlace) {
  EXPECT_EQ(error_of("b 1 1\n 1x"), "t.nff:2:2: b: not a number: '1x'");
  EXPECT_EQ(error_of("b 1 1 -1"), "t.nff:1:7: b: a colour must not be negative");
  EXPECT_EQ(error_of("b 1 1 nan"), "t.nff:1:7: b: non-finite number 'nan'");
  EXPECT_EQ(error_of("b 1 1"), "t.nff:1:6: the file ends within 'b'");
  EXPECT_EQ(error_of("\n1 2 3"), "t.nff:2:1: expected a statement (v b l f s c p pp), found '1'");
  EXPECT_EQ(error_of("v from 0 0 1 at 0 0 0 up 0 1 0"), "t.nff:1:1: v: 'angle' is missing");
  EXPECT_EQ(error_of("v angle 180"), "t.nff:1:9: angle: must be between 0 and 180 degrees");
  EXPECT_EQ(error_of("v resolution 0 1"),
            "t.nff:1:14: resolution: '0' is not a whole number from 1 to 65536");
  EXPECT_EQ(error_of(fill + "p 2 0 0 0"), "t.nff:2:3: p: '2' is not a whole number from 3 to 16777216");
  EXPECT_EQ(error_of(fill + "p 16777216 0 0 0"), "t.nff:2:3: the file ends within 'p'");
  EXPECT_EQ(error_of(fill + "s 1 2 3"), "t.nff:2:8: the file ends within 's'");
  EXPECT_EQ(error_of("f 1 1 1 -1 0 1 0 1"), "t.nff:1:9: f: Kd, Ks, shine and T must not be negative");
}

TEST(Nff, LongPolygonsMustBeFlat) {
  const auto comb = [](int count, int depth) {
    std::string text = fill + "p " + std::to_string(count + 1) + "\n0 0 0\n";
    for (int i = 0; i < count; ++i)
      text += std::to_string(1000 + i % 2 * 1000) + ' ' + std::to_string(i) + ' ' +
              std::to_string(i % 3 * depth) + '\n';
    return text;
  };
  EXPECT_EQ(error_of(comb(65535, 0)), "");
  EXPECT_EQ(error_of(comb(65535, 1000)), "t.nff:2:1: a polygon of more than 65535 vertices is not flat");
  EXPECT_EQ(error_of(fill + "pp 65536"), "t.nff:2:4: pp: '65536' is not a whole number from 3 to 65535");
}

TEST(Nff, WarningsNameTheirPlaceAndStrictMakesThemErrors) {
  const struct {
    std::string text, message;
  } cases[] = {
      {"t 1 2 3\nb 0 0 0", "t.nff:1:1: unknown statement 't': its line is skipped"},
      {"s 0 0 0 1", "t.nff:1:1: no 'f' before the first object: a plain white is taken"},
      {fill + "s 0 0 0 0", "t.nff:2:1: a sphere of radius 0 is left out"},
      {fill + "c 1 1 1 1 1 1 1 1", "t.nff:2:1: a cone without length or radius is left out"},
      {fill + "p 3 0 0 0 1 1 1 2 2 2", "t.nff:2:1: a polygon without area is left out"},
      {fill + "p 4 0 0 0 1 0 0 1 1 1 0 1 0", "t.nff:2:1: a polygon is not flat: it is cut into triangles"},
      {fill + "p 3 0 0 0 1e13 0 0 0 1e13 0", "t.nff:2:1: triangle too large for single precision skipped"},
      {fill + "pp 3 0 0 0 0 0 1 1 0 0 0 0 1 2 0 0 0 0 1", "t.nff:2:1: triangle without area skipped"},
      {"f 1 1 1 1 1 1 0.5 0", "t.nff:1:1: f: the index of refraction must be greater than 0: 1 is taken"}};
  for (const auto& [text, message] : cases) {
    EXPECT_EQ(warning_of(text), message);
    EXPECT_EQ(error_of(text, true), message);
    EXPECT_NO_THROW(Scene{read(text).desc}) << text;
  }
}

} // namespace
} // namespace fastrt
