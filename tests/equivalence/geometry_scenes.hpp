// SPDX-License-Identifier: Apache-2.0
// Scenes to shoot rays at: each small enough for brute force, and each with something that a tree, a box test
// or a frustum could get wrong.
#pragma once

#include "tests/equivalence/pairs.hpp"
#include "tests/unit/instance_scenes.hpp"

#include <fastrt/scene.hpp>

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace fastrt::test {

struct NamedScene {
  std::string name;
  Scene scene;
};
struct SceneName {
  std::string operator()(const testing::TestParamInfo<NamedScene>& info) const { return info.param.name; }
};
inline void PrintTo(const NamedScene& scene, std::ostream* out) { *out << scene.name; }

inline Scene scene_of(const Mesh& mesh) {
  SceneBuilder builder;
  add(builder, mesh, builder.add_material({}));
  return builder.build();
}

// Sizes from e^low to e^high.
inline Mesh mixed_soup(std::uint32_t count, float low, float high, Random& random) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 center = random.in_cube();
    const float size = any_size(random, low, high);
    for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(center + size * random.in_cube());
    mesh.add_triangle(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

inline Mesh slivers(std::uint32_t count, Random& random) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 from = random.in_cube();
    const Vec3 to = from + 3.0F * random.in_cube();
    mesh.positions.insert(mesh.positions.end(),
                          {from, to, to + any_size(random, -9, -4) * random.direction()});
    mesh.add_triangle(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

inline Mesh repeated(const Mesh& mesh, int times) {
  Mesh result = mesh;
  for (int i = 1; i < times; ++i)
    result.indices.insert(result.indices.end(), mesh.indices.begin(), mesh.indices.end());
  return result;
}

// Points, lines, needles and numbers from 1e-6 to 1e6: what careless exporters write.
inline Mesh garbage(std::uint32_t count, Random& random) {
  Mesh mesh = mixed_soup(count, -14, 14, random);
  for (std::uint32_t i = 0; i < count; i += 3) mesh.indices[3 * i + 1] = mesh.indices[3 * i];
  for (std::uint32_t i = 1; i < count; i += 9) mesh.indices[3 * i + 2] = 3 * random.below(count);
  return mesh;
}

// A box to be inside of, its walls two triangles each, with something small in the middle.
inline Mesh room(Random& random) {
  Mesh mesh = placed(jittered(icosphere(1), 0.05F, random), 0.1F, {0.1F, -0.2F, 0});
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < 8; ++i)
    mesh.positions.emplace_back((i & 1U) != 0 ? 2.0F : -2.0F, (i & 2U) != 0 ? 1.5F : -1.5F,
                                (i & 4U) != 0 ? 3.0F : -3.0F);
  constexpr std::uint32_t walls[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 2, 6, 4},
                                         {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}};
  for (const auto& wall : walls) {
    mesh.add_triangle(base + wall[0], base + wall[1], base + wall[2]);
    mesh.add_triangle(base + wall[0], base + wall[2], base + wall[3]);
  }
  return mesh;
}

// Spheres of all sizes, some within others, two of them twice.
inline void add_spheres(SceneBuilder& builder, std::uint32_t material, int count, Random& random) {
  for (int i = 0; i < count; ++i) builder.add_sphere(random.in_cube(), any_size(random, -7, -1), material);
  for (const float radius : {0.5F, 0.5F, 0.25F, 0.25F, 1.5F})
    builder.add_sphere({0.1F, 0, 0}, radius, material);
}

inline Scene mixed_scene(Random& random) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  add(builder, mixed_soup(150, -4, 0, random), material);
  add_spheres(builder, material, 60, random);
  return builder.build();
}

inline Scene spheres_scene(Random& random) {
  SceneBuilder builder;
  add_spheres(builder, builder.add_material({}), 200, random);
  return builder.build();
}

inline Scene one_sphere() {
  SceneBuilder builder;
  builder.add_sphere({1, 2, 3}, 0.7F, builder.add_material({}));
  return builder.build();
}

// Each kind by itself, many of them, and all kinds together.
inline Scene shapes_scene(int count, float scale, const Vec3& offset, int planes, bool others,
                          Random& random) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  if (others) {
    add(builder, mixed_soup(60, -4, 0, random), material);
    add_spheres(builder, material, 20, random);
  }
  for (int i = 0; i < count; ++i)
    add_any_shape(builder, material, offset + scale * random.in_cube(),
                  scale * any_size(random, count == 1 ? -1.0F : -4.0F, 0), random);
  for (int i = 0; i < planes; ++i) add_any_plane(builder, material, random);
  return builder.build();
}

// The numbers in which cones are awkward: pointed, flat, needle-like, along an axis.
inline Scene odd_cones_scene(Random& random) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  for (int i = 0; i < 60; ++i) {
    const Vec3 center = random.in_cube();
    const Vec3 axis = any_size(random, -8, 2) * (i % 3 == 0 ? axis_direction(random) : random.direction());
    const float r0 = any_size(random, -8, 1);
    const float r1 = i % 4 == 0 ? 0.0F : i % 4 == 1 ? r0 : any_size(random, -8, 1);
    builder.add_cone(center - axis, r0, center + axis, r1, material, i % 2 == 0);
  }
  return builder.build();
}

inline Scene one_cone() {
  SceneBuilder builder;
  builder.add_cone({0.1F, -0.7F, 0.2F}, 0.8F, {0.3F, 0.9F, -0.1F}, 0.3F, builder.add_material({}));
  return builder.build();
}

// Instances of every kind of prototype, small ones within large ones; size: of the scene.
inline Scene instances_scene(int count, float size, const Vec3& offset, float stretch, Random& random) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  for (std::uint32_t kind = 0; kind < 6; ++kind) add_prototype(builder, kind, material, random);
  add(builder, placed(mixed_soup(30, -4, 0, random), size, offset), material);
  for (int i = 0; i < count; ++i)
    builder.add_instance(random.below(6), any_map(offset + size * random.in_cube(),
                                                  size * any_size(random, -4, 0), stretch, random));
  builder.add_sphere(offset, 0.2F * size, material);
  return builder.build();
}

// The same thing again and again in the same place: as it is, twice as instances, and once more by its
// neighbours' faces. Boxes of whole numbers, side by side.
inline Scene coinciding_instances() {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  const Mesh box = placed(icosphere(0), 1, {0, 0, 0});
  builder.begin_prototype();
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<std::uint32_t> faces{0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                         1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
  builder.add_mesh(corners, faces, material);
  const std::uint32_t cube = builder.end_prototype();
  builder.begin_prototype();
  add(builder, box, material);
  builder.add_sphere({0, 0, 0}, 0.9F, material);
  const std::uint32_t ball = builder.end_prototype();
  for (int i = 0; i < 8; ++i)
    builder.add_instance(cube, scaled(Vec3(1.0F), {static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                                                   static_cast<float>(i >> 2)}));
  for (int i = 0; i < 3; ++i) builder.add_instance(ball, {});
  builder.add_instance(cube, {});
  add(builder, box, material);
  builder.add_mesh(corners, faces, material);
  builder.add_sphere({0, 0, 0}, 0.9F, material);
  return builder.build();
}

inline Scene flat_instances() {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  builder.begin_prototype();
  add(builder, grid(2, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), material);
  const std::uint32_t tile = builder.end_prototype();
  for (int i = 0; i < 16; ++i)
    builder.add_instance(tile, scaled({1, 1, 1}, {static_cast<float>(i % 4), static_cast<float>(i / 4), 0}));
  builder.add_plane({0, 0, 0}, {0, 0, 1}, material);
  return builder.build();
}

inline std::vector<NamedScene> geometry_scenes() {
  Random random(77);
  std::vector<NamedScene> scenes;
  const auto add_mesh = [&](const char* name, const Mesh& mesh) { scenes.push_back({name, scene_of(mesh)}); };
  scenes.push_back({"empty", SceneBuilder().build()});
  add_mesh("one_triangle", soup(1, 1, random));
  scenes.push_back({"one_sphere", one_sphere()});
  add_mesh("few", soup(5, 1, random));
  add_mesh("tiny_soup", soup(400, 0.01F, random));
  add_mesh("large_soup", soup(200, 1.5F, random));
  add_mesh("mixed_soup", mixed_soup(300, -8, 1, random));
  add_mesh("flat_grid", grid(12, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}));
  add_mesh("tilted_grid", grid(12, {-0.5F, -0.6F, 0.1F}, {1.3F, 0.4F, -0.7F}, {-0.3F, 1.1F, 0.9F}));
  add_mesh("closed", jittered(icosphere(2), 0.05F, random));
  add_mesh("closed_far_away", placed(jittered(icosphere(2), 0.05F, random), 1, {1e4F, -2e4F, 5e3F}));
  add_mesh("closed_small", placed(jittered(icosphere(2), 0.05F, random), 1e-3F, {0, 0, 1e-2F}));
  add_mesh("closed_large", placed(jittered(icosphere(2), 0.05F, random), 1e4F, {3e3F, 0, 0}));
  add_mesh("thousand_times_one", repeated(soup(1, 1, random), 1000));
  add_mesh("everything_thrice", repeated(jittered(icosphere(1), 0.1F, random), 3));
  add_mesh("slivers", slivers(200, random));
  add_mesh("garbage", garbage(240, random));
  add_mesh("room", room(random));
  scenes.push_back({"spheres", spheres_scene(random)});
  scenes.push_back({"mixed", mixed_scene(random)});
  scenes.push_back({"one_cone", one_cone()});
  scenes.push_back({"one_plane", shapes_scene(0, 1, {}, 1, false, random)});
  scenes.push_back({"shapes", shapes_scene(150, 1, {}, 0, false, random)});
  scenes.push_back({"shapes_far_away", shapes_scene(60, 1, {1e3F, -2e3F, 5e2F}, 0, false, random)});
  scenes.push_back({"shapes_large", shapes_scene(60, 1e4F, {3e3F, 0, 0}, 0, false, random)});
  scenes.push_back({"odd_cones", odd_cones_scene(random)});
  scenes.push_back({"every_kind", shapes_scene(60, 1, {}, 3, true, random)});
  scenes.push_back({"one_instance", instances_scene(1, 1, {}, 0.5F, random)});
  scenes.push_back({"instances", instances_scene(40, 1, {}, 1, random)});
  scenes.push_back({"instances_stretched", instances_scene(20, 1, {}, 3, random)});
  scenes.push_back({"instances_far_away", instances_scene(20, 1, {1e3F, -2e3F, 5e2F}, 1, random)});
  scenes.push_back({"instances_small", instances_scene(20, 1e-3F, {0, 0, 1e-2F}, 1, random)});
  scenes.push_back({"instances_large", instances_scene(20, 1e4F, {3e3F, 0, 0}, 1, random)});
  scenes.push_back({"instances_coinciding", coinciding_instances()});
  scenes.push_back({"instances_flat", flat_instances()});
  return scenes;
}

} // namespace fastrt::test
