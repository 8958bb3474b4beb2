// SPDX-License-Identifier: Apache-2.0
#include "src/cli/light_option.hpp"
#include "src/cli/light_text.hpp"

#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace fastrt::cli {
namespace {

TEST(CliLight, LightsOfTheScene) {
  using Source = LightOption::Source;
  const LightOption point = parse_light_option("--light", "point:1,2,3");
  EXPECT_EQ(point.source, Source::described);
  EXPECT_EQ(point.light.position, Vec3(1, 2, 3));
  EXPECT_EQ(parse_light_option("--light", "default").source, Source::defaults);

  const LightOption mesh = parse_light_option("--light", "mesh:lamp shade:2:shadows=off");
  EXPECT_EQ(mesh.source, Source::material);
  EXPECT_EQ(mesh.material, "lamp shade:2:shadows=off");

  const LightOption all = parse_light_option("--light", "emissive:0.5");
  EXPECT_EQ(all.source, Source::all_emissive);
  EXPECT_EQ(all.light.intensity, Vec3(0.5F));
  for (const char* text :
       {"mesh", "mesh:", "emissive:", "emissive:-1", "emissive:1,2", "emissive:shadows=no", "default:1"})
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

TEST(CliLight, LightsAreChosen) {
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

// The message of the UsageError that the text causes, or "".
std::string error_of(const char* text, const SceneDesc& desc = {}) {
  try {
    chosen(desc, {text});
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

TEST(CliLight, FieldsFollowAMaterialsName) {
  const SceneDesc lamps = with_materials({1});
  const Light light = chosen(lamps, {"mesh:m0:2:shadows=off:ambient=0,0,1"})[0];
  EXPECT_EQ(light.kind, LightKind::mesh);
  EXPECT_EQ(light.intensity, Vec3(2.0F));
  EXPECT_FALSE(light.casts_shadows);
  EXPECT_EQ(light.ambient, Vec3(0, 0, 1));
  EXPECT_EQ(chosen(lamps, {"mesh:m0:1,0,2"})[0].intensity, Vec3(1, 0, 2));
  for (const char* text : {"mesh:m0:0", "mesh:m0:1:1", "mesh:m0:x", "mesh:m0:fade=1,0,0", "mesh:m0:"})
    EXPECT_THROW(chosen(lamps, {text}), UsageError) << text;
}

TEST(CliLight, NamesOfMaterialsMayHoldColons) {
  SceneDesc desc = with_materials({1, 1, 1, 1});
  desc.materials[0].name = "ns:li ght";
  desc.materials[1].name = "ns";
  desc.materials[2].name = "ns:li ght:2";
  desc.materials[3].name = "";
  EXPECT_EQ(chosen(desc, {"mesh:ns:li ght"})[0].material, 0U);
  EXPECT_EQ(chosen(desc, {"mesh:ns:li ght:0.5"})[0].material, 0U);
  EXPECT_EQ(chosen(desc, {"mesh:ns:li ght:0.5:shadows=off"})[0].intensity, Vec3(0.5F));
  EXPECT_EQ(chosen(desc, {"mesh:ns:0.5"})[0].material, 1U);
  EXPECT_EQ(chosen(desc, {"mesh:ns:li ght:2"})[0].material, 2U); // the longest name
  EXPECT_EQ(chosen(desc, {"mesh:ns:li ght:2"})[0].intensity, Vec3(1));
  EXPECT_EQ(error_of("mesh:other:light", desc),
            "--light: there is no material 'other:light'; those that emit light: ns:li ght, ns, ns:li ght:2");
  EXPECT_NE(error_of("mesh::2", desc), "");
}

TEST(CliLight, MaterialsThatCannotShineAreNamed) {
  SceneDesc desc = with_materials({0, 1});
  desc.materials.emplace_back();
  desc.materials.back().name = "unused";
  desc.materials.back().emission = Vec3(1);
  EXPECT_EQ(error_of("mesh:m0", desc),
            "--light: the material 'm0' emits nothing (Ke); those that emit light: m1");
  EXPECT_EQ(error_of("mesh:unused:2", desc),
            "--light: no triangle has the material 'unused'; those that emit light: m1");
  EXPECT_EQ(error_of("mesh:m0", with_materials({0})),
            "--light: the material 'm0' emits nothing (Ke); those that emit light: none");
}

TEST(CliLight, MessagesSayWhichPartIsWrong) {
  constexpr const char* spot = "; a spot is spot:X,Y,Z:DX,DY,DZ:CONE[,PENUMBRA[,EXPONENT]]";
  EXPECT_EQ(error_of("none"),
            "--light: 'none' is no kind of light: point, dir, spot, rect, disk, sphere, mesh, "
            "emissive, default");
  EXPECT_EQ(error_of("sopt:1,2,3"), error_of("sopt"));
  EXPECT_NE(error_of("sopt").find("; did you mean 'spot'?"), std::string::npos);
  EXPECT_EQ(error_of("default:2"), "--light: nothing follows 'default'");
  EXPECT_EQ(error_of("mesh"), "--light: MATERIAL is missing; a mesh is mesh:MATERIAL[:SCALE]");
  EXPECT_EQ(error_of("point:1,2"), "--light: '1,2' is not X,Y,Z (three numbers); a point is point:X,Y,Z");
  EXPECT_EQ(error_of("dir:0,0,0"),
            "--light: '0,0,0' is not X,Y,Z (three numbers, not all 0); a dir is dir:X,Y,Z");
  EXPECT_EQ(error_of("spot:0,0,3:0,0,-1"),
            std::string("--light: CONE[,PENUMBRA[,EXPONENT]] is missing") + spot);
  EXPECT_EQ(
      error_of("spot:0,0,3:0,0,-1:30,40"),
      std::string("--light: '30,40' is not CONE[,PENUMBRA[,EXPONENT]] (CONE up to 180 degrees, PENUMBRA "
                  "no wider than it, EXPONENT at least 0)") +
          spot);
  EXPECT_EQ(error_of("disk:1,2,3:0,1,0:0"), "--light: '0' is not RADIUS (a number greater than 0); a disk is "
                                            "disk:X,Y,Z:NX,NY,NZ:RADIUS");
  EXPECT_EQ(error_of("point:1,2,3:shadow=off"), "--light: 'shadow' is no field of a light: fade, ambient or "
                                                "shadows; did you mean 'shadows'?");
  EXPECT_EQ(error_of("point:1,2,3:shadows=no"), "--light: 'shadows=no' is not shadows=on or shadows=off");
  EXPECT_EQ(error_of("point:1,2,3:1,1"),
            "--light: '1,1' is not a colour R,G,B (three numbers that are at least 0)");
  EXPECT_EQ(error_of("point:1,2,3:1,1,1:2"),
            "--light: '2' is not expected here: what follows the colour has a name");
  EXPECT_EQ(error_of("point:1,2,3:fade=1"),
            "--light: 'fade=1' is not fade=C,L,Q (numbers that are at least 0, not all 0)");
  EXPECT_EQ(error_of("dir:1,2,3:fade=1,1,1"), "--light: 'fade=1,1,1': parallel light can't fade");
  EXPECT_EQ(error_of("emissive:0"),
            "--light: '0' is not a SCALE (a number greater than 0, or three R,G,B that "
            "are at least 0)");
}

TEST(CliLight, RectanglesHaveAnArea) {
  EXPECT_EQ(error_of("rect:1,2,3:0.1,0.2,0.3:0.3,0.6,0.9"),
            "--light: 'rect:1,2,3:0.1,0.2,0.3:0.3,0.6,0.9': the sides span no area");
  EXPECT_EQ(error_of("rect:1,2,3:0.1,0.2,0.3:0.3,0.6,0.90001"), "");
}

TEST(CliLight, Lights) {
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
