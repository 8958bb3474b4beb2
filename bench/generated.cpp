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

// A sphere with six children around its equator and three on top, turned so that `axis` is up.
void add_balls(SceneDesc& desc, const Vec3& center, float radius, const Vec3& axis, int levels) {
  add_sphere(desc, center, radius);
  if (levels == 0) return;
  const Vec3 other = std::fabs(axis.x) < 0.5F ? Vec3(1.0F, 0.0F, 0.0F) : Vec3(0.0F, 1.0F, 0.0F);
  const Vec3 side = glm::normalize(glm::cross(axis, other)), front = glm::cross(axis, side);
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

// Hills from a few waves; no random numbers, so it is the same everywhere.
float terrain_height(float x, float z) {
  float height = 0, size = 0.25F;
  for (float frequency = 3.0F; frequency < 400.0F; frequency *= 2.1F, size *= 0.47F)
    height += size * std::sin(frequency * x + 1.3F * frequency) *
              std::cos(frequency * 0.9F * z + 0.7F * std::sin(2.0F * frequency * x));
  return height;
}

} // namespace

SceneDesc balls_scene(int levels) {
  SceneDesc desc;
  add_plain_material(desc);
  for (const Vec3& corner : {Vec3(-6.0F, -0.5F, -6.0F), Vec3(6.0F, -0.5F, -6.0F), Vec3(6.0F, -0.5F, 6.0F),
                             Vec3(-6.0F, -0.5F, 6.0F)})
    desc.positions.push_back(0.4F * corner);
  add_triangle(desc, 0, 2, 1);
  add_triangle(desc, 0, 3, 2);
  add_balls(desc, Vec3(0.0F, 0.3F, 0.0F), 0.5F, Vec3(0.0F, 1.0F, 0.0F), levels);
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
  throw UsageError("'" + name + "' is neither a file nor a generated scene (balls, terrain)");
}

std::vector<std::string> generated_scene_names() { return {"balls", "terrain"}; }

} // namespace fastrt::bench
