// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/column.hpp>
#include <fastrt/light.hpp>
#include <fastrt/material.hpp>
#include <fastrt/math.hpp>
#include <fastrt/texture.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fastrt {

// An index column's "there is none": a triangle corner without a normal or a texture coordinate.
inline constexpr std::uint32_t no_index = 0xFFFFFFFFU;

struct Columns2 {
  Column<float> x, y;
  std::size_t size() const noexcept { return x.size(); }
};
struct Columns3 {
  Column<float> x, y, z;
  std::size_t size() const noexcept { return x.size(); }
  void resize(std::size_t size) { x.resize(size), y.resize(size), z.resize(size); }
  void push_back(const Vec3& value) { x.push_back(value.x), y.push_back(value.y), z.push_back(value.z); }
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// Triangles, one row each. v0..v2 index SceneDesc::positions, n0..n2 normals, t0..t2 uvs. The n columns are
// either empty (no triangle has normals) or as long as v0; likewise the t columns. A corner without one holds
// no_index.
struct TriangleColumns {
  Column<std::uint32_t> v0, v1, v2;
  Column<std::uint32_t> n0, n1, n2;
  Column<std::uint32_t> t0, t1, t2;
  Column<std::uint32_t> material, object;
  std::size_t size() const noexcept { return v0.size(); }
};

struct SphereColumns {
  Column<float> x, y, z, radius; // radius > 0
  Column<std::uint32_t> material, object;
  std::size_t size() const noexcept { return x.size(); }
};

// A scene while it is being put together: what readers and SceneBuilder fill, and Scene freezes.
struct SceneDesc {
  Columns3 positions, normals;
  Columns2 uvs;
  Columns3 colors; // linear RGB of each position, or empty
  TriangleColumns triangles;
  SphereColumns spheres;
  std::vector<Material> materials;       // triangles.material and spheres.material index these
  std::vector<Texture> textures;         // materials index these
  std::vector<std::string> object_names; // triangles.object and spheres.object index these
  std::vector<Light> lights;
  Vec3 ambient{0.0F};    // Ia
  Vec3 background{0.0F}; // what a ray that hits nothing sees
};

// The kinds of primitive, in the order in which they share the primitive ids.
enum class PrimitiveKind : std::uint32_t { triangle, sphere };

// An immutable scene. Primitive ids run from 0: first all triangles, then all spheres, each in the order
// given.
class Scene {
public:
  // Checks every index, number, material and light; throws InputError at the first that can't be used and
  // LimitError for more than 2^31 - 1 primitives.
  explicit Scene(SceneDesc desc);

  const SceneDesc& desc() const noexcept { return desc_; }
  const Columns3& positions() const noexcept { return desc_.positions; }
  const Columns3& normals() const noexcept { return desc_.normals; }
  const TriangleColumns& triangles() const noexcept { return desc_.triangles; }
  const SphereColumns& spheres() const noexcept { return desc_.spheres; }
  const std::vector<Material>& materials() const noexcept { return desc_.materials; }
  const std::vector<Texture>& textures() const noexcept { return desc_.textures; }
  const std::vector<Light>& lights() const noexcept { return desc_.lights; }

  std::uint32_t triangle_count() const noexcept { return static_cast<std::uint32_t>(desc_.triangles.size()); }
  std::uint32_t sphere_count() const noexcept { return static_cast<std::uint32_t>(desc_.spheres.size()); }
  std::uint32_t primitive_count() const noexcept { return triangle_count() + sphere_count(); }
  PrimitiveKind kind(std::uint32_t primitive) const noexcept {
    return primitive < triangle_count() ? PrimitiveKind::triangle : PrimitiveKind::sphere;
  }
  std::uint32_t material_of(std::uint32_t primitive) const noexcept;
  std::uint32_t object_of(std::uint32_t primitive) const noexcept;

  // The box around all primitives; empty for an empty scene.
  const Aabb& bounds() const noexcept { return bounds_; }
  // Whether some material lets light through, so that shadows have colours.
  bool has_transmission() const noexcept { return has_transmission_; }
  // Bytes held by the columns.
  std::size_t bytes() const noexcept;

private:
  SceneDesc desc_;
  Aabb bounds_;
  bool has_transmission_ = false;
};

// Makes a scene in a program, without a file. Ids are counted from 0 in the order of the calls.
class SceneBuilder {
public:
  std::uint32_t add_material(Material material);
  std::uint32_t add_texture(Texture texture);
  // A mesh of its own object. positions: one per vertex; indices: three per triangle, into positions;
  // normals, uvs and colors: empty or one per vertex. Returns the object id. Throws InputError for an index
  // out of range or a count that is no multiple of three.
  std::uint32_t add_mesh(std::span<const Vec3> positions, std::span<const std::uint32_t> indices,
                         std::uint32_t material, std::span<const Vec3> normals = {}, std::string name = {},
                         std::span<const Vec2> uvs = {}, std::span<const Vec3> colors = {});
  std::uint32_t add_sphere(const Vec3& center, float radius, std::uint32_t material, std::string name = {});
  void add_light(const Light& light) { desc_.lights.push_back(light); }
  void set_ambient(const Vec3& ambient) { desc_.ambient = ambient; }
  void set_background(const Vec3& background) { desc_.background = background; }
  // Leaves the builder empty. Throws as Scene's constructor does.
  Scene build();

private:
  SceneDesc desc_;
};

} // namespace fastrt
