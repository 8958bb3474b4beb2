// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/ply_header.hpp"
#include "src/load/ply_reader.hpp"

#include <fastrt/scene.hpp>

#include <functional>
#include <string>

namespace fastrt {

using PlyWarning = std::function<void(const char* kind, const Place& place, const std::string& message)>;

// Says which properties of the element `face` the scene can't hold: colours and texture coordinates.
void warn_about_face_properties(const PlyElement& face, const PlyWarning& warn);

// Adds the file's material, after the vertices: the picture that its header names, else the vertices'
// colours, else a grey. A picture that can't be used is a warning and shows a checker.
void add_ply_material(const PlyHeader& header, const PlyReaderSettings& settings, const PlyWarning& warn,
                      SceneDesc& desc);

} // namespace fastrt
