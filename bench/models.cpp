// SPDX-License-Identifier: Apache-2.0
#include "bench/models.hpp"

#include <fastrt/load.hpp>

#include <filesystem>

#include "bench/generated.hpp"

namespace fastrt::bench {

Model read_model(const std::string& argument) {
  if (!std::filesystem::exists(argument)) return {argument, generated_scene(argument)};
  LoadOptions options;
  options.sidecar = false;
  Diagnostics diagnostics;
  return {std::filesystem::path(argument).stem().string(), load_scene(argument, options, diagnostics)};
}

View view_of(const Model& model, const Aabb& bounds, std::optional<bool> inside) {
  const bool is_room = model.name.find("sponza") != std::string::npos;
  return inside.value_or(is_room) ? inside_view(bounds) : outside_view(bounds);
}

} // namespace fastrt::bench
