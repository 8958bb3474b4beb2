// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/event_log.hpp"
#include "src/load/material_set.hpp"
#include "src/load/source.hpp"

#include <fastrt/diagnostics.hpp>
#include <fastrt/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace fastrt {

// Reads what an mtllib line names; `offset` is where the line lies in the OBJ file.
using LibraryReader = std::function<void(const std::string& names, std::uint64_t offset,
                                         MaterialSet& materials, EventLog& log)>;

struct ObjReaderSettings {
  int threads = 1;
  bool strict = false;
  std::string object_name;               // of faces before any `o` or `g`
  std::size_t chunk_bytes = 256U * 1024; // at least 4; the result does not depend on it
  LibraryReader read_library;            // may be empty: material files are passed over
};

// Reads an OBJ file in three passes, each over all chunks in parallel: count, fill the columns, and check
// what needs all positions. The file is read twice rather than kept: memory goes to the scene alone. Throws
// as load_obj does.
SceneDesc read_obj(const Source& source, const ObjReaderSettings& settings, Diagnostics& diagnostics);

} // namespace fastrt
