// SPDX-License-Identifier: Apache-2.0
#include "src/load/obj_colors.hpp"

#include "src/load/obj_fill.hpp"
#include "src/scene/srgb_curve.hpp"

#include <algorithm>
#include <string>

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

// False, and nothing done, if there is something to be said about it.
bool ObjFiller::put_colored(std::span<const float> numbers, std::size_t count) {
  if (!has_color(count) || !is_srgb(color_in(numbers, count))) return false;
  put_position(numbers);
  put_color(color_in(numbers, count));
  return true;
}

// Of the last position.
void ObjFiller::put_color(std::span<const float, 3> color) {
  if (!result_->has_colors) colors_.start(first_position_, last_.positions);
  result_->has_colors = true;
  colors_.put(now_.before.positions - 1, color);
}

// What stands behind the last position.
void ObjFiller::read_color(std::span<const float> numbers, std::size_t count) {
  if (count <= 4) return;
  if (!has_color(count)) {
    result_->log.warn(line_offset_, "position with odd numbers",
                      std::to_string(count) + " numbers after 'v': expected x y z, behind them a weight or a "
                                              "colour or both; only x y z are used");
    return;
  }
  const std::span<const float, 3> color = color_in(numbers, count);
  if (!is_srgb(color))
    result_->log.warn(line_offset_, "vertex colour",
                      "a colour's numbers go from 0 to 1; others count as the nearest of these");
  put_color(color);
}

void show_vertex_colors(SceneDesc& desc, std::size_t default_material) {
  for (std::size_t i = 0; i < desc.materials.size(); ++i) {
    Material& material = desc.materials[i];
    if (i == default_material) material.ambient = material.diffuse = Vec3(1.0F);
    material.vertex_colors = material.diffuse_texture == no_texture;
  }
}

} // namespace fastrt
