// SPDX-License-Identifier: Apache-2.0
// The scenes that programs of this folder are called with.
#pragma once

#include <fastrt/scene.hpp>

#include <optional>
#include <string>

#include "bench/ray_sets.hpp"

namespace fastrt::bench {

struct Model {
  std::string name;
  SceneDesc desc;
};

// A file, or a generated scene by its name. Throws what load_scene and generated_scene throw.
Model read_model(const std::string& argument);

// Where its rays come from: inside, outside, or if unset by its name (only Sponza is a room).
View view_of(const Model& model, const Aabb& bounds, std::optional<bool> inside);

} // namespace fastrt::bench
