// SPDX-License-Identifier: Apache-2.0
// scene.toml and other files: includes, side-cars, and the documentation's examples.
#include "tests/unit/toml_test_support.hpp"

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace fastrt {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::Loaded;
using test::TomlTexts;

TEST(TomlIncludes, AddAndMayBeChanged) {
  TomlTexts texts;
  texts.folder().write("look/colors.toml",
                       "background = 0.5\n[material.red]\ndiffuse = [1, 0, 0]\nior = 1.25\n"
                       "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\n");
  texts.folder().write("look/ball.toml", "include = 'colors.toml'\n[[mesh]]\nfile = 'm.obj'\n[[sphere]]\n"
                                         "material = 'red'\n[prototype.p]\nsphere = [{}]\n");
  texts.folder().write("look/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const SceneDesc desc = texts.desc("include = ['look/ball.toml', 'look/colors.toml']\n[camera]\nfov = 20\n"
                                    "[material.red]\ndiffuse = [0.5, 0, 0]\n[[sphere]]\nmaterial = 'red'\n"
                                    "[[instance]]\nof = 'p'\n");
  EXPECT_EQ(desc.background, Vec3(0.5F));
  EXPECT_EQ(desc.camera->eye, Vec3(0, 0, 9));
  EXPECT_EQ(desc.camera->fov_degrees, 20);
  EXPECT_EQ(desc.triangles.size(), 1U);
  EXPECT_EQ(desc.spheres.size(), 3U);
  EXPECT_EQ(desc.instances.size(), 1U);
  EXPECT_EQ(desc.spheres.material[0], desc.spheres.material[2]);
  const Material& red = desc.materials[desc.spheres.material[0]];
  EXPECT_EQ(red.diffuse, Vec3(0.5F, 0, 0));
  EXPECT_EQ(red.ambient, Vec3(0.5F, 0, 0));
  EXPECT_EQ(red.ior, 1.25F); // what is not said stays
}

TEST(TomlIncludes, AnAmbientTermOfItsOwnStays) {
  TomlTexts texts;
  const std::string checker = "_texture = { checker = [0, 1] }\n";
  texts.folder().write("known.toml", "[material.own]\nambient = [0, 1, 0]\nambient" + checker +
                                         "[material.none]\nambient_texture = false\ndiffuse" + checker +
                                         "[material.same]\ndiffuse" + checker);
  std::string text = "include = 'known.toml'\n";
  for (const std::string name : {"own", "none", "same"})
    text += "[material." + name + "]\ndiffuse = 0.5\ndiffuse" + checker;
  const std::vector<Material> materials = texts.desc(text + "[[sphere]]\n").materials;
  EXPECT_EQ(materials[0].ambient, Vec3(0, 1, 0));
  EXPECT_EQ(materials[0].ambient_texture, 0U);
  EXPECT_EQ(materials[1].ambient_texture, no_texture);
  EXPECT_EQ(materials[2].ambient, Vec3(0.5F));
  EXPECT_EQ(materials[2].ambient_texture, materials[2].diffuse_texture);
  EXPECT_EQ(materials[2].diffuse, Vec3(0.5F));
}

TEST(TomlIncludes, CyclesAndDepthEnd) {
  TomlTexts texts;
  texts.folder().write("a.toml", "include = 'b.toml'");
  texts.folder().write("b.toml", "\ninclude = ['t.toml']");
  EXPECT_EQ(texts.error("include = 'a.toml'"),
            "b.toml:2:12: include: include cycle: 't.toml' is being read already");
  EXPECT_EQ(texts.error("include = 't.toml'"),
            "t.toml:1:11: include: include cycle: 't.toml' is being read already");
  fs::create_symlink("t.toml", texts.folder().path() / "link.toml");
  EXPECT_EQ(texts.error("include = 'link.toml'"),
            "t.toml:1:11: include: include cycle: 'link.toml' is being read already");
  for (int i = 0; i < 20; ++i)
    texts.folder().write("d" + std::to_string(i) + ".toml",
                         "include = 'd" + std::to_string(i + 1) + ".toml'");
  EXPECT_EQ(texts.error("include = 'd0.toml'"),
            "d14.toml:1:11: include: includes are more than 16 files deep");
}

TEST(TomlIncludes, StayInTheScenesFolder) {
  TomlTexts texts;
  test::TemporaryFolder elsewhere;
  const std::string outside = elsewhere.write("x.toml", "[[sphere]]").string();
  EXPECT_EQ(texts.error("include = '../x.toml'"), "t.toml:1:11: include: scene file '../x.toml' lies outside "
                                                  "the scene directory, and external files are not allowed");
  EXPECT_TRUE(contains(texts.error("include = '" + outside + "'"), "lies outside the scene directory"));
  fs::create_symlink(outside, texts.folder().path() / "y.toml");
  EXPECT_TRUE(contains(texts.error("include = 'y.toml'"), "lies outside the scene directory"));
  LoadOptions options;
  options.allow_external_files = true;
  EXPECT_EQ(texts.read("include = 'y.toml'", options).desc.spheres.size(), 1U);
  EXPECT_EQ(texts.read("include = '" + outside + "'", options).desc.spheres.size(), 1U);
  EXPECT_EQ(texts.error("include = 'none.toml'"),
            "t.toml:1:11: include: scene file 'none.toml' does not exist");
  texts.folder().write("m.obj", "");
  EXPECT_EQ(texts.error("include = 'm.obj'"),
            "t.toml:1:11: include: only .toml files can be included; a [[mesh]] shows others");
  EXPECT_EQ(texts.error("include = 3"), "t.toml:1:11: include: expected an array, found a number");
  texts.folder().write("bad.toml", "\n[[sphere]]\nradius = -1");
  EXPECT_EQ(texts.error("include = 'bad.toml'"), "bad.toml:3:10: radius: must be greater than 0");
}

constexpr const char* house = "mtllib house.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wall\nf 1 2 3\n";

Loaded load_house(const TomlTexts& texts, bool sidecar = true) {
  Loaded loaded;
  LoadOptions options;
  options.sidecar = sidecar;
  loaded.desc = load_scene(texts.folder().path() / "house.obj", options, loaded.diagnostics);
  return loaded;
}

TEST(TomlSidecars, CompleteAnObjFile) {
  TomlTexts texts;
  const fs::path path = texts.folder().write("house.obj", house);
  texts.folder().write("house.mtl", "newmtl wall\nKd 1 0 0\nKs 0.5 0.5 0.5\n");
  EXPECT_EQ(find_sidecar(path), "");
  EXPECT_FALSE(load_house(texts).desc.camera);
  texts.folder().write("scene.toml", "background = 0.25\n");
  EXPECT_EQ(find_sidecar(path), texts.folder().path() / "scene.toml");
  EXPECT_EQ(load_house(texts).desc.background, Vec3(0.25F));
  texts.folder().write(
      "house.toml", "[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n[material.wall]\ndiffuse = [0, 1, 0]\n"
                    "[[light]]\ntype = 'point'\nposition = [0, 0, 5]\n[[sphere]]\nmaterial = 'wall'\n"
                    "[[mesh]]\nfile = 'house.obj'\n");
  EXPECT_EQ(find_sidecar(path), texts.folder().path() / "house.toml");
  const SceneDesc desc = load_house(texts).desc;
  EXPECT_TRUE(desc.camera);
  EXPECT_EQ(desc.lights.size(), 1U);
  EXPECT_FALSE(desc.background);
  ASSERT_EQ(desc.triangles.size(), 1U); // the mesh is there already
  ASSERT_EQ(desc.spheres.size(), 1U);
  EXPECT_EQ(desc.spheres.material[0], desc.triangles.material[0]);
  const Material& wall = desc.materials[desc.triangles.material[0]];
  EXPECT_EQ(wall.diffuse, Vec3(0, 1, 0));
  EXPECT_EQ(wall.specular, Vec3(0.5F)); // what is not said stays
  EXPECT_NO_THROW(Scene{desc});
  const SceneDesc alone = load_house(texts, false).desc;
  EXPECT_FALSE(alone.camera);
  EXPECT_EQ(alone.materials[alone.triangles.material[0]].diffuse, Vec3(1, 0, 0));
}

TEST(TomlFiles, ScenesThatShowNothingAreWarnedAbout) {
  TomlTexts texts;
  LoadOptions strict;
  strict.strict = true;
  for (const char* text : {"", "background = 1\n", "[[prototype.ball.sphere]]\n"}) {
    const auto lines = texts.read(text).warnings();
    ASSERT_EQ(lines.size(), 1U) << text;
    EXPECT_EQ(texts.without_folder(lines[0]), "t.toml: no primitives");
    EXPECT_EQ(texts.error(text, strict), "t.toml: no primitives");
  }
  for (const char* text : {"[[plane]]", "[[disk]]", "[[prototype.a.sphere]]\n[[instance]]\nof = 'a'",
                           "[[prototype.a.sphere]]\n[[sphere]]"})
    EXPECT_EQ(texts.read(text).diagnostics.count(), 0U) << text;
  texts.folder().write("house.obj", house);
  texts.folder().write("house.mtl", "newmtl wall\n");
  texts.folder().write("house.toml", "background = 1\n");
  EXPECT_EQ(load_house(texts).diagnostics.count(), 0U); // the OBJ file has them
}

TEST(TomlSidecars, SayWhichMaterialsShowVertexColors) {
  TomlTexts texts;
  std::string colored = house;
  colored.replace(colored.find("v 0 0 0"), 7, "v 0 0 0 1 0 0");
  texts.folder().write("house.obj", colored);
  texts.folder().write("house.mtl", "newmtl wall\nmap_Kd missing.png\n");
  for (const bool shows : {true, false}) {
    texts.folder().write("house.toml",
                         std::string("[material.wall]\nvertex_colors = ") + (shows ? "true" : "false"));
    const SceneDesc desc = load_house(texts).desc;
    EXPECT_EQ(desc.materials[desc.triangles.material[0]].vertex_colors, shows);
    EXPECT_NO_THROW(Scene{desc});
  }
}

TEST(TomlSidecars, AreOfTheSceneAlone) {
  TomlTexts texts;
  texts.folder().write("house.obj", house);
  texts.folder().write("house.mtl", "newmtl wall\n");
  texts.folder().write("house.toml", "[[sphere]]\n");
  EXPECT_TRUE(texts.desc("[[mesh]]\nfile = 'house.obj'\n").spheres.size() == 0);
  EXPECT_EQ(find_sidecar("x/house.ply"), "");
  texts.folder().write("house.toml", "[[spere]]\n");
  EXPECT_THROW(load_house(texts), InputError);
  EXPECT_NO_THROW(load_house(texts, false));
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The ```toml blocks of the page that describes the format.
std::vector<std::string> examples() {
  const std::string page = contents(fs::path(FASTRT_SOURCE_DIR) / "docs/scene-toml.md");
  const std::string open = "```toml\n";
  std::vector<std::string> blocks;
  for (auto at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    blocks.push_back(page.substr(at, page.find("```", at) - at));
  }
  return blocks;
}

TEST(TomlPage, ExamplesWork) {
  TomlTexts texts;
  for (const auto& entry : fs::directory_iterator(fs::path(FASTRT_SOURCE_DIR) / "scenes"))
    fs::create_symlink(entry.path(), texts.folder().path() / entry.path().filename());
  texts.folder().write("common.toml", "[material.red]\n");
  LoadOptions options;
  options.allow_external_files = true; // of the links
  ASSERT_GE(examples().size(), 8U);
  for (const std::string& block : examples()) {
    const Loaded loaded = texts.read(block, options);
    EXPECT_EQ(loaded.diagnostics.count(), 0U) << block;
    EXPECT_NO_THROW(Scene{loaded.desc}) << block;
  }
}

TEST(TomlPage, NamesEveryKey) {
  const std::string page = contents(fs::path(FASTRT_SOURCE_DIR) / "docs/scene-toml.md");
  for (const std::string key : {"include",
                                "background",
                                "ambient",
                                "eye",
                                "look_at",
                                "up",
                                "projection",
                                "fov",
                                "height",
                                "window",
                                "focal",
                                "aperture",
                                "focus",
                                "width",
                                "spp",
                                "max_spp",
                                "filter",
                                "seed",
                                "adaptive",
                                "max_depth",
                                "min_contribution",
                                "light_samples",
                                "type",
                                "color",
                                "shadows",
                                "position",
                                "direction",
                                "fade",
                                "cone",
                                "penumbra",
                                "exponent",
                                "u",
                                "v",
                                "radius",
                                "preset",
                                "diffuse",
                                "specular",
                                "specular_model",
                                "shininess",
                                "emission",
                                "mirror",
                                "fresnel",
                                "opacity",
                                "transmission",
                                "ior",
                                "absorption",
                                "thin",
                                "unlit",
                                "vertex_colors",
                                "bump_scale",
                                "ambient_texture",
                                "diffuse_texture",
                                "specular_texture",
                                "emission_texture",
                                "opacity_texture",
                                "bump_texture",
                                "normal_texture",
                                "file",
                                "checker",
                                "gradient",
                                "plane",
                                "scale",
                                "offset",
                                "clamp",
                                "gain",
                                "base",
                                "channel",
                                "colorspace",
                                "center",
                                "apex",
                                "capped",
                                "base_radius",
                                "apex_radius",
                                "normal",
                                "points",
                                "holes",
                                "lower",
                                "upper",
                                "materials",
                                "faces",
                                "normals",
                                "uvs",
                                "colors",
                                "point",
                                "material",
                                "name",
                                "transform",
                                "transforms",
                                "repeat",
                                "matrix",
                                "shear",
                                "rotate",
                                "translate",
                                "axis",
                                "angle",
                                "count",
                                "step",
                                "of"})
    EXPECT_NE(page.find('`' + key + '`'), std::string::npos) << key;
}

} // namespace
} // namespace fastrt
