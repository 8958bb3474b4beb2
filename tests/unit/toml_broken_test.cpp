// SPDX-License-Identifier: Apache-2.0
// scene.toml files that are cut off or changed anywhere: an error with its place, or a scene.
#include "tests/unit/toml_test_support.hpp"

#include <string>
#include <string_view>

namespace fastrt {
namespace {

using test::contains;
using test::TomlTexts;

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
