// SPDX-License-Identifier: Apache-2.0
// Photons in boxes that are instances, from wall to wall of one: which wall a photon leaves, and which one
// the eye looks at, must be known in the right instance, or a wall is missing. Every bit is the reference's.
#include "tests/equivalence/random_shots.hpp"
#include "tests/unit/instance_scenes.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

// Four walls of triangles and a bottom that is a disk, or a polygon; open above.
std::uint32_t add_open_box(SceneBuilder& builder, const std::uint32_t (&walls)[2], Random& random) {
  builder.begin_prototype();
  const Vec3 corners[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}};
  for (int i = 0; i < 4; ++i)
    add(builder, grid(1, corners[i], corners[(i + 1) % 4] - corners[i], {0, 0, 2}), walls[i % 2]);
  if (random.below(2) == 0)
    builder.add_disk({0, 0, -1}, {0, 0, 1}, 1.5F, walls[0]);
  else
    builder.add_polygon(std::vector<std::vector<Vec3>>{{std::begin(corners), std::end(corners)}}, walls[0]);
  return builder.end_prototype();
}

// The prototype comes first, so that its triangles have the numbers that are likely to be there by mistake.
Shot boxes_shot(std::uint32_t seed, Integrator integrator) {
  Random random(seed);
  SceneBuilder builder;
  Material matt, shiny;
  matt.diffuse = {0.8F, 0.6F, 0.7F};
  shiny.diffuse = Vec3(0.3F);
  shiny.mirror = {0.6F, 0.7F, 0.5F};
  const std::uint32_t materials[] = {builder.add_material(matt), builder.add_material(shiny)};
  const std::uint32_t box = add_open_box(builder, materials, random);
  for (int i = 0; i < 3; ++i)
    builder.add_instance(box, any_map(random.in_cube(), random.uniform(0.5F, 1.2F), 0.3F, random));
  for (int i = 0; i < 2; ++i) {
    Light light;
    light.position = random.in_cube();
    light.intensity = Vec3(1.0F);
    builder.add_light(light);
  }
  Shot shot{"boxes " + std::to_string(seed), builder.build(), {}, small_settings(21, 13)};
  shot.camera = looking(random.uniform(2, 5) * random.direction(), {}, 60);
  shot.settings.integrator = integrator;
  (integrator == Integrator::forward ? shot.settings.photons : shot.settings.caustic_photons) = 1500;
  shot.settings.max_depth = 5;
  shot.settings.min_contribution = 0;
  shot.settings.seed = random.word();
  return shot;
}

class PhotonBoxes : public testing::TestWithParam<Integrator> {};

TEST_P(PhotonBoxes, AreTheReferences) {
  RayCounts rays;
  for (std::uint32_t seed = 0; seed < static_cast<std::uint32_t>(effort(12)); ++seed) {
    const Shot shot = boxes_shot(seed, GetParam());
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    rays += expected.rays;
    expect_every_isa_makes(expected, shot, {1});
  }
  EXPECT_GT(rays.reflected, slow_build ? 0U : 5000U);
}

std::string integrator_name(const testing::TestParamInfo<Integrator>& info) {
  return info.param == Integrator::forward ? "forward" : "caustics";
}
INSTANTIATE_TEST_SUITE_P(Integrators, PhotonBoxes, testing::Values(Integrator::forward, Integrator::whitted),
                         integrator_name);

} // namespace
} // namespace fastrt::test
