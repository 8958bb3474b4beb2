// SPDX-License-Identifier: Apache-2.0
// Pictures of what is far, tiny or huge, of every ISA against the naive reference: where rounding decides,
// and products overflow or vanish.
#include "tests/equivalence/frames.hpp"
#include "tests/equivalence/random_shots.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace fastrt::test {
namespace {

Camera framed(const Vec3& eye, const Vec3& look_at, const Vec3& up, float fov_degrees) {
  Camera camera = looking(eye, look_at, fov_degrees);
  camera.up = up;
  return camera;
}

void add_triangles(SceneBuilder& builder, const std::vector<Vec3>& corners) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < corners.size(); ++i) indices.push_back(i);
  builder.add_mesh(corners, indices, builder.add_material({}));
}

// Rounding moves hits out of the instance's box, from where they are moved back.
Shot distant_instance() {
  SceneBuilder builder;
  Texture checker;
  checker.kind = TextureKind::checker;
  checker.color_a = {1, 1, 1, 1};
  checker.color_b = {0, 0, 0, 1};
  checker.scale = Vec2(8.0F);
  Material material;
  material.diffuse_texture = builder.add_texture(checker);
  material.unlit = true;
  const std::uint32_t checkered = builder.add_material(material);
  builder.begin_prototype();
  builder.add_disk({0, 0, 0}, {-0.4956536F, -0.868335068F, 0.017939046F}, 1, checkered);
  const std::uint32_t disk = builder.end_prototype();
  Affine map; // rows as scene.toml has them
  map.x = {-0.0119258463F, 0.0145461522F, -0.0017255072F};
  map.y = {11.9114866F, 0, -82.3262634F};
  map.z = {54.3053131F, 45.4549446F, 7.85723734F};
  map.origin = {0.131631404F, -0.274115592F, 0.0733958557F};
  builder.add_instance(disk, map);
  Shot shot{"distant instance", builder.build(), {}, small_settings(64, 64)};
  shot.camera = framed({-44402.2422F, 393007.438F, 215349.312F}, {0.131631851F, -0.274114609F, 0.0733966827F},
                       {0.395828515F, 0.912208915F, 0.105804704F}, 0.0228508431F);
  shot.settings.aovs = {Aov::uv};
  return shot;
}

Shot distant_triangle() {
  SceneBuilder builder;
  add_triangles(builder, {{0.111346357F, 0.388097137F, -0.891410589F},
                          {0.112144761F, 0.388049245F, -0.892099738F},
                          {0.111982457F, 0.387457252F, -0.892330408F}});
  Shot shot{"distant triangle", builder.build(), {}, small_settings(64, 64)};
  shot.camera =
      framed({0.0613998771F, -0.0169935226F, 93406.3281F}, {0.0613998771F, -0.0169935226F, 0.0200518072F},
             {-0.741802096F, 0.120082058F, 0.659780264F}, 0.000628607697F);
  return shot;
}

Shot huge_triangles() {
  SceneBuilder builder;
  add_triangles(builder, {{3.9110611e+11F, -3.94974452e+11F, -1.58177819e+11F},
                          {5.75796125e+10F, 2.95253398e+11F, -2.32086544e+11F},
                          {-2.88204803e+11F, -2.25030527e+11F, 1.04382882e+11F},
                          {2.28188978e+11F, -9.56430455e+10F, -1.19275786e+11F},
                          {-9.30243064e+10F, -1.34743965e+11F, -7.36041138e+10F},
                          {-3.75065562e+11F, 278649567, 4.25750812e+11F}});
  Light light;
  light.position = {-3.85862678e+11F, -2.36999401e+13F, -2.44409475e+13F};
  builder.add_light(light);
  Shot shot{"huge triangles", builder.build(), {}, small_settings(64, 64)};
  shot.camera = looking({-1.18798076e+12F, -4.2162297e+11F, -8.12979567e+11F}, {0, 0, 0}, 40);
  shot.settings.aovs = {Aov::shadow};
  return shot;
}

// Triangles that shadow each other, and their light, in a scene of the given size.
Shot tiny_triangles(std::uint32_t seed, float size) {
  Random random(seed);
  SceneBuilder builder;
  std::vector<Vec3> corners;
  for (int i = 0; i < 60; ++i) {
    const Vec3 middle = random.in_cube();
    for (int corner = 0; corner < 3; ++corner) corners.push_back(size * (middle + 0.4F * random.in_cube()));
  }
  add_triangles(builder, corners);
  Light light;
  light.position = size * Vec3(2, 3, 1);
  builder.add_light(light);
  Shot shot{"tiny triangles " + std::to_string(seed), builder.build(), {}, small_settings(48, 48)};
  shot.camera = looking(size * Vec3(1, 0.5F, 3), {0, 0, 0}, 40);
  shot.settings.aovs = {Aov::shadow};
  return shot;
}

void expect_the_references(const Shot& shot) {
  const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
  EXPECT_GT(pixels_with_hits(expected), 0U) << shot.name;
  expect_every_isa_makes(expected, shot, {1});
}

TEST(ExtremeFrames, DistantInstances) { expect_the_references(distant_instance()); }
TEST(ExtremeFrames, DistantTriangles) { expect_the_references(distant_triangle()); }
TEST(ExtremeFrames, HugeTriangles) { expect_the_references(huge_triangles()); }
TEST(ExtremeFrames, TinyTriangles) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) expect_the_references(tiny_triangles(seed, 1e-15F));
}

} // namespace
} // namespace fastrt::test
