// SPDX-License-Identifier: Apache-2.0
// What a Tracer is made of.
#pragma once

#include "src/accel/tree.hpp"
#include "src/kernels/kernel_table.hpp"
#include "src/trace/scalar_bvh.hpp"
#include "src/trace/scene_trees.hpp"
#include "src/trace/scene_view.hpp"

#include <fastrt/column.hpp>
#include <fastrt/error.hpp>
#include <fastrt/tracer.hpp>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace fastrt {

// A vector into a row of plain data.
inline void copy(const Vec3& from, float (&to)[3]) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

// Kernels reach the numbers of rows by signed places of 32 bits. Throws LimitError for more rows than that
// allows.
template <class Row>
void check_row_count(std::size_t count, const char* what) {
  constexpr std::size_t words = sizeof(Row) / sizeof(float);
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / words;
  if (count > most)
    throw LimitError(std::string("the scene has more than ") + std::to_string(most) + ' ' + what);
}

// The scene's textures as rows, which point into one another and into the scene.
struct TextureRows {
  std::vector<TextureLevel> levels;
  std::vector<TextureRow> rows;           // as Scene::textures()
  std::vector<SurfaceTextures> materials; // as Scene::materials()
};

// What the kernels read of cones, disks, polygons, planes and instances.
struct ShapeRows {
  Column<ConeRow> cones;
  Column<DiskRow> disks;
  Column<PolygonRow> polygons;
  Column<EdgeRow> edges; // of the polygons, and after them of the bands
  Column<BandRow> bands;
  Column<PlaneRow> planes;
  Column<InstanceRow> instances;
  Column<std::uint32_t> materials, objects; // of all but instances, by id
  std::size_t bytes() const noexcept;
};

struct Tracer::Parts {
  Scene scene;
  Isa isa = Isa::scalar;
  Column<WideNode> nodes;
  Column<TriangleBlock> triangle_blocks;
  Column<SphereBlock> sphere_blocks;
  Column<ShapeBlock> shape_blocks;
  ShapeRows shapes;
  std::vector<MaterialRow> materials;
  std::vector<LightRow> lights;
  std::vector<EmitterRow> emitters;
  TextureRows textures;
  SceneView view{};
  BvhStats stats;
  const KernelTable* kernels = nullptr;  // null for Isa::scalar
  std::unique_ptr<ScalarBvh> scalar_bvh; // of Isa::scalar alone

  explicit Parts(Scene s) : scene(std::move(s)) {}
};

// The rows that shading reads, from the scene's materials and lights.
std::vector<MaterialRow> material_rows(const Scene& scene, const TextureRows& textures);
TextureRows texture_rows(const Scene& scene);
// emitters: filled with the triangles of lights that are meshes.
std::vector<LightRow> light_rows(const Scene& scene, std::vector<EmitterRow>& emitters);

ShapeRows shape_rows(const Scene& scene, const std::vector<PrototypeTree>& prototypes);
void add_bands(ShapeRows& rows); // of polygons with many edges
ShapeView shape_view(const Scene& scene, const ShapeRows& rows);

// The leaf blocks in the tree's order. slots: primitive ids, block_size a block, -1 where a block is not
// full. Within run_tasks all threads make those of triangles.
Column<TriangleBlock> triangle_blocks(const Scene& scene, const Column<std::int32_t>& slots);
Column<SphereBlock> sphere_blocks(const Scene& scene, const Column<std::int32_t>& slots);
Column<ShapeBlock> shape_blocks(const Scene& scene, const Column<std::int32_t>& slots);

} // namespace fastrt
