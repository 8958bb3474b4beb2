// SPDX-License-Identifier: Apache-2.0
#include "src/load/obj_colors.hpp"

#include "src/load/srgb.hpp"

#include <algorithm>

namespace fastrt {

void ObjColors::start(std::uint64_t first, std::uint64_t last) {
  Columns3& colors = desc_.colors;
  {
    const std::lock_guard lock(mutex_);
    if (colors.z.empty()) colors.resize(desc_.positions.size());
  }
  for (auto* column : {&colors.x, &colors.y, &colors.z})
    std::fill(column->begin() + first, column->begin() + last, 1.0F);
}

void ObjColors::put(std::uint64_t row, std::span<const float, 3> color) {
  const auto linear = [](float code) { return linear_of_srgb(std::clamp(code, 0.0F, 1.0F)); };
  desc_.colors.x[row] = linear(color[0]);
  desc_.colors.y[row] = linear(color[1]);
  desc_.colors.z[row] = linear(color[2]);
}

void show_vertex_colors(SceneDesc& desc, std::size_t default_material) {
  for (std::size_t i = 0; i < desc.materials.size(); ++i) {
    Material& material = desc.materials[i];
    if (i == default_material) material.ambient = material.diffuse = Vec3(1.0F);
    material.vertex_colors = material.diffuse_texture == no_texture;
  }
}

} // namespace fastrt
