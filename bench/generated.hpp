// SPDX-License-Identifier: Apache-2.0
// Scenes that need no file.
#pragma once

#include <fastrt/scene.hpp>

#include <string>
#include <vector>

namespace fastrt::bench {

// Spheres on spheres, nine around each, `levels` deep, over a floor: the shape of Haines' "balls" (SPD,
// 1987).
SceneDesc balls_scene(int levels = 4);

// A height field of 2 * cells * cells triangles.
SceneDesc terrain_scene(int cells = 256);

// A tree of tapered prisms with balls at their ends on a wide floor: triangles and spheres, 2^(levels + 1) -
// 1 branches.
SceneDesc tree_scene(int levels = 11);

// "balls", "terrain", "tree". Throws UsageError for other names.
SceneDesc generated_scene(const std::string& name);
std::vector<std::string> generated_scene_names();

} // namespace fastrt::bench
