// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/ply_cursor.hpp"

#include <fastrt/scene.hpp>

#include <string>

namespace fastrt {

// Reads the rows of the element `vertex` into positions, normals, uvs and colors of `desc`; each of the last
// three only if the file has all of its columns. name: the file's. Throws InputError where the file ends or
// holds something else, for a vertex without x, y or z, and for numbers that are not finite.
void read_ply_vertices(const PlyElement& element, PlyCursor& cursor, const std::string& name,
                       SceneDesc& desc);

} // namespace fastrt
