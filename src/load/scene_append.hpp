// SPDX-License-Identifier: Apache-2.0
// Putting scenes together.
#pragma once

#include <fastrt/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastrt {

// `size` as an id that indices of 32 bits can hold. Throws LimitError beyond.
std::uint32_t checked_size(std::size_t size, const char* what);

// Adds the primitives, materials, textures and objects of `from`, which has no planes, prototypes or
// instances. Lights, camera and settings of `to` stay as they are.
void append_scene(SceneDesc& to, SceneDesc from);

// Optional columns of triangles, and the vertices' colours, to the length that belongs to them.
void pad_normals(SceneDesc& desc);
void pad_uvs(SceneDesc& desc);
void pad_colors(SceneDesc& desc);

// How many rows there are of each kind that prototypes may hold.
std::array<std::uint32_t, 5> row_counts(const SceneDesc& desc);

} // namespace fastrt
