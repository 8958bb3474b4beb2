// SPDX-License-Identifier: Apache-2.0
#include "src/accel/parallel.hpp"
#include "src/scene/threads.hpp"
#include "src/trace/point_media.hpp"

#include <chrono>
#include <utility>

namespace fastrt {
namespace {

const KernelTable* table_of(Isa isa) noexcept {
  switch (isa) {
  case Isa::sse42:
    return &sse42::kernel_table();
  case Isa::avx2:
    return &avx2::kernel_table();
  case Isa::avx512:
    return &avx512::kernel_table();
  case Isa::scalar:
    break;
  }
  return nullptr;
}

void fill_geometry_view(Tracer::Parts& parts, const WideTree& tree, bool culling) {
  GeometryView& view = parts.view.geometry;
  view.nodes = parts.nodes.data();
  view.triangles = parts.triangle_blocks.data();
  view.spheres = parts.sphere_blocks.data();
  view.has_triangles = parts.triangle_blocks.empty() ? 0 : 1;
  view.only_triangles = parts.sphere_blocks.empty() && parts.shape_blocks.empty() ? 1 : 0;
  const std::size_t blocks =
      parts.triangle_blocks.size() + parts.sphere_blocks.size() + parts.shape_blocks.size();
  view.few_shapes = parts.shape_blocks.size() * 16 <= blocks ? 1 : 0;
  view.primitive_count = static_cast<std::uint32_t>(blocks) * block_size;
  view.shape_blocks = parts.shape_blocks.data();
  view.shapes = shape_view(parts.scene, parts.shapes);
  view.root = tree.root;
  view.largest_coordinate = largest_magnitude(tree.bounds);
  view.culls = culling;
}

// Boxes so large that no ray misses one.
void remove_bounds(Tracer::Parts& parts) {
  constexpr float far = 1e30F;
  for (WideNode& node : parts.nodes)
    for (int i = 0; i < wide_children && node.child[i] != no_child; ++i) {
      node.lower_x[i] = node.lower_y[i] = node.lower_z[i] = -far;
      node.upper_x[i] = node.upper_y[i] = node.upper_z[i] = far;
    }
  for (ShapeBlock& block : parts.shape_blocks)
    for (int i = 0; i < block_size && block.primitive[i] >= 0; ++i) {
      block.low_x[i] = block.low_y[i] = block.low_z[i] = -far;
      block.high_x[i] = block.high_y[i] = block.high_z[i] = far;
    }
}

void fill_columns(const Scene& scene, ShadingView& view) {
  const SceneDesc& desc = scene.desc();
  view.position_x = desc.positions.x.data();
  view.position_y = desc.positions.y.data();
  view.position_z = desc.positions.z.data();
  view.v0 = desc.triangles.v0.data();
  view.v1 = desc.triangles.v1.data();
  view.v2 = desc.triangles.v2.data();
  if (!desc.triangles.n0.empty()) {
    view.normal_x = desc.normals.x.data();
    view.normal_y = desc.normals.y.data();
    view.normal_z = desc.normals.z.data();
    view.n0 = desc.triangles.n0.data();
    view.n1 = desc.triangles.n1.data();
    view.n2 = desc.triangles.n2.data();
  }
  if (!desc.triangles.t0.empty()) {
    view.uv_x = desc.uvs.x.data();
    view.uv_y = desc.uvs.y.data();
    view.t0 = desc.triangles.t0.data();
    view.t1 = desc.triangles.t1.data();
    view.t2 = desc.triangles.t2.data();
  }
  view.color_x = desc.colors.x.data();
  view.color_y = desc.colors.y.data();
  view.color_z = desc.colors.z.data();
  view.sphere_x = desc.spheres.x.data();
  view.sphere_y = desc.spheres.y.data();
  view.sphere_z = desc.spheres.z.data();
  view.sphere_radius = desc.spheres.radius.data();
  view.triangle_material = desc.triangles.material.data();
  view.sphere_material = desc.spheres.material.data();
  view.triangle_object = desc.triangles.object.data();
  view.sphere_object = desc.spheres.object.data();
  view.triangle_count = scene.triangle_count();
  view.sphere_count = scene.sphere_count();
}

void fill_shading_view(Tracer::Parts& parts) {
  ShadingView& view = parts.view.shading;
  fill_columns(parts.scene, view);
  view.shape_material = parts.shapes.materials.data();
  view.shape_object = parts.shapes.objects.data();
  view.shapes = shape_view(parts.scene, parts.shapes);
  view.materials = parts.materials.data();
  view.lights = parts.lights.data();
  view.light_count = static_cast<std::uint32_t>(parts.lights.size());
  view.has_transmission = parts.scene.has_transmission();
  // Where nothing lets light through no ray is ever inside anything, and rays' media are not kept.
  for (const MaterialRow& row : parts.materials) view.sends_on |= row.has_mirror | row.has_transmit;
  for (const MaterialRow& row : parts.materials) view.has_textures |= row.textures != nullptr ? 1U : 0U;
  for (const MaterialRow& row : parts.materials)
    view.has_absorption |= view.has_transmission != 0 ? row.has_absorption : 0U;
  const Vec3 ambient = parts.scene.ambient(), background = parts.scene.background();
  for (int c = 0; c < 3; ++c) {
    view.ambient[c] = ambient[c];
    view.background[c] = background[c];
  }
}

// Where registers have four lanes, a leaf of eight triangles takes two tests.
int run_size_of(Isa isa) { return isa_width(isa) < 8 ? 4 : 8; }

BvhStats stats_of(const Tracer::Parts& parts, const SceneTrees& trees) {
  BvhStats stats = trees.stats;
  stats.block_count = parts.triangle_blocks.size() + parts.sphere_blocks.size() + parts.shape_blocks.size();
  stats.bytes = stats.node_count * sizeof(WideNode) + parts.triangle_blocks.size() * sizeof(TriangleBlock) +
                parts.sphere_blocks.size() * sizeof(SphereBlock) +
                parts.shape_blocks.size() * sizeof(ShapeBlock) + parts.shapes.bytes();
  return stats;
}

// Trees -> blocks and rows.
SceneTrees build_blocks(Tracer::Parts& parts, const BuildSettings& settings) {
  SceneTrees trees = build_scene_trees(parts.scene, settings);
  const auto& slots = trees.all.slots;
  parts.triangle_blocks = triangle_blocks(parts.scene, slots[triangle_group]);
  parts.sphere_blocks = sphere_blocks(parts.scene, slots[sphere_group]);
  parts.shape_blocks = shape_blocks(parts.scene, slots[shape_group]);
  parts.shapes = shape_rows(parts.scene, trees.prototypes);
  return trees;
}

BuildSettings build_settings(const Tracer::Parts& parts, int threads, BvhQuality quality) {
  const std::size_t boxes = std::size_t{parts.scene.primitive_count()} + parts.scene.instance_count();
  return {boxes < parallel_build_from ? 1 : thread_count(threads), run_size_of(parts.isa), quality};
}

// What the tracer's ISA asks: the kernels' trees, or the scalar one, and then none of the kernels'.
SceneTrees build(Tracer::Parts& parts, const TracerSettings& tracer_settings) {
  const auto start = std::chrono::steady_clock::now();
  place_threads(thread_count(tracer_settings.threads));
  const BuildSettings settings = build_settings(parts, tracer_settings.threads, tracer_settings.quality);
  SceneTrees trees;
  TaskFailure failure;
  run_tasks(settings.threads, failure, [&] {
    if (parts.kernels == nullptr)
      parts.scalar_bvh = std::make_unique<ScalarBvh>(parts.scene, settings);
    else
      trees = build_blocks(parts, settings);
  });
  BvhStats& stats = parts.stats;
  stats = parts.scalar_bvh ? parts.scalar_bvh->stats() : stats_of(parts, trees);
  const std::uint32_t primitives = parts.scene.primitive_count();
  stats.bytes_per_primitive = primitives == 0 ? 0.0 : static_cast<double>(stats.bytes) / primitives;
  stats.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return trees;
}

} // namespace

Tracer::Tracer(Scene scene, const TracerSettings& settings)
    : parts_(std::make_unique<Parts>(std::move(scene))) {
  Parts& parts = *parts_;
  parts.isa = settings.isa;
  if (!isa_available(parts.isa)) parts.isa = select_isa(isa_name(settings.isa)); // throws
  parts.kernels = table_of(parts.isa);
  SceneTrees trees = build(parts, settings);
  parts.nodes = std::move(trees.all.nodes);
  parts.textures = texture_rows(parts.scene);
  parts.materials = material_rows(parts.scene, parts.textures);
  parts.lights = light_rows(parts.scene, parts.emitters);
  if (!settings.culling) remove_bounds(parts);
  fill_geometry_view(parts, trees.all, settings.culling);
  fill_shading_view(parts);
  place_lights_in_media(parts);
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

const Scene& Tracer::scene() const noexcept { return parts_->scene; }
Isa Tracer::isa() const noexcept { return parts_->isa; }
const BvhStats& Tracer::bvh_stats() const noexcept { return parts_->stats; }

} // namespace fastrt
