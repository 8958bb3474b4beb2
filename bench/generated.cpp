// SPDX-License-Identifier: Apache-2.0
#include "bench/generated.hpp"

#include <fastrt/error.hpp>

#include <cmath>
#include <numbers>

namespace fastrt::bench {
namespace {

std::uint32_t add_plain_material(SceneDesc& desc) {
  desc.materials.emplace_back();
  desc.object_names.emplace_back("generated");
  return 0;
}

void add_triangle(SceneDesc& desc, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  desc.triangles.v0.push_back(a);
  desc.triangles.v1.push_back(b);
  desc.triangles.v2.push_back(c);
  desc.triangles.material.push_back(0);
  desc.triangles.object.push_back(0);
}

void add_sphere(SceneDesc& desc, const Vec3& center, float radius) {
  desc.spheres.x.push_back(center.x);
  desc.spheres.y.push_back(center.y);
  desc.spheres.z.push_back(center.z);
  desc.spheres.radius.push_back(radius);
  desc.spheres.material.push_back(0);
  desc.spheres.object.push_back(0);
}

// Two unit vectors that make a right-handed frame with `axis`.
struct Sides {
  Vec3 side, front;
};
Sides sides_of(const Vec3& axis) {
  const Vec3 other = std::fabs(axis.x) < 0.5F ? Vec3(1.0F, 0.0F, 0.0F) : Vec3(0.0F, 1.0F, 0.0F);
  const Vec3 side = glm::normalize(glm::cross(axis, other));
  return {side, glm::cross(axis, side)};
}

// A sphere with six children around its equator and three on top, turned so that `axis` is up.
void add_balls(SceneDesc& desc, const Vec3& center, float radius, const Vec3& axis, int levels) {
  add_sphere(desc, center, radius);
  if (levels == 0) return;
  const auto [side, front] = sides_of(axis);
  const float child = radius / 3.0F, reach = radius + child;
  for (int i = 0; i < 9; ++i) {
    const bool on_top = i >= 6;
    const float turn = static_cast<float>(i) * (on_top ? 2.0F / 3.0F : 1.0F / 3.0F) + (on_top ? 0.5F : 0.0F);
    const float angle = turn * std::numbers::pi_v<float>, height = on_top ? 0.816F : 0.0F;
    const float out = std::sqrt(1.0F - height * height);
    const Vec3 direction = out * (std::cos(angle) * side + std::sin(angle) * front) + height * axis;
    add_balls(desc, center + reach * direction, child, direction, levels - 1);
  }
}

// A tapered prism of eight sides with a ball at its end, then two thinner branches.
void add_branch(SceneDesc& desc, const Vec3& foot, const Vec3& axis, float length, float radius, int levels) {
  constexpr std::uint32_t corners = 8;
  const auto [side, front] = sides_of(axis);
  const Vec3 end = foot + length * axis;
  const float end_radius = 0.7F * radius;
  const auto first = static_cast<std::uint32_t>(desc.positions.size());
  for (std::uint32_t i = 0; i < corners; ++i) {
    const float angle = static_cast<float>(i) * (2.0F / corners) * std::numbers::pi_v<float>;
    const Vec3 out = std::cos(angle) * side + std::sin(angle) * front;
    desc.positions.push_back(foot + radius * out);
    desc.positions.push_back(end + end_radius * out);
  }
  for (std::uint32_t i = 0; i < corners; ++i) {
    const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % corners);
    add_triangle(desc, a, b, a + 1);
    add_triangle(desc, a + 1, b, b + 1);
  }
  add_sphere(desc, end, levels == 0 ? 2.5F * radius : end_radius);
  if (levels == 0) return;
  const float turn = 2.4F * static_cast<float>(levels); // radians, so that branches spread to all sides
  const Vec3 across = std::cos(turn) * side + std::sin(turn) * front;
  add_branch(desc, end, glm::normalize(axis + 0.6F * across), 0.8F * length, end_radius, levels - 1);
  add_branch(desc, end, glm::normalize(axis - 0.5F * across), 0.75F * length, end_radius, levels - 1);
}

// Hills from a few waves; no random numbers, so it is the same everywhere.
float terrain_height(float x, float z) {
  float height = 0, size = 0.25F;
  for (float frequency = 3.0F; frequency < 400.0F; frequency *= 2.1F, size *= 0.47F)
    height += size * std::sin(frequency * x + 1.3F * frequency) *
              std::cos(frequency * 0.9F * z + 0.7F * std::sin(2.0F * frequency * x));
  return height;
}

// A square floor, two triangles.
void add_floor(SceneDesc& desc, float half_side, float height) {
  const auto first = static_cast<std::uint32_t>(desc.positions.size());
  for (const float x : {-half_side, half_side})
    for (const float z : {-half_side, half_side}) desc.positions.push_back({x, height, z});
  add_triangle(desc, first, first + 1, first + 2);
  add_triangle(desc, first + 2, first + 1, first + 3);
}

} // namespace

SceneDesc balls_scene(int levels) {
  SceneDesc desc;
  add_plain_material(desc);
  add_floor(desc, 1.6F, -0.2F);
  add_balls(desc, Vec3(0.0F, 0.3F, 0.0F), 0.5F, Vec3(0.0F, 1.0F, 0.0F), levels);
  return desc;
}

SceneDesc tree_scene(int levels) {
  SceneDesc desc;
  add_plain_material(desc);
  add_floor(desc, 6.0F, 0.0F);
  add_branch(desc, Vec3(0.0F), Vec3(0.0F, 1.0F, 0.0F), 1.6F, 0.2F, levels);
  return desc;
}

SceneDesc terrain_scene(int cells) {
  SceneDesc desc;
  add_plain_material(desc);
  const auto row = static_cast<std::uint32_t>(cells) + 1;
  for (int z = 0; z <= cells; ++z)
    for (int x = 0; x <= cells; ++x) {
      const float fx = 2.0F * static_cast<float>(x) / static_cast<float>(cells) - 1.0F;
      const float fz = 2.0F * static_cast<float>(z) / static_cast<float>(cells) - 1.0F;
      desc.positions.push_back({fx, terrain_height(fx, fz), fz});
    }
  for (std::uint32_t z = 0; z + 1 < row; ++z)
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t at = z * row + x;
      add_triangle(desc, at, at + row, at + 1);
      add_triangle(desc, at + 1, at + row, at + row + 1);
    }
  return desc;
}

SceneDesc generated_scene(const std::string& name) {
  if (name == "balls") return balls_scene();
  if (name == "terrain") return terrain_scene();
  if (name == "tree") return tree_scene();
  throw UsageError("'" + name + "' is neither a file nor a generated scene (balls, terrain, tree)");
}

std::vector<std::string> generated_scene_names() { return {"balls", "terrain", "tree"}; }

} // namespace fastrt::bench
