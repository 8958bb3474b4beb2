// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/camera.hpp>
#include <fastrt/column.hpp>
#include <fastrt/light.hpp>
#include <fastrt/material.hpp>
#include <fastrt/math.hpp>
#include <fastrt/picture.hpp>
#include <fastrt/texture.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fastrt {

// An index column's "there is none": a triangle corner without a normal or a texture coordinate.
inline constexpr std::uint32_t no_index = 0xFFFFFFFFU;

// The instance of a hit in none.
inline constexpr std::int32_t no_instance = -1;

// Two or three numbers a row, as columns of one length: points, vectors, texture coordinates or colours.
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

// Spheres around (x, y, z).
struct SphereColumns {
  Column<float> x, y, z, radius; // radius > 0
  Column<std::uint32_t> material, object;
  std::size_t size() const noexcept { return x.size(); }
};

// Cones between two circles, whose middles are `base` and `apex` (not the same point) and whose planes are
// square to the line between them: cylinders where the radii are equal, pointed where one is 0. Radii are
// not negative, and not both 0. capped: 0 for the mantle alone, 1 with a disc at each end.
struct ConeColumns {
  Columns3 base, apex;
  Column<float> base_radius, apex_radius;
  Column<std::uint32_t> capped;
  Column<std::uint32_t> material, object;
  std::size_t size() const noexcept { return base_radius.size(); }
};

// Discs square to a normal.
struct DiskColumns {
  Columns3 center, normal; // the normal may have any length but 0
  Column<float> radius;    // > 0
  Column<std::uint32_t> material, object;
  std::size_t size() const noexcept { return radius.size(); }
};

// Planar polygons of one or more closed contours each, of at least three vertices; what an odd number of
// contours surrounds is inside. vertex: indices of positions, contour after contour. Contour c ends before
// vertex[vertex_end[c]], polygon i before contour contour_end[i].
struct PolygonColumns {
  Column<std::uint32_t> vertex, vertex_end, contour_end;
  Column<std::uint32_t> material, object;
  std::size_t size() const noexcept { return contour_end.size(); }
};

// Infinite planes through a point. The normal may have any length but 0.
struct PlaneColumns {
  Columns3 point, normal;
  Column<std::uint32_t> material, object;
  std::size_t size() const noexcept { return point.size(); }
};

// Primitives that are in the scene only where instances show them: rows begin[kind] .. end[kind] - 1 of the
// columns of each kind, in the order of PrimitiveKind. Prototypes share no primitive, and planes are in none.
// What a prototype's primitives call world space is its object space.
struct Prototype {
  std::array<std::uint32_t, 5> begin{}, end{};
};

// Places where the scene shows a prototype. material and object: those of everything that the instance
// shows, or no_index where the primitives keep their own.
struct InstanceColumns {
  Column<std::uint32_t> prototype; // index of SceneDesc::prototypes
  Column<Affine> to_world;         // from object space; any map that can be inverted, mirrors too
  Column<std::uint32_t> material, object;
  std::size_t size() const noexcept { return prototype.size(); }
};

// A scene while it is being put together: what readers and SceneBuilder fill, and Scene freezes. In world
// space, any unit of length, but for what is in prototypes. The material and object columns of primitives
// hold one index each.
struct SceneDesc {
  Columns3 positions, normals; // normals of any length
  Columns2 uvs;                // (0, 0) is an image's lower left corner
  Columns3 colors;             // linear RGB of each position, or empty
  TriangleColumns triangles;
  SphereColumns spheres;
  ConeColumns cones;
  DiskColumns disks;
  PolygonColumns polygons;
  PlaneColumns planes;
  std::vector<Prototype> prototypes;
  InstanceColumns instances;
  std::vector<Material> materials;       // the primitives' material columns index these
  std::vector<Texture> textures;         // materials index these
  std::vector<std::string> object_names; // the primitives' object columns index these
  std::vector<Light> lights;
  std::optional<Vec3> ambient;    // Ia; 0 where not given
  std::optional<Vec3> background; // what a ray that hits nothing sees; black where not given

  // What a scene file says of the picture to be made of it; Scene itself does not look at it.
  std::optional<Camera> camera;
  // The file leaves open where the camera is, or what an orthographic one shows: this was chosen to show the
  // whole scene in a picture of the file's size (4 to 3 without one), and is to be chosen anew for another.
  bool camera_place_is_chosen = false, camera_height_is_chosen = false;
  int width = 0, height = 0; // pixels; 0 where the file does not say
  PictureSettings picture;
};

// The kinds of primitive, in the order in which they share the primitive ids.
enum class PrimitiveKind : std::uint32_t { triangle, sphere, cone, disk, polygon, plane };
inline constexpr std::size_t primitive_kinds = 6;

struct SceneShapes; // of the library alone, as LightMeshes
struct LightMeshes;

// An immutable scene. Primitive ids run from 0: first all triangles, then all spheres and so on in the order
// of PrimitiveKind, each in the order given; those of prototypes too.
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

  std::uint32_t triangle_count() const noexcept { return count_of(PrimitiveKind::triangle); }
  std::uint32_t sphere_count() const noexcept { return count_of(PrimitiveKind::sphere); }
  std::uint32_t primitive_count() const noexcept { return first_[primitive_kinds]; }
  std::uint32_t count_of(PrimitiveKind kind) const noexcept {
    return first_[static_cast<std::size_t>(kind) + 1] - first_[static_cast<std::size_t>(kind)];
  }
  // The id of the first primitive of a kind, whether or not there is one.
  std::uint32_t first_of(PrimitiveKind kind) const noexcept { return first_[static_cast<std::size_t>(kind)]; }
  PrimitiveKind kind(std::uint32_t primitive) const noexcept {
    std::size_t kind = 0;
    while (kind + 1 < primitive_kinds && primitive >= first_[kind + 1]) ++kind;
    return static_cast<PrimitiveKind>(kind);
  }
  std::uint32_t instance_count() const noexcept { return static_cast<std::uint32_t>(desc_.instances.size()); }
  // Of a primitive, or of what an instance makes of it.
  std::uint32_t material_of(std::uint32_t primitive, std::int32_t instance = no_instance) const noexcept;
  std::uint32_t object_of(std::uint32_t primitive, std::int32_t instance = no_instance) const noexcept;

  // The scene's ambient light and that of its lights.
  Vec3 ambient() const noexcept;
  // What a ray that hits nothing sees; black where the scene does not say.
  Vec3 background() const noexcept { return desc_.background.value_or(Vec3(0.0F)); }
  // The box around all instances and all primitives but planes and those of prototypes; empty if there are
  // none.
  const Aabb& bounds() const noexcept { return bounds_; }
  // Whether some material lets light through, so that shadows have colours.
  bool has_transmission() const noexcept { return has_transmission_; }
  // Bytes held by the columns.
  std::size_t bytes() const noexcept;

  // Of the library alone.
  const SceneShapes& shapes() const noexcept { return *shapes_; }
  const LightMeshes& light_meshes() const noexcept { return *light_meshes_; }

private:
  SceneDesc desc_;
  std::array<std::uint32_t, primitive_kinds + 1> first_{}; // ids
  std::shared_ptr<const SceneShapes> shapes_;
  std::shared_ptr<const LightMeshes> light_meshes_;
  Aabb bounds_;
  bool has_transmission_ = false;
};

// Makes a scene in a program, without a file. Ids are counted from 0 in the order of the calls, which return
// them: of primitives that of their object. build() checks the numbers. Throws LimitError where ids run out.
class SceneBuilder {
public:
  std::uint32_t add_material(Material material);
  std::uint32_t add_texture(Texture texture);
  // A mesh of its own object. positions: one per vertex; indices: three per triangle, into positions;
  // normals, uvs and colors: empty or one per vertex. Returns the object id. Throws InputError for an index
  // out of range and for counts that don't fit.
  std::uint32_t add_mesh(std::span<const Vec3> positions, std::span<const std::uint32_t> indices,
                         std::uint32_t material, std::span<const Vec3> normals = {}, std::string name = {},
                         std::span<const Vec2> uvs = {}, std::span<const Vec3> colors = {});
  std::uint32_t add_sphere(const Vec3& center, float radius, std::uint32_t material, std::string name = {});
  // Radii at least 0. capped: with a disc at each end, else the mantle alone.
  std::uint32_t add_cone(const Vec3& base, float base_radius, const Vec3& apex, float apex_radius,
                         std::uint32_t material, bool capped = true, std::string name = {});
  std::uint32_t add_cylinder(const Vec3& base, const Vec3& apex, float radius, std::uint32_t material,
                             bool capped = true, std::string name = {});
  std::uint32_t add_disk(const Vec3& center, const Vec3& normal, float radius, std::uint32_t material,
                         std::string name = {});
  // A planar polygon of one contour or more; what an odd number of them surrounds is inside, so that a
  // contour within another is a hole.
  std::uint32_t add_polygon(std::span<const std::vector<Vec3>> contours, std::uint32_t material,
                            std::string name = {});
  std::uint32_t add_plane(const Vec3& point, const Vec3& normal, std::uint32_t material,
                          std::string name = {});
  // Whatever is added between these two is part of a prototype, seen only where instances show it. end
  // returns the prototype's number. Throws InputError for a prototype or a plane within a prototype, and for
  // an end without a beginning.
  void begin_prototype();
  std::uint32_t end_prototype();
  // Shows a prototype as an object of its own. material: of all of it; no_index leaves each primitive its
  // own. Throws InputError within a prototype.
  std::uint32_t add_instance(std::uint32_t prototype, const Affine& to_world,
                             std::uint32_t material = no_index, std::string name = {});
  void add_light(const Light& light) { desc_.lights.push_back(light); }
  void set_ambient(const Vec3& ambient) { desc_.ambient = ambient; }
  void set_background(const Vec3& background) { desc_.background = background; }
  // Leaves the builder empty. Throws as Scene's constructor does.
  Scene build();

private:
  std::uint32_t add_object(std::string name);

  SceneDesc desc_;
  std::optional<Prototype> open_; // the prototype that is being put together
};

} // namespace fastrt
