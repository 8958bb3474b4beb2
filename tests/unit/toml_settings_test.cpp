// SPDX-License-Identifier: Apache-2.0
// Camera, picture, lights and materials of scene.toml.
#include "tests/unit/toml_test_support.hpp"

#include <string>

namespace fastrt {
namespace {

using test::contains;
using test::Loaded;
using test::TomlTexts;

TEST(TomlSettings, CamerasHaveEverythingThatCamerasHave) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc("[camera]\neye = [1, 2, 3]\nlook_at = [4, 5, 6]\nup = [0, 0, 1]\n"
                                    "window = [-2, 2, -1, 1]\nfocal = 2.5\naperture = 0.1\nfocus = 7\n");
  ASSERT_TRUE(desc.camera);
  EXPECT_EQ(desc.camera->eye, Vec3(1, 2, 3));
  EXPECT_EQ(desc.camera->look_at, Vec3(4, 5, 6));
  EXPECT_EQ(desc.camera->up, Vec3(0, 0, 1));
  ASSERT_TRUE(desc.camera->window);
  EXPECT_EQ(desc.camera->window->left, -2);
  EXPECT_EQ(desc.camera->window->top, 1);
  EXPECT_EQ(desc.camera->focal_distance, 2.5F);
  EXPECT_EQ(desc.camera->aperture_radius, 0.1F);
  EXPECT_EQ(desc.camera->focus_distance, 7);
  EXPECT_EQ(desc.camera->projection, Projection::perspective);
  const SceneDesc parallel = texts.desc("[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n"
                                        "projection = 'orthographic'\nheight = 3\n");
  EXPECT_EQ(parallel.camera->projection, Projection::orthographic);
  EXPECT_EQ(parallel.camera->view_height, 3);
  EXPECT_FALSE(texts.desc("").camera);
}

TEST(TomlSettings, CamerasWithoutAPlaceShowTheWholeScene) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc("[picture]\nwidth = 200\nheight = 100\n[camera]\nfov = 20\n"
                                    "[[sphere]]\ncenter = [10, 0, 0]");
  const Camera framed = frame_scene(bounds_of(desc), 20, 2);
  EXPECT_EQ(desc.camera->eye, framed.eye);
  EXPECT_EQ(desc.camera->look_at, framed.look_at);
  EXPECT_TRUE(desc.camera_place_is_chosen);
  const SceneDesc parallel = texts.desc("[camera]\nprojection = 'orthographic'\n[[sphere]]\nradius = 5");
  EXPECT_EQ(parallel.camera->view_height,
            orthographic_height(bounds_of(parallel), *parallel.camera, 4.0F / 3));
  EXPECT_TRUE(parallel.camera_height_is_chosen);
  const SceneDesc said = texts.desc("[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n"
                                    "projection = 'orthographic'\nheight = 3\n");
  EXPECT_FALSE(said.camera_place_is_chosen || said.camera_height_is_chosen);
}

TEST(TomlSettings, CamerasThatMakeNoSenseAreRefused) {
  TomlTexts texts;
  const auto error = [&](const std::string& text) { return texts.error("[camera]\n" + text); };
  EXPECT_EQ(error("eye = [0, 0, 1]"), "t.toml:1:1: [camera]: 'look_at' is missing");
  EXPECT_EQ(error("look_at = [0, 0, 1]"), "t.toml:1:1: [camera]: 'eye' is missing");
  EXPECT_EQ(error("fov = 180"), "t.toml:2:7: fov: must be greater than 0 and less than 180");
  EXPECT_EQ(error("height = 1"), "t.toml:2:1: [camera]: only orthographic cameras have a 'height'");
  EXPECT_EQ(error("projection = 'orthographic'\naperture = 1"),
            "t.toml:3:1: [camera]: orthographic cameras have no 'aperture'");
  EXPECT_EQ(error("projection = 'fish'"),
            "t.toml:2:14: projection: unknown 'fish'; known: perspective, orthographic");
  EXPECT_EQ(error("fov = 3\nwindow = [0, 1, 0, 1]"), "t.toml:3:1: [camera] has both 'fov' and 'window'");
  EXPECT_EQ(error("window = [0, 1, 2, 2]"), "t.toml:2:10: window: it has no area");
  EXPECT_EQ(error("eye = [0, 0, 0]\nlook_at = [0, 0, 0]"),
            "t.toml:1:1: degenerate camera: eye and look-at point are the same");
  EXPECT_EQ(error("eye = [0, 5, 0]\nlook_at = [0, 0, 0]"),
            "t.toml:1:1: degenerate camera: the up vector points along the view");
}

TEST(TomlSettings, PicturesHaveSizeAndSettings) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc("[picture]\nwidth = 640\nheight = 480\nspp = 4\nmax_spp = 64\n"
                                    "filter = 'mitchell'\nadaptive = 0.1\nseed = 4294967295\nmax_depth = 3\n"
                                    "min_contribution = 0.5\nlight_samples = 9");
  EXPECT_EQ(desc.width, 640);
  EXPECT_EQ(desc.height, 480);
  EXPECT_EQ(desc.picture.samples_per_pixel, 4);
  EXPECT_EQ(desc.picture.most_samples, 64);
  EXPECT_EQ(desc.picture.filter, PixelFilter::mitchell);
  EXPECT_EQ(desc.picture.adaptive, 0.1F);
  EXPECT_EQ(desc.picture.seed, 4294967295U);
  EXPECT_EQ(desc.picture.max_depth, 3);
  EXPECT_EQ(desc.picture.min_contribution, 0.5F);
  EXPECT_EQ(desc.picture.light_samples, 9);
  EXPECT_FALSE(texts.desc("").picture.samples_per_pixel);
  EXPECT_EQ(texts.error("[picture]\nwidth = 3"), "t.toml:1:1: [picture]: 'height' is missing");
  EXPECT_EQ(texts.error("[picture]\nspp = 0"), "t.toml:2:7: spp: must be a whole number from 1 to 65536");
  EXPECT_EQ(texts.error("[picture]\nspp = 2.5"), "t.toml:2:7: spp: must be a whole number from 1 to 65536");
  EXPECT_EQ(texts.error("[picture]\nspp = 4\nmax_spp = 2"),
            "t.toml:3:1: [picture]: 'max_spp' is less than 'spp'");
  EXPECT_EQ(texts.error("[picture]\nfilter = 'tnet'"),
            "t.toml:2:10: filter: unknown 'tnet'; did you mean 'tent'?");
  EXPECT_EQ(texts.error("[picture]\nadaptive = 2"),
            "t.toml:2:12: adaptive: must be at least 0 and at most 1");
}

TEST(TomlSettings, LightsOfEveryKind) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc(
      "background = [0.1, 0.2, 0.3]\nambient = 0.25\n"
      "[[light]]\ntype = 'point'\nposition = [1, 2, 3]\ncolor = 2\nfade = [1, 0.5, 0.25]\nambient = 0.125\n"
      "[[light]]\ntype = 'directional'\ndirection = [1, -1, 0]\nshadows = false\n"
      "[[light]]\ntype = 'spot'\nposition = [0, 4, 0]\ndirection = [0, -1, 0]\ncone = 3\nexponent = 2\n"
      "[[light]]\ntype = 'rectangle'\nposition = [0, 5, 0]\nu = [1, 0, 0]\nv = [0, 0, 2]\n"
      "[[light]]\ntype = 'disk'\nposition = [0, 6, 0]\ndirection = [0, -2, 0]\nradius = 0.75\n"
      "[[light]]\ntype = 'sphere'\nposition = [0, 7, 0]\nradius = 0.5\n");
  EXPECT_EQ(desc.background, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(desc.ambient, Vec3(0.25F));
  ASSERT_EQ(desc.lights.size(), 6U);
  EXPECT_EQ(desc.lights[0].kind, LightKind::point);
  EXPECT_EQ(desc.lights[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(desc.lights[0].intensity, Vec3(2.0F));
  EXPECT_EQ(desc.lights[0].linear, 0.5F);
  EXPECT_EQ(desc.lights[0].quadratic, 0.25F);
  EXPECT_EQ(desc.lights[0].ambient, Vec3(0.125F));
  EXPECT_TRUE(desc.lights[0].casts_shadows);
  EXPECT_EQ(desc.lights[1].kind, LightKind::directional);
  EXPECT_EQ(desc.lights[1].direction, Vec3(1, -1, 0));
  EXPECT_FALSE(desc.lights[1].casts_shadows);
  EXPECT_EQ(desc.lights[2].kind, LightKind::spot);
  EXPECT_EQ(desc.lights[2].cone_degrees, 3);
  EXPECT_EQ(desc.lights[2].penumbra_degrees, 3); // no more than the cone
  EXPECT_EQ(desc.lights[2].exponent, 2);
  EXPECT_EQ(desc.lights[3].kind, LightKind::rectangle);
  EXPECT_EQ(desc.lights[3].half_v, Vec3(0, 0, 2));
  EXPECT_EQ(desc.lights[4].kind, LightKind::disk);
  EXPECT_EQ(desc.lights[4].radius, 0.75F);
  EXPECT_EQ(desc.lights[5].kind, LightKind::sphere);
  EXPECT_NO_THROW(Scene{desc});
}

TEST(TomlSettings, LightsThatMakeNoSenseAreRefused) {
  TomlTexts texts;
  const auto error = [&](const std::string& text) { return texts.error("[[light]]\n" + text); };
  EXPECT_EQ(error("color = 1"), "t.toml:1:1: [[light]]: 'type' is missing");
  EXPECT_EQ(error("type = 'pint'"), "t.toml:2:8: type: unknown 'pint'; did you mean 'point'?");
  EXPECT_EQ(error("type = 'point'"), "t.toml:1:1: [[light]] of type 'point': 'position' is missing");
  EXPECT_EQ(error("type = 'point'\nradius = 1"),
            "t.toml:3:1: unknown key 'radius' in [[light]] of type 'point'");
  EXPECT_EQ(error("type = 'directional'\ndirection = [0, 0, 0]"), "t.toml:3:13: direction: must not be 0");
  EXPECT_EQ(error("type = 'point'\nposition = [0, 0, 0]\nfade = [0, 0, 0]"),
            "t.toml:4:8: fade: one number must be greater than 0");
  EXPECT_EQ(error("type = 'spot'\nposition = [0, 0, 0]\ndirection = [0, 1, 0]\ncone = 10\npenumbra = 11"),
            "t.toml:6:12: penumbra: must be at least 0 and at most 10");
  EXPECT_EQ(error("type = 'rectangle'\nposition = [0, 0, 0]\nu = [1, 2, 3]\nv = [2, 4, 6]"),
            "t.toml:1:1: [[light]] of type 'rectangle': the sides span no area");
}

TEST(TomlSettings, MaterialsHaveEverythingThatMaterialsHave) {
  TomlTexts texts;
  const SceneDesc desc = texts.desc(
      "[material.full]\ndiffuse = [0.1, 0.2, 0.3]\nambient = 0.5\nspecular = 0.25\nspecular_model = 'phong'\n"
      "shininess = 70\nemission = [1, 0, 0]\nmirror = 0.75\nfresnel = 'schlick'\nopacity = 0.5\n"
      "transmission = [0, 1, 0]\nior = 1.25\nabsorption = [0, 0, 1]\nthin = true\nunlit = true\n"
      "vertex_colors = true\n[material.plain]\n[material.veil]\nopacity = 0.5\n[material.body]\nopacity = 0\n"
      "ior = 1.5\n[material.glass]\npreset = 'glass'\nabsorption = 0.5\n");
  ASSERT_EQ(desc.materials.size(), 5U);
  const Material& full = desc.materials[0];
  EXPECT_EQ(full.name, "full");
  EXPECT_EQ(full.diffuse, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(full.ambient, Vec3(0.5F));
  EXPECT_EQ(full.specular, Vec3(0.25F));
  EXPECT_EQ(full.specular_model, SpecularModel::phong);
  EXPECT_EQ(full.shininess, 70);
  EXPECT_EQ(full.emission, Vec3(1, 0, 0));
  EXPECT_EQ(full.mirror, Vec3(0.75F));
  EXPECT_EQ(full.fresnel, Fresnel::schlick);
  EXPECT_EQ(full.opacity, 0.5F);
  EXPECT_EQ(full.transmission, Vec3(0, 1, 0));
  EXPECT_EQ(full.ior, 1.25F);
  EXPECT_EQ(full.absorption, Vec3(0, 0, 1));
  EXPECT_TRUE(full.thin && full.unlit && full.vertex_colors);
  const Material& plain = desc.materials[1];
  EXPECT_EQ(plain.diffuse, Vec3(0.8F));
  EXPECT_EQ(plain.ambient, Vec3(0.8F));
  EXPECT_EQ(plain.shininess, 10);
  EXPECT_EQ(plain.specular_model, SpecularModel::blinn);
  EXPECT_FALSE(plain.thin);
  EXPECT_TRUE(desc.materials[2].thin);
  EXPECT_FALSE(desc.materials[3].thin);
  EXPECT_EQ(desc.materials[4].ior, 1.5F);
  EXPECT_EQ(desc.materials[4].fresnel, Fresnel::dielectric);
  EXPECT_EQ(desc.materials[4].absorption, Vec3(0.5F));
  EXPECT_EQ(texts.error("[material.a]\nshininess = 0"), "t.toml:2:13: shininess: must be at least 1");
  EXPECT_EQ(texts.error("[material.a]\nopacity = 2"),
            "t.toml:2:11: opacity: must be at least 0 and at most 1");
  EXPECT_EQ(texts.error("[material.a]\nior = 0"), "t.toml:2:7: ior: must be greater than 0");
}

TEST(TomlSettings, TexturesOfFilesAndOfNone) {
  TomlTexts texts;
  // A white pixel that covers half.
  texts.folder().write("white.pgm", "P2 1 1 255\n255\n");
  const Loaded loaded = texts.read(
      "[material.a]\ndiffuse_texture = 'white.pgm'\nspecular_texture = { file = 'white.pgm', scale = 2, "
      "offset = [0.5, 0.25], clamp = true, gain = 0.5, base = 0.25, channel = 'green' }\n"
      "normal_texture = { file = 'white.pgm' }\nbump_scale = 2\n"
      "[material.b]\ndiffuse_texture = { checker = [1, [1, 0, 0]], plane = [[1, 0, 0], [0, 1, 0]] }\n"
      "ambient_texture = { gradient = [0, 1] }\ndiffuse = 0.5\n[[sphere]]\n");
  EXPECT_EQ(loaded.diagnostics.count(), 0U);
  const SceneDesc& desc = loaded.desc;
  ASSERT_EQ(desc.textures.size(), 5U);
  const Material& a = desc.materials[0];
  EXPECT_EQ(a.diffuse, Vec3(1.0F));
  EXPECT_EQ(a.ambient, Vec3(1.0F));
  EXPECT_EQ(a.ambient_texture, a.diffuse_texture);
  EXPECT_EQ(a.specular, Vec3(1.0F));
  EXPECT_TRUE(a.bump_is_normal_map);
  EXPECT_EQ(a.bump_scale, 2);
  const Texture& specular = desc.textures[a.specular_texture];
  EXPECT_EQ(specular.image, desc.textures[a.diffuse_texture].image); // read once
  EXPECT_NE(specular.image, desc.textures[a.bump_texture].image);    // numbers, not colours
  EXPECT_EQ(specular.scale, Vec2(2.0F));
  EXPECT_EQ(specular.offset, Vec2(0.5F, 0.25F));
  EXPECT_TRUE(specular.clamp);
  EXPECT_EQ(specular.gain, 0.5F);
  EXPECT_EQ(specular.base, 0.25F);
  EXPECT_EQ(specular.channel, glm::vec4(0, 1, 0, 0));
  const Texture& checker = desc.textures[desc.materials[1].diffuse_texture];
  EXPECT_EQ(checker.kind, TextureKind::checker);
  EXPECT_EQ(checker.color_b, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(checker.space, TextureSpace::plane);
  EXPECT_EQ(checker.plane_v, Vec3(0, 1, 0));
  EXPECT_EQ(desc.textures[desc.materials[1].ambient_texture].kind, TextureKind::gradient);
  EXPECT_EQ(desc.materials[1].diffuse, Vec3(0.5F));
  EXPECT_NO_THROW(Scene{desc});
}

// Opacity is what a picture's alpha says, if it has any and no channel is named.
TEST(TomlSettings, OpacityComesFromAlpha) {
  TomlTexts texts;
  const std::string header("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0", 16); // a pixel of a Targa file
  texts.folder().write("alpha.tga", header + std::string("\x20\x28\xFF\xFF\xFF\x80", 6));
  texts.folder().write("grey.pgm", "P2 1 1 255\n128\n");
  const SceneDesc desc =
      texts.desc("[material.a]\nopacity_texture = 'alpha.tga'\ndiffuse_texture = 'alpha.tga'\n"
                 "[material.b]\nopacity_texture = 'grey.pgm'\n[material.c]\nopacity_texture = "
                 "{ file = 'alpha.tga', channel = 'red' }\n[[sphere]]\n");
  const auto channel = [&](std::uint32_t texture) { return desc.textures.at(texture).channel; };
  const glm::vec4 alpha(0, 0, 0, 1);
  EXPECT_EQ(channel(desc.materials[0].opacity_texture), alpha);
  EXPECT_NE(channel(desc.materials[0].diffuse_texture), alpha);
  EXPECT_NE(channel(desc.materials[1].opacity_texture), alpha);
  EXPECT_EQ(channel(desc.materials[2].opacity_texture), glm::vec4(1, 0, 0, 0));
}

TEST(TomlSettings, ManyMaterialsDoWithoutTheirMissingTextures) {
  TomlTexts texts;
  texts.folder().write("t.pgm", "P2 1 1 255\n255\n");
  std::string text;
  for (int i = 0; i < 20000; ++i)
    text += "[material.m" + std::to_string(i) + "]\nspecular_texture = 'none.png'\ndiffuse_texture = '" +
            (i % 2 == 0 ? "t.pgm'\n" : "none.png'\n");
  const SceneDesc desc = texts.desc(text + "[[sphere]]\n");
  for (std::size_t i = 0; i < 20000; ++i) {
    ASSERT_EQ(desc.materials[i].specular_texture, no_texture);
    ASSERT_EQ(desc.textures[desc.materials[i].diffuse_texture].image != nullptr, i % 2 == 0);
  }
}

TEST(TomlSettings, TexturesThatCantBeUsed) {
  TomlTexts texts;
  texts.folder().write("text.png", "no picture");
  const Loaded loaded =
      texts.read("[material.a]\ndiffuse_texture = 'none.png'\nspecular_texture = 'text.png'\n"
                 "opacity_texture = '../up.png'\n[[sphere]]\n");
  ASSERT_EQ(loaded.diagnostics.count(), 3U);
  EXPECT_EQ(texts.without_folder(loaded.warnings()[0]), "t.toml:2:19: texture 'none.png' does not exist");
  EXPECT_TRUE(contains(loaded.warnings()[1], "t.toml:3:20: texture 'text.png' is no PNG"));
  EXPECT_TRUE(contains(loaded.warnings()[2], "t.toml:4:19: texture '../up.png' lies outside the scene dir"));
  const Material& a = loaded.desc.materials[0];
  EXPECT_EQ(loaded.desc.textures[a.diffuse_texture].kind, TextureKind::checker);
  EXPECT_EQ(a.specular_texture, no_texture);
  EXPECT_EQ(a.opacity_texture, no_texture);
  EXPECT_NO_THROW(Scene{loaded.desc});
  LoadOptions strict;
  strict.strict = true;
  EXPECT_EQ(texts.error("[material.a]\ndiffuse_texture = 'none.png'", strict),
            "t.toml:2:19: texture 'none.png' does not exist");
  EXPECT_EQ(texts.error("[material.a]\ndiffuse_texture = { scale = 1 }"),
            "t.toml:2:19: diffuse_texture: expected one of 'file', 'checker' and 'gradient'");
  EXPECT_EQ(texts.error("[material.a]\nbump_texture = { checker = [0, 1] }"),
            "t.toml:2:16: bump_texture: must be a picture");
  EXPECT_EQ(texts.error("[material.a]\nbump_texture = 'a'\nnormal_texture = 'b'"),
            "t.toml:3:1: [material.a] has both 'bump_texture' and 'normal_texture'");
}

} // namespace
} // namespace fastrt
