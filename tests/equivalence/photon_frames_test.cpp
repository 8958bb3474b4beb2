// SPDX-License-Identifier: Apache-2.0
// Forward pictures and caustics at random, of every ISA and number of threads against the naive reference:
// every bit, every AOV, every count.
#include "tests/equivalence/random_media.hpp"
#include "tests/unit/instance_scenes.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

Light any_lamp(Random& random) {
  Light light = any_light(random);
  light.kind = static_cast<LightKind>(random.below(7));
  light.casts_shadows = random.below(4) != 0;
  light.intensity = Vec3(0.2F) + any_colour(random, 1);
  if (random.below(2) == 0) light.constant = random.uniform(), light.quadratic = random.uniform(0.01F, 0.3F);
  light.direction = random.uniform(0.1F, 3) * (random.in_cube() * 0.5F - light.position);
  light.cone_degrees = random.below(5) == 0 ? 180.0F : random.uniform(10, 90);
  light.penumbra_degrees = random.below(3) == 0 ? 0.0F : random.uniform() * light.cone_degrees;
  if (random.below(2) == 0) light.exponent = random.uniform(0, 10);
  light.half_u = random.uniform(0, 1) * random.direction();
  light.half_v = random.uniform(0, 1) * random.direction();
  light.radius = random.uniform(0.1F, 1);
  return light;
}

void add_things(SceneBuilder& builder, std::uint32_t materials, Random& random) {
  add_ball(builder, random.below(materials), random);
  add_plane(builder, random.below(materials), random);
  add_plane(builder, 0, random);
  for (std::uint32_t i = 1 + random.below(3); i != 0; --i)
    builder.add_sphere(1.5F * random.in_cube(), random.uniform(0.2F, 1), random.below(materials));
  for (std::uint32_t i = random.below(3); i != 0; --i)
    add_any_shape(builder, random.below(materials), 1.5F * random.in_cube(), random.uniform(0.2F, 1), random);
  if (random.below(4) == 0) add_any_plane(builder, random.below(materials), random);
}

// What lights that are meshes are made of: two triangles, or a ball of 20 or 80. Returns its material.
std::uint32_t add_shining(SceneBuilder& builder, Random& random) {
  Material shining = any_material(random);
  shining.emission = {random.uniform(0.1F, 3), random.uniform(), 0};
  const std::uint32_t material = builder.add_material(shining);
  if (random.below(2) == 0)
    add(builder, grid(1, 2.0F * random.in_cube(), random.direction(), random.direction()), material);
  else
    add_ball(builder, material, random);
  return material;
}

// What is special about a scene.
enum class Theme { none, instances, media };

// Prototypes of anything, some of them shown with another material.
void add_instances(SceneBuilder& builder, std::uint32_t materials, Random& random) {
  const std::uint32_t prototypes = 1 + random.below(3);
  for (std::uint32_t i = 0; i < prototypes; ++i)
    add_prototype(builder, random.word(), random.below(materials), random);
  for (std::uint32_t i = 2 + random.below(4); i != 0; --i)
    builder.add_instance(random.below(prototypes),
                         any_map(1.2F * random.in_cube(), random.uniform(0.5F, 1.2F), 0.7F, random),
                         random.below(2) == 0 ? random.below(materials) : no_index);
}

// Two media around the middle, where the lamps and the eye are.
void add_media(SceneBuilder& builder, Random& random) {
  for (int i = 0; i < 2; ++i) {
    const std::uint32_t medium = builder.add_material(any_medium(random));
    if (random.below(2) == 0)
      add_tank(builder, medium, random);
    else
      builder.add_sphere(0.7F * random.in_cube(), random.uniform(0.5F, 4), medium);
  }
}

// Material 0 is diffuse, so that photons leave something.
Scene photon_scene(Random& random, Theme theme) {
  SceneBuilder builder;
  Material floor;
  floor.diffuse = Vec3(0.1F) + any_colour(random, 0.8F);
  builder.add_material(floor);
  const std::uint32_t materials = 2 + random.below(4);
  for (std::uint32_t i = 1; i < materials; ++i) builder.add_material(any_material(random));
  add_things(builder, materials, random);
  if (theme == Theme::instances) add_instances(builder, materials, random);
  if (theme == Theme::media) add_media(builder, random);
  const std::uint32_t shining = add_shining(builder, random);
  for (std::uint32_t i = 1 + random.below(3); i != 0; --i) {
    Light lamp = any_lamp(random);
    lamp.material = shining;
    if (theme == Theme::media) lamp.position *= 0.3F;
    builder.add_light(lamp);
  }
  builder.set_background(any_colour(random, 0.2F));
  return builder.build();
}

Shot photon_shot(std::uint32_t seed, Integrator integrator, Theme theme = Theme::none) {
  Random random(seed);
  Shot shot{"photons " + std::to_string(seed), photon_scene(random, theme), {}, {}};
  const float distance = random.uniform(2, 6);
  shot.camera = looking((theme == Theme::media ? 0.5F * distance : distance) * random.direction(),
                        0.5F * random.in_cube(), random.uniform(30, 90));
  if (random.below(3) == 0) {
    shot.camera.projection = Projection::orthographic;
    shot.camera.view_height = random.uniform(1, 6);
  }
  // So far away that the offsets of the rays to the eye are as large as what they show.
  if (theme == Theme::instances && random.below(2) == 0) {
    shot.camera.eye *= 10000.0F;
    shot.camera.fov_degrees *= 1e-4F;
  }
  shot.settings = small_settings(21, 13);
  shot.settings.integrator = integrator;
  shot.settings.photons = 700 + random.below(1500);
  if (integrator == Integrator::whitted) {
    shot.settings.caustic_photons = shot.settings.photons;
    if (random.below(2) == 0) shot.settings.caustic_radius = random.uniform(0.05F, 1);
    if (random.below(4) == 0) shot.settings.samples_per_pixel = 2;
  }
  shot.settings.max_depth = static_cast<int>(random.below(6));
  shot.settings.min_contribution = random.below(2) == 0 ? 0.0F : 0.02F;
  shot.settings.seed = random.word();
  shot.settings.light_samples = 2;
  if (random.below(3) == 0) shot.settings.crop = Crop{3, 2, 17, 12};
  if (random.below(4) == 0) shot.settings.aovs = {Aov::id, Aov::normal, Aov::shadow};
  return shot;
}

double brightness(const Frame& frame) {
  double sum = 0;
  for (const float value : frame.rgb) sum += static_cast<double>(value);
  return sum;
}

class PhotonFrames : public testing::TestWithParam<std::uint32_t> {};

TEST_P(PhotonFrames, ForwardIsTheReferences) {
  double light = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(effort(8)); ++i) {
    const Shot shot = photon_shot(100 * GetParam() + i, Integrator::forward);
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    light += brightness(expected);
    expect_every_isa_makes(expected, shot, {1, 3});
  }
  EXPECT_GT(light, slow_build ? -1.0 : 0.0);
}

// Whether caustics show: without them the same pictures are darker or brighter.
TEST_P(PhotonFrames, CausticsAreTheReferences) {
  int different = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(effort(8)); ++i) {
    Shot shot = photon_shot(100 * GetParam() + i, Integrator::whitted);
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    expect_every_isa_makes(expected, shot, {1, 3});
    shot.settings.caustic_photons = 0;
    different += render_reference(shot.scene, shot.camera, shot.settings).rgb != expected.rgb ? 1 : 0;
  }
  EXPECT_GT(different, slow_build ? -1 : 0);
}

// Both integrators in scenes of a theme.
void expect_references(std::uint32_t seed, Theme theme) {
  double light = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(effort(6)); ++i) {
    const Integrator integrator = i % 2 == 0 ? Integrator::forward : Integrator::whitted;
    const Shot shot = photon_shot(1000 + 100 * seed + i, integrator, theme);
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    if (integrator == Integrator::forward) light += brightness(expected);
    expect_every_isa_makes(expected, shot, {2});
  }
  EXPECT_GT(light, slow_build ? -1.0 : 0.0);
}

TEST_P(PhotonFrames, OfInstancesAreTheReferences) { expect_references(GetParam(), Theme::instances); }

TEST_P(PhotonFrames, InMediaAreTheReferences) { expect_references(GetParam(), Theme::media); }

INSTANTIATE_TEST_SUITE_P(Seeds, PhotonFrames, testing::Range(0U, 5U));

} // namespace
} // namespace fastrt::test
