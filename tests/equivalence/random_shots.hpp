// SPDX-License-Identifier: Apache-2.0
// Pictures at random: any materials on any shapes under any lights.
#pragma once

#include "tests/equivalence/frames.hpp"
#include "tests/unit/shape_scenes.hpp"

#include <utility>

namespace fastrt::test {

inline Vec3 any_colour(Random& random, float most) {
  if (random.below(4) == 0) return Vec3(0.0F);
  const float r = random.uniform(0, most);
  const float g = random.uniform(0, most);
  return {r, g, random.below(5) == 0 ? 0.0F : random.uniform(0, most)};
}

inline Material any_material(Random& random) {
  Material m;
  m.ambient = any_colour(random, 1);
  m.diffuse = any_colour(random, 1);
  m.specular = any_colour(random, 1);
  if (random.below(4) == 0) m.emission = any_colour(random, 0.5F);
  m.shininess = std::exp(random.uniform(0, 7));
  m.specular_model = random.below(2) == 0 ? SpecularModel::phong : SpecularModel::blinn;
  m.mirror = random.below(2) == 0 ? Vec3(0.0F) : any_colour(random, 0.9F);
  m.fresnel = static_cast<Fresnel>(random.below(3));
  if (random.below(2) == 0) m.opacity = random.uniform();
  if (random.below(8) == 0) m.opacity = 0;
  m.transmission = any_colour(random, 1);
  m.ior = random.below(3) == 0 ? 1.0F : random.uniform(0.6F, 2.5F);
  if (random.below(3) == 0) m.absorption = any_colour(random, 2);
  m.thin = random.below(4) == 0;
  m.unlit = random.below(8) == 0;
  return m;
}

inline Light any_light(Random& random) {
  Light light;
  light.kind = random.below(3) == 0 ? LightKind::directional : LightKind::point;
  light.position = random.uniform(1, 8) * random.direction();
  light.direction = std::exp(random.uniform(-3, 3)) * random.direction();
  if (random.below(6) == 0) light.direction = {0, -1, 0};
  light.intensity = any_colour(random, 1.5F);
  light.casts_shadows = random.below(4) != 0;
  return light;
}

// A ball of triangles, with the sphere's own normals or without.
inline void add_ball(SceneBuilder& builder, std::uint32_t material, Random& random) {
  const Vec3 center = 1.5F * random.in_cube();
  const float radius = random.uniform(0.3F, 1.2F);
  const Mesh ball = icosphere(static_cast<int>(random.below(2)));
  const Mesh mesh = placed(jittered(ball, 0.05F, random), radius, center);
  if (random.below(2) == 0)
    builder.add_mesh(mesh.positions, mesh.indices, material, ball.positions);
  else
    builder.add_mesh(mesh.positions, mesh.indices, material);
}

inline void add_plane(SceneBuilder& builder, std::uint32_t material, Random& random) {
  const Vec3 right = random.uniform(1, 5) * random.direction();
  const Vec3 up = random.uniform(1, 5) * random.direction();
  add(builder, grid(1 + random.below(3), 2.0F * random.in_cube() - 0.5F * (right + up), right, up), material);
}

inline Scene any_scene(Random& random) {
  SceneBuilder builder;
  const std::uint32_t materials = 1 + random.below(6);
  for (std::uint32_t i = 0; i < materials; ++i) builder.add_material(any_material(random));
  for (std::uint32_t i = random.below(4); i != 0; --i) add_ball(builder, random.below(materials), random);
  for (std::uint32_t i = random.below(3); i != 0; --i) add_plane(builder, random.below(materials), random);
  for (std::uint32_t i = random.below(6); i != 0; --i) {
    const Vec3 center = 1.5F * random.in_cube();
    const float radius = random.uniform(0.1F, 1.2F);
    builder.add_sphere(center, radius, random.below(materials));
    // One within the other, of whatever it may be.
    if (random.below(3) == 0) builder.add_sphere(center, 0.7F * radius, random.below(materials));
  }
  if (random.below(2) == 0) {
    for (std::uint32_t i = random.below(8); i != 0; --i)
      add_any_shape(builder, random.below(materials), 1.5F * random.in_cube(), random.uniform(0.2F, 1.2F),
                    random);
    if (random.below(3) == 0) add_any_plane(builder, random.below(materials), random);
  }
  for (std::uint32_t i = random.below(4); i != 0; --i) builder.add_light(any_light(random));
  builder.set_ambient(any_colour(random, 0.5F));
  builder.set_background(any_colour(random, 1));
  return builder.build();
}

// The same, but here and there a corner has no normal, or no place in the texture: a triangle is smooth where
// all three corners have one, likewise textured.
inline Scene with_gaps(const Scene& scene, Random& random) {
  SceneDesc desc = scene.desc();
  TriangleColumns& rows = desc.triangles;
  for (auto* corners : {&rows.n0, &rows.n1, &rows.n2, &rows.t0, &rows.t1, &rows.t2})
    for (std::uint32_t& corner : *corners)
      if (random.below(6) == 0) corner = no_index;
  return Scene(std::move(desc));
}

// Any of what cameras and sampling offer; drawn last, so that the scenes stay as they are.
inline void any_view(Random& random, Camera& camera, RenderSettings& settings) {
  if (random.below(4) == 0) {
    camera.projection = Projection::orthographic;
    camera.view_height = random.uniform(0.5F, 6);
  } else if (random.below(3) == 0) {
    camera.aperture_radius = random.uniform(0.01F, 0.5F);
    if (random.below(2) == 0) camera.focus_distance = random.uniform(1, 8);
  }
  if (random.below(4) == 0) {
    camera.window = Window{random.uniform(-1, -0.1F), random.uniform(0.1F, 1), random.uniform(-1, -0.1F),
                           random.uniform(0.1F, 1)};
    camera.focal_distance = random.uniform(0.5F, 3);
  }
  if (random.below(3) == 0) settings.filter = static_cast<PixelFilter>(random.below(4));
  if (random.below(3) == 0) {
    settings.adaptive = random.uniform(0.001F, 0.2F);
    settings.most_samples = settings.samples_per_pixel + static_cast<int>(random.below(9));
  }
  if (random.below(4) == 0) {
    const int x = static_cast<int>(random.below(static_cast<std::uint32_t>(settings.width)));
    const int y = static_cast<int>(random.below(static_cast<std::uint32_t>(settings.height)));
    settings.crop = Crop{x, y, settings.width, (y + settings.height + 1) / 2};
  }
}

inline Shot any_shot(std::uint32_t seed) {
  Random random(seed);
  Shot shot{"seed " + std::to_string(seed), any_scene(random), {}, {}};
  const float distance = random.below(4) == 0 ? 0.5F : random.uniform(2, 8);
  shot.camera = looking(distance * random.direction(), 0.5F * random.in_cube(), random.uniform(20, 100));
  constexpr int sizes[][2] = {{1, 1}, {17, 33}, {31, 16}, {48, 37}, {16, 5}, {40, 40}};
  const auto& size = sizes[random.below(6)];
  constexpr int samples[] = {1, 1, 1, 1, 2, 3, 16};
  shot.settings = small_settings(size[0], size[1], samples[random.below(7)]);
  if (shot.settings.samples_per_pixel == 16) shot.settings.width = shot.settings.height = 9;
  shot.settings.filter = random.below(2) == 0 ? PixelFilter::box : PixelFilter::tent;
  shot.settings.seed = random.word();
  shot.settings.max_depth = static_cast<int>(random.below(6));
  shot.settings.min_contribution = random.below(3) == 0 ? 0.0F : random.uniform(0, 0.1F);
  if (seed % 2 == 0)
    for (std::size_t i = 0; i < aov_count; ++i) shot.settings.aovs.push_back(static_cast<Aov>(i));
  if (seed % 3 == 0) any_view(random, shot.camera, shot.settings);
  if (seed % 4 == 1) shot.scene = with_gaps(shot.scene, random);
  return shot;
}

} // namespace fastrt::test
