// SPDX-License-Identifier: Apache-2.0
// The scene that an NFF file describes, statement by statement.
#pragma once

#include "src/load/polygon.hpp"
#include "src/load/triangle_fault.hpp"

#include <fastrt/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace fastrt {

// The numbers of an `f` statement.
struct NffFill {
  Vec3 color{1.0F};
  float diffuse = 0.8F, specular = 0, shine = 1, transmittance = 0, ior = 1;
};

// What the renderer makes of it (docs/nff.md).
Material nff_material(const NffFill& fill);

class NffScene {
public:
  // What follows has this fill, and is one object.
  void set_fill(const NffFill& fill);
  bool has_fill() const { return !desc_.object_names.empty(); }
  void set_background(const Vec3& color) { desc_.background = color; }
  void set_view(const Camera& camera, int width, int height);
  void add_light(const Vec3& position) { dim_lights_.push_back(desc_.lights.size()), push_light(position); }
  void add_light(const Vec3& position, const Vec3& color);
  // False, and nothing added, for what has no size.
  bool add_sphere(const Vec3& center, float radius);
  bool add_cone(const Vec3& base, float base_radius, const Vec3& apex, float apex_radius);
  // At least three vertices. normals: one each, or none at all; with them the polygon is a patch.
  // too_long: not flat, and of more than max_face_corners.
  enum class Found { good, bent, empty, too_long };
  Found add_polygon(std::span<const Vec3> vertices);
  Found add_patch(std::span<const Vec3> vertices, std::span<const Vec3> normals);
  // Why triangles of the last polygon or patch were left out, one each.
  std::span<const TriangleFault> faults() const { return faults_; }
  // The end of the file.
  SceneDesc finish();

private:
  void push_light(const Vec3& position);
  std::uint32_t push_positions(std::span<const Vec3> vertices);
  void push_triangles(std::span<const Vec3> vertices, std::uint32_t first, std::span<const Vec3> normals);

  SceneDesc desc_;
  std::map<std::array<float, 8>, std::uint32_t> fills_; // the first material of each fill
  std::uint32_t material_ = 0;
  std::vector<std::size_t> dim_lights_; // lights without an intensity of their own
  PolygonTriangulator triangulator_;
  std::vector<PolygonTriangulator::Triangle> triangles_;
  std::vector<TriangleFault> faults_;
  bool has_normals_ = false;
};

} // namespace fastrt
