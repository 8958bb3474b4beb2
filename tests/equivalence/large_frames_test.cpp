// SPDX-License-Identifier: Apache-2.0
// Larger pictures of larger scenes: every ISA against the scalar tree.
#include "tests/equivalence/designed_shots.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

// Hills of small triangles, a ball of 20,480 of them, mirrors and glass around it.
Shot landscape(bool transparent) {
  Random random(81);
  Stage stage;
  stage.light_up();
  const std::uint32_t stone = stage.builder.add_material(shiny(SpecularModel::phong, 20));
  const Mesh ball = icosphere(5);
  const Mesh placed_ball = placed(jittered(ball, 0.004F, random), 0.9F, {0, 0, 0});
  stage.builder.add_mesh(placed_ball.positions, placed_ball.indices, stone, ball.positions);
  Mesh hills = grid(60, {-4, -1.2F, 3}, {8, 0, 0}, {0, 0, -6});
  for (Vec3& position : hills.positions) position.y += 0.3F * random.uniform();
  add(stage.builder, hills, stage.builder.add_material(matte({0.3F, 0.6F, 0.2F})));
  stage.sphere({-1.8F, 0.2F, 0}, 0.7F, mirror(Vec3(0.8F)));
  stage.ball({1.8F, 0.2F, 0.3F}, 0.7F, mirror({0.7F, 0.8F, 0.3F}), true);
  if (transparent) stage.sphere({0.8F, 0.3F, 1.6F}, 0.6F, glass(1.5F, {0.8F, 1, 0.9F}, {0.5F, 0.1F, 0.2F}));
  return stage.shot(transparent ? "transparent" : "opaque", slow_build ? 64 : 320, slow_build ? 40 : 200);
}

class LargeFrames : public testing::TestWithParam<Shot> {};

TEST_P(LargeFrames, AreTheScalarTrees) {
  const Shot& shot = GetParam();
  const Frame expected = render(make_tracer(shot.scene, Isa::scalar), shot.camera, shot.settings);
  EXPECT_GT(pixels_with_hits(expected), expected.primitive.size() / 2);
  EXPECT_GT(expected.rays.reflected, expected.primitive.size() / 20);
  for (const Isa isa : simd_isas())
    expect_equal(render(make_tracer(shot.scene, isa), shot.camera, shot.settings), expected,
                 shot.name + ", " + isa_word(isa));
}

INSTANTIATE_TEST_SUITE_P(Shots, LargeFrames, testing::Values(landscape(false), landscape(true)),
                         [](const testing::TestParamInfo<Shot>& shot) { return shot.param.name; });

} // namespace
} // namespace fastrt::test
