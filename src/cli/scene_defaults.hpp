// SPDX-License-Identifier: Apache-2.0
// What a scene says of its picture, and what the command line says instead.
#pragma once

#include "src/cli/options.hpp"

#include <fastrt/scene.hpp>

namespace fastrt::cli {

// Gives options that were not given the scene's values.
void take_picture_settings(const SceneDesc& desc, Options& options);

// The scene's camera, or one that shows all of it, changed by the options. Throws InputError for a view that
// makes no sense, with the scene's name if it makes none without options.
Camera choose_camera(const Options& options, const Aabb& bounds, const SceneDesc& desc);

// The scene's lights, or a key and a fill light, changed by the options.
void light_scene(const Options& options, const Aabb& bounds, const Camera& camera, SceneDesc& desc);

// Throws InputError, with the scene's name, for what can't be rendered.
Scene checked_scene(const Options& options, SceneDesc desc);

} // namespace fastrt::cli
