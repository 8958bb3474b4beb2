// SPDX-License-Identifier: Apache-2.0
// scene.toml and other files: includes, side-cars, the documentation's examples, and files that are broken.
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
  EXPECT_EQ(texts.error("include = '../x.toml'"),
            "t.toml:1:11: include: scene file '../x.toml' lies outside the scene directory");
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
  EXPECT_EQ(desc.background, Vec3(0.0F));
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

// A scene that uses much of the format in about 2 KiB; its texture is missing.
const std::string& busy_scene() {
  static const std::string text = R"(include = ["common.toml"]
background = [0.35, 0.55, 0.85]
ambient = 0.12
[picture]
width = 96
height = 60
spp = 4
filter = "mitchell"
[camera]
eye = [1.2, 3.1, 10.5]
look_at = [0, 1.35, 0]
up = [0, 1, 0]
window = [-1, 1, -0.6, 0.6]
aperture = 0.01
[[light]]
type = "spot"
position = [2.5, 8.5, 5]
direction = [-2.5, -7.5, -5]
color = [1.1, 1.0, 0.85]
cone = 32
penumbra = 14
fade = [1, 0, 0.01]
[[light]]
type = "rectangle"
position = [-5, 6, 6]
u = [1, 0, 0]
v = [0, 0.5, 0]
shadows = false
[material.floor]
diffuse_texture = { checker = [[0.62, 0.58, 0.52], 0.2], plane = [[1, 0, 0], [0, 0, 1]], scale = 0.8 }
mirror = 0.12
[material."a glass"]
preset = "glass"
absorption = [1.6, 0.15, 1.0]
[material.gold]
diffuse = [0.45, 0.28, 0.06]
specular_model = "phong"
fresnel = "schlick"
specular_texture = { file = "t.pgm", channel = "red", colorspace = "linear" }
normal_texture = "t.pgm"
[[plane]]
point = [0, -1, 0]
material = "floor"
transform = { rotate = { axis = [1, 0, 0], angle = 3 } }
[[polygon]]
points = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]
holes = [[[1, 1, 0], [2, 1, 0], [1, 2, 0]]]
[[cylinder]]
base = [-2.7, 0.1, -4.6]
apex = [-2.7, 5, -4.6]
radius = 0.36
capped = false
[[cube]]
upper = [2, 2, 2]
material = "gold"
transforms = [[1, 0, 0], [1, 0, 0, 5, 0, 2, 0, 6, 0, 1, 1, 7], { scale = [1, 2, -1] }]
[[mesh]]
file = "m.obj"
material = "gold"
[[mesh]]
name = "gem"
points = [[2.6, 0.63, 3.4], [1.9, 0.63, 3.9], [1.4, 0.63, 3.2], [2, 1.25, 3.3]]
faces = [[0, 3, 1], [1, 3, 2], [2, 3, 0], [2, 1, 0]]
uvs = [[0, 0], [1, 0], [1, 1], 0]
[prototype.tree]
cone = [{ base = [0, 0, 0], apex = [0, 1, 0] }, { transform = { translate = [0, 1, 0], shear = { xy = 0.2 } } }]
[[instance]]
of = "tree"
name = "tree"
repeat = [{ count = 9, step = [2, 0, 0] }, { count = 9, step = { rotate = { axis = [0, 1, 0], angle = 40 } } }]
)";
  return text;
}

class BrokenToml : public testing::Test {
protected:
  void SetUp() override {
    texts_.folder().write("common.toml", "[material.red]\n");
    texts_.folder().write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }

  // Reads it; what it says may only be an InputError or LimitError.
  void try_text(const std::string& text) {
    try {
      LoadOptions options;
      options.threads = 1;
      const SceneDesc desc = texts_.read(text, options).desc;
      if (desc.instances.size() < 1000) ++fine_;
    } catch (const InputError& error) {
      ++refused_;
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos);
      EXPECT_TRUE(contains(message, ".toml:")) << text;
    } catch (const LimitError&) {
      ++refused_;
    }
  }

  TomlTexts texts_;
  int fine_ = 0, refused_ = 0;
};

TEST_F(BrokenToml, IsFineWhole) {
  EXPECT_GT(busy_scene().size(), 1800U);
  EXPECT_EQ(texts_.error(busy_scene()), "");
}

TEST_F(BrokenToml, CutOffAnywhere) {
  for (std::size_t i = 0; i < busy_scene().size(); ++i) try_text(busy_scene().substr(0, i));
  EXPECT_GT(fine_, 50);
  EXPECT_GT(refused_, 500);
}

TEST_F(BrokenToml, WithOtherBytes) {
  constexpr std::string_view others("\0\x80-9.[]{}='\"#\n e", 16);
  for (std::size_t i = 0; i < busy_scene().size(); ++i) {
    std::string text = busy_scene();
    text[i] = others[i % others.size()];
    try_text(text);
  }
  EXPECT_GT(fine_, 50);
  EXPECT_GT(refused_, 500);
}

TEST_F(BrokenToml, WithPiecesLeftOutOrTwice) {
  for (std::size_t i = 0; i + 9 < busy_scene().size(); i += 3) {
    std::string text = busy_scene();
    try_text(text.erase(i, 1 + i % 9));
    try_text(busy_scene().substr(0, i + 9) + busy_scene().substr(i));
  }
  EXPECT_GT(refused_, 500);
}

} // namespace
} // namespace fastrt
