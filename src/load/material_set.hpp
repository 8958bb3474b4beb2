// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/material.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace fastrt {

// Material ids by name, to be asked with a string_view.
struct NameHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view name) const { return std::hash<std::string_view>{}(name); }
};
using MaterialIds = std::unordered_map<std::string, std::uint32_t, NameHash, std::equal_to<>>;

// The materials of a scene, in the order in which they were first defined.
struct MaterialSet {
  std::vector<Material> materials;
  std::vector<Texture> textures;
  MaterialIds ids;

  // The last one of a name wins.
  void add(Material material) {
    const auto id = static_cast<std::uint32_t>(materials.size());
    const auto [known, is_new] = ids.try_emplace(material.name, id);
    if (is_new)
      materials.push_back(std::move(material));
    else
      materials[known->second] = std::move(material);
  }
};

} // namespace fastrt
