// SPDX-License-Identifier: Apache-2.0
// The first pass over an OBJ file: how much of everything each chunk holds, and in which state it leaves what
// follows. With that every chunk can be read on its own, straight into its place in the scene.
#pragma once

#include "src/load/chunks.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt {

struct ObjCounts {
  std::uint64_t positions = 0, normals = 0, uvs = 0, triangles = 0, objects = 0, groups = 0;
  ObjCounts& operator+=(const ObjCounts& other);
};

struct ObjSummary {
  ObjCounts counts;
  std::uint64_t lines = 0; // line ends
  bool face_before_object = false, face_before_group = false;
  bool has_slash = false;     // so that faces may name more than positions
  bool needs_care = false;    // holds a NUL or a line that is too long
  bool has_smoothing = false; // a smoothing group other than 0
  // What the last `usemtl` and `s` say, if there are any.
  std::optional<std::string> material;
  std::optional<std::uint32_t> smoothing;
  struct Library {
    std::uint64_t offset;
    std::string names;
  };
  std::vector<Library> libraries; // the mtllib lines
};

// `chunk_begin`: where in the file the buffer's text lies. Joins continued lines in the buffer.
ObjSummary scan_obj(ChunkBuffer& buffer, std::uint64_t chunk_begin);

// The group of an `s` statement: "off" and 0 are none. Nothing for what is neither.
std::optional<std::uint32_t> smoothing_group_in(std::string_view rest);

// How many triangles a face line makes; `rest` is what stands behind the `f`.
std::size_t triangles_in_face(std::string_view rest);

} // namespace fastrt
