// SPDX-License-Identifier: Apache-2.0
// Putting scenes together.
#pragma once

#include <fastrt/scene.hpp>

#include <array>
#include <cstdint>

namespace fastrt {

// Adds the primitives, materials, textures and objects of `from`, which has no planes, prototypes or
// instances. Lights, camera and settings of `to` stay as they are.
void append_scene(SceneDesc& to, SceneDesc from);

// Optional columns of triangles, and the vertices' colours, to the length that belongs to them.
void pad_normals(SceneDesc& desc);
void pad_uvs(SceneDesc& desc);
void pad_colors(SceneDesc& desc);

// Where a material says which textures it has.
std::array<std::uint32_t*, 6> texture_slots(Material& material);

} // namespace fastrt
