// SPDX-License-Identifier: Apache-2.0
#include "src/accel/parallel.hpp"
#include "src/trace/tracer_parts.hpp"

#include <limits>

namespace fastrt {
namespace {

constexpr std::size_t blocks_per_task = std::size_t{1} << 12U;
constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

void fill_row(const Scene& scene, std::int32_t id, int i, TriangleBlock& block) {
  block.primitive[i] = id;
  if (id < 0) {
    for (int v = 0; v < 3; ++v) block.x[v][i] = block.y[v][i] = block.z[v][i] = nothing;
    return;
  }
  const TriangleColumns& triangles = scene.triangles();
  const auto row = static_cast<std::size_t>(id);
  const std::uint32_t corners[3] = {triangles.v0[row], triangles.v1[row], triangles.v2[row]};
  for (int v = 0; v < 3; ++v) {
    block.x[v][i] = scene.positions().x[corners[v]];
    block.y[v][i] = scene.positions().y[corners[v]];
    block.z[v][i] = scene.positions().z[corners[v]];
  }
}

} // namespace

Column<TriangleBlock> triangle_blocks(const Scene& scene, const Column<std::int32_t>& slots) {
  Column<TriangleBlock> blocks(slots.size() / block_size);
  for_each_piece(blocks.size(), blocks_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      for (int i = 0; i < block_size; ++i)
        fill_row(scene, slots[b * block_size + static_cast<std::size_t>(i)], i, blocks[b]);
  });
  return blocks;
}

Column<SphereBlock> sphere_blocks(const Scene& scene, const Column<std::int32_t>& slots) {
  Column<SphereBlock> blocks(slots.size() / block_size);
  const SphereColumns& spheres = scene.spheres();
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    SphereBlock& block = blocks[slot / block_size];
    const std::size_t i = slot % block_size;
    block.primitive[i] = slots[slot];
    if (slots[slot] < 0) {
      block.x[i] = block.y[i] = block.z[i] = block.radius[i] = nothing;
      continue;
    }
    const std::size_t row = static_cast<std::uint32_t>(slots[slot]) - scene.triangle_count();
    block.x[i] = spheres.x[row];
    block.y[i] = spheres.y[row];
    block.z[i] = spheres.z[row];
    block.radius[i] = spheres.radius[row];
  }
  return blocks;
}

} // namespace fastrt
