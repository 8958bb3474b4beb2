// SPDX-License-Identifier: Apache-2.0
#include "src/cli/light_option.hpp"
#include "src/cli/parse.hpp"

#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace fastrt::cli {
namespace {

TEST(CliParse, IntegersInsideTheRange) {
  EXPECT_EQ(parse_integer("--spp", "1", 1, 8), 1);
  EXPECT_EQ(parse_integer("--spp", "8", 1, 8), 8);
  EXPECT_EQ(parse_integer("--n", "-3", -3, 8), -3);
}

TEST(CliParse, IntegersThatAreNone) {
  for (const char* text : {"0", "9", "-1", "abc", "", " 1", "1 ", "1.5", "1e0", "0x1", "+1", "1,",
                           "1000000000", "99999999999999999999"}) {
    EXPECT_THROW(parse_integer("--spp", text, 1, 8), UsageError) << text;
  }
}

TEST(CliParse, MessagesNameTheOptionAndTheText) {
  try {
    parse_integer("--spp", "x", 1, 8);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()), "--spp: 'x' is not a whole number from 1 to 8");
  }
}

TEST(CliParse, Numbers) {
  EXPECT_EQ(parse_number("--fov", "40"), 40.0F);
  EXPECT_EQ(parse_number("--fov", "+.5"), 0.5F);
  EXPECT_EQ(parse_number("--fov", "-1e-3"), -1e-3F);
  for (const char* text :
       {"", "+", "-", "nan", "inf", "-inf", "1e999", "1,5", "1x", "0x1p3", "+-1", "++1", " 1"}) {
    EXPECT_THROW(parse_number("--fov", text), UsageError) << text;
  }
}

TEST(CliParse, Vectors) {
  EXPECT_EQ(parse_vector("--eye", "1,-2,3.5"), Vec3(1, -2, 3.5F));
  for (const char* text : {"", "1", "1,2", "1,2,", "1,2,3,", "1,2,3,4", ",,", "1;2;3", "1,2,nan", "1, 2,3"}) {
    EXPECT_THROW(parse_vector("--eye", text), UsageError) << text;
  }
}

TEST(CliParse, ColorsAreNotNegative) {
  EXPECT_EQ(parse_color("--ambient", "0,0.5,2"), Vec3(0, 0.5F, 2));
  EXPECT_THROW(parse_color("--ambient", "0,-0.5,2"), UsageError);
}

TEST(CliParse, Resolutions) {
  for (const char* text : {"640x480", "640X480", "640,480"}) {
    const Resolution size = parse_resolution("-r", text);
    EXPECT_EQ(size.width, 640) << text;
    EXPECT_EQ(size.height, 480) << text;
  }
  EXPECT_EQ(parse_resolution("-r", "65536x65536").height, 65536);
  for (const char* text : {"", "640", "x", "640x", "x480", "0x480", "640x0", "-5x5", "65537x1", "1x65537",
                           "99999999x1", "640x480x3", "640 x 480", "6.4x4"}) {
    EXPECT_THROW(parse_resolution("-r", text), UsageError) << text;
  }
}

TEST(CliParse, LightsOfTheScene) {
  using Source = LightOption::Source;
  const LightOption point = parse_light_option("--light", "point:1,2,3");
  EXPECT_EQ(point.source, Source::described);
  EXPECT_EQ(point.light.position, Vec3(1, 2, 3));
  EXPECT_EQ(parse_light_option("--light", "default").source, Source::defaults);

  const LightOption mesh = parse_light_option("--light", "mesh:lamp shade:2:shadows=off:ambient=0,0,1");
  EXPECT_EQ(mesh.source, Source::material);
  EXPECT_EQ(mesh.material, "lamp shade");
  EXPECT_EQ(mesh.light.kind, LightKind::mesh);
  EXPECT_EQ(mesh.light.intensity, Vec3(2.0F));
  EXPECT_FALSE(mesh.light.casts_shadows);
  EXPECT_EQ(mesh.light.ambient, Vec3(0, 0, 1));
  EXPECT_EQ(parse_light_option("--light", "mesh:lamp:1,0,2").light.intensity, Vec3(1, 0, 2));

  const LightOption all = parse_light_option("--light", "emissive:0.5");
  EXPECT_EQ(all.source, Source::all_emissive);
  EXPECT_EQ(all.light.intensity, Vec3(0.5F));
  for (const char* text : {"mesh", "mesh:", "mesh:a:0", "mesh:a:1:1", "mesh:a:x", "mesh:a:fade=1,0,0",
                           "emissive:-1", "emissive:1,2", "emissive:shadows=no", "default:1"})
    EXPECT_THROW(parse_light_option("--light", text), UsageError) << text;
}

SceneDesc with_materials(std::initializer_list<float> emissions) {
  SceneDesc desc;
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) desc.positions.push_back(corner);
  for (const float emission : emissions) {
    const auto i = static_cast<std::uint32_t>(desc.materials.size());
    desc.materials.emplace_back();
    desc.materials.back().name = "m" + std::to_string(i);
    desc.materials.back().emission = {0, emission, 0};
    desc.triangles.v0.push_back(0);
    desc.triangles.v1.push_back(1);
    desc.triangles.v2.push_back(2);
    desc.triangles.material.push_back(i);
    desc.triangles.object.push_back(0);
  }
  desc.object_names.emplace_back("all");
  return desc;
}

std::vector<Light> chosen(SceneDesc desc, std::initializer_list<const char*> texts) {
  std::vector<LightOption> options;
  for (const char* text : texts) options.push_back(parse_light_option("--light", text));
  choose_lights(options, bounds_of(desc), Camera(), desc);
  return desc.lights;
}

TEST(CliParse, LightsAreChosen) {
  const SceneDesc lamps = with_materials({0, 2, 0.5F});
  ASSERT_EQ(chosen(lamps, {}).size(), 1U); // the one brighter than 1
  EXPECT_EQ(chosen(lamps, {})[0].kind, LightKind::mesh);
  EXPECT_EQ(chosen(lamps, {})[0].material, 1U);
  ASSERT_EQ(chosen(lamps, {"emissive:3"}).size(), 2U);
  EXPECT_EQ(chosen(lamps, {"emissive:3"})[1].material, 2U);
  EXPECT_EQ(chosen(lamps, {"emissive:3"})[1].intensity, Vec3(3.0F));
  ASSERT_EQ(chosen(lamps, {"mesh:m2", "point:1,2,3"}).size(), 2U);
  EXPECT_EQ(chosen(lamps, {"mesh:m2", "point:1,2,3"})[0].material, 2U);
  EXPECT_EQ(chosen(lamps, {"default"}).size(), 2U);
  EXPECT_EQ(chosen(lamps, {"default"})[0].kind, LightKind::directional);
  EXPECT_EQ(chosen(with_materials({1}), {})[0].kind, LightKind::directional); // a glow, but no lamp

  SceneDesc lit = lamps;
  lit.lights.emplace_back();
  EXPECT_EQ(chosen(lit, {}).size(), 1U);
  EXPECT_EQ(chosen(lit, {})[0].kind, LightKind::point);
  EXPECT_EQ(chosen(lit, {"default", "emissive"}).size(), 4U);
  EXPECT_THROW(chosen(lamps, {"mesh:m3"}), UsageError);
  EXPECT_THROW(chosen(with_materials({0}), {"emissive"}), UsageError);
}

TEST(CliParse, Lights) {
  const Light point = parse_light("--light", "point:1,2,3");
  EXPECT_EQ(point.kind, LightKind::point);
  EXPECT_EQ(point.position, Vec3(1, 2, 3));
  EXPECT_EQ(point.intensity, Vec3(1));
  EXPECT_TRUE(point.casts_shadows);

  const Light directional = parse_light("--light", "dir:0,-1,0:0.5,0,2");
  EXPECT_EQ(directional.kind, LightKind::directional);
  EXPECT_EQ(directional.direction, Vec3(0, -1, 0));
  EXPECT_EQ(directional.intensity, Vec3(0.5F, 0, 2));

  const Light spot = parse_light("--light", "spot:1,2,3:0,-1,0:30,10,2:1,0,0:ambient=0.1,0.2,0.3");
  EXPECT_EQ(spot.kind, LightKind::spot);
  EXPECT_EQ(spot.direction, Vec3(0, -1, 0));
  EXPECT_EQ(spot.cone_degrees, 30.0F);
  EXPECT_EQ(spot.penumbra_degrees, 10.0F);
  EXPECT_EQ(spot.exponent, 2.0F);
  EXPECT_EQ(spot.intensity, Vec3(1, 0, 0));
  EXPECT_EQ(spot.ambient, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(parse_light("--light", "spot:1,2,3:0,-1,0:30").penumbra_degrees, 0.0F);

  const Light rectangle = parse_light("--light", "rect:1,2,3:1,0,0:0,0,2:shadows=off:fade=0,0,1");
  EXPECT_EQ(rectangle.kind, LightKind::rectangle);
  EXPECT_EQ(rectangle.half_u, Vec3(1, 0, 0));
  EXPECT_EQ(rectangle.half_v, Vec3(0, 0, 2));
  EXPECT_FALSE(rectangle.casts_shadows);
  EXPECT_EQ(rectangle.constant, 0.0F);
  EXPECT_EQ(rectangle.quadratic, 1.0F);

  EXPECT_EQ(parse_light("--light", "disk:1,2,3:0,1,0:2").kind, LightKind::disk);
  const Light sphere = parse_light("--light", "sphere:1,2,3:0.5:0,0,1");
  EXPECT_EQ(sphere.kind, LightKind::sphere);
  EXPECT_EQ(sphere.radius, 0.5F);
  EXPECT_EQ(sphere.intensity, Vec3(0, 0, 1));

  for (const char* text : {"",
                           "point",
                           "point:",
                           "point:1,2",
                           "spot:1,2,3",
                           "1,2,3",
                           "dir:0,0,0",
                           "spot:1,2,3:0,0,0:30",
                           "spot:1,2,3:0,1,0",
                           "spot:1,2,3:0,1,0:0",
                           "spot:1,2,3:0,1,0:181",
                           "spot:1,2,3:0,1,0:30,31",
                           "spot:1,2,3:0,1,0:30,1,1,1",
                           "disk:1,2,3:0,1,0:0",
                           "rect:1,2,3:0,1,0",
                           "sphere:1,2,3",
                           "sphere:1,2,3:-1",
                           "point:1,2,3:fade=0,0,0",
                           "dir:1,2,3:fade=1,1,1",
                           "point:1,2,3:fade=1,1",
                           "point:1,2,3:shadows=no",
                           "point:1,2,3:what=1",
                           "point:1,2,3:fade=1,0,0:1,1,1",
                           "point:1,2,3:",
                           "point:1,2,3:1,1",
                           "point:1,2,3:1,1,1:2",
                           "point:1,2,3:1,-1,1",
                           "point:1,2,nan",
                           "POINT:1,2,3"}) {
    EXPECT_THROW(parse_light("--light", text), UsageError) << text;
  }
}

} // namespace
} // namespace fastrt::cli
