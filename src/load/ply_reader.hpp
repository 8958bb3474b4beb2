// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/source.hpp"
#include "src/load/texture_file.hpp"

#include <fastrt/diagnostics.hpp>
#include <fastrt/scene.hpp>

#include <functional>
#include <string>

namespace fastrt {

struct PlyReaderSettings {
  bool strict = false;     // warnings become InputError
  std::string object_name; // of the mesh
  // The picture that a header names; may be empty: then it is passed over.
  std::function<TextureFile(const std::string& name)> read_texture;
};

// Reads a PLY file: one object of one material. Throws InputError (with line and column, or with the byte in
// binary data) for what can't be read and LimitError for what is too large.
SceneDesc read_ply(const Source& source, const PlyReaderSettings& settings, Diagnostics& diagnostics);

} // namespace fastrt
