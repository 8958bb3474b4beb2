// SPDX-License-Identifier: Apache-2.0
// Pictures of instances of anything, with any materials, textures and lights.
#pragma once

#include "tests/equivalence/random_textures.hpp"
#include "tests/unit/instance_scenes.hpp"

namespace fastrt::test {

// Meshes with textures and without, spheres and shapes, each of its own material.
inline std::uint32_t add_any_prototype(SceneBuilder& builder, std::uint32_t materials, Random& random) {
  builder.begin_prototype();
  if (random.below(3) != 0)
    add_textured(builder, placed(icosphere(1), random.uniform(0.4F, 0.9F), 0.3F * random.in_cube()),
                 random.below(materials), random);
  if (random.below(3) == 0) add_ball(builder, random.below(materials), random);
  for (std::uint32_t i = random.below(3); i != 0; --i)
    builder.add_sphere(0.5F * random.in_cube(), random.uniform(0.2F, 0.9F), random.below(materials));
  for (std::uint32_t i = random.below(4); i != 0; --i)
    add_any_shape(builder, random.below(materials), 0.7F * random.in_cube(), random.uniform(0.2F, 0.8F),
                  random);
  return builder.end_prototype();
}

inline Scene any_instances(Random& random) {
  SceneBuilder builder;
  const std::uint32_t textures = 1 + random.below(4), materials = 2 + random.below(4);
  for (std::uint32_t i = 0; i < textures; ++i) builder.add_texture(any_texture(random, i == 0));
  for (std::uint32_t i = 0; i < materials; ++i)
    builder.add_material(random.below(2) == 0 ? any_textured_material(random, textures)
                                              : any_material(random));
  const std::uint32_t prototypes = 1 + random.below(4);
  for (std::uint32_t i = 0; i < prototypes; ++i) add_any_prototype(builder, materials, random);
  for (std::uint32_t i = 1 + random.below(7); i != 0; --i)
    builder.add_instance(random.below(prototypes),
                         any_map(1.5F * random.in_cube(), random.uniform(0.4F, 1.4F), 0.7F, random),
                         random.below(3) == 0 ? random.below(materials) : no_index);
  if (random.below(2) == 0) builder.add_sphere(random.in_cube(), 0.5F, random.below(materials));
  add_textured(builder, grid(2, {-3, -1.5F, -3}, {6, random.uniform(-1, 1), 0}, {0, 0, 6}),
               random.below(materials), random);
  if (random.below(4) == 0) add_any_plane(builder, random.below(materials), random);
  for (std::uint32_t i = 1 + random.below(2); i != 0; --i) builder.add_light(any_light(random));
  if (random.below(4) == 0) {
    Light disk = any_light(random);
    disk.kind = LightKind::disk;
    disk.radius = random.uniform(0.1F, 1);
    builder.add_light(disk);
  }
  builder.set_ambient(any_colour(random, 0.5F));
  builder.set_background(any_colour(random, 1));
  return builder.build();
}

inline Shot instance_shot(std::uint32_t seed) {
  Random random(seed);
  Shot shot{"instances " + std::to_string(seed), any_instances(random), {}, {}};
  const float distance = random.below(5) == 0 ? 0.6F : random.uniform(2.5F, 7);
  shot.camera = looking(distance * random.direction(), 0.5F * random.in_cube(), random.uniform(25, 80));
  shot.settings = small_settings(35, 27, random.below(6) == 0 ? 3 : 1);
  shot.settings.max_depth = static_cast<int>(random.below(5));
  shot.settings.min_contribution = random.below(2) == 0 ? 0.0F : 0.02F;
  shot.settings.light_samples = 2;
  if (seed % 2 == 0)
    for (std::size_t i = 0; i < aov_count; ++i) shot.settings.aovs.push_back(static_cast<Aov>(i));
  if (seed % 3 == 0) any_view(random, shot.camera, shot.settings);
  return shot;
}

} // namespace fastrt::test
