// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/event_log.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline constexpr std::size_t ply_type_sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
inline std::size_t size_of(PlyType type) { return ply_type_sizes[static_cast<std::size_t>(type)]; }
inline bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32; // of a list: of its items
  bool is_list = false;
  PlyType count_type = PlyType::uint8; // of lists
  Place place;                         // of its name
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat { ascii, little_endian, big_endian };

// What a line "comment TextureFile NAME" says.
struct PlyTexture {
  std::string name;
  Place place;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<PlyTexture> textures;
  std::size_t size = 0; // in bytes: where the data begin
};

// Reads the header of a PLY file. Throws InputError with line and column of the file `name`.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& name);

} // namespace fastrt
