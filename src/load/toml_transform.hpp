// SPDX-License-Identifier: Apache-2.0
// Affine maps as scene.toml writes them (docs/scene-toml.md), in double precision until they are complete.
#pragma once

#include "src/load/toml_fields.hpp"

#include <fastrt/math.hpp>

#include <cstddef>
#include <vector>

namespace fastrt {

// A point p goes to linear * p + origin.
struct TomlMap {
  glm::dmat3 linear{1.0};
  glm::dvec3 origin{0.0};
};
// First `inner`, then `outer`.
TomlMap after(const TomlMap& outer, const TomlMap& inner);
Affine rounded(const TomlMap& map);
// Whether it is finite and can be undone.
bool can_be_undone(const TomlMap& map);

// An array of 3 numbers (a translation), 12 or 16 (a matrix by rows), a table of steps, or an array of such.
TomlMap read_transform(const TomlValue& value);

// The most copies that one table may ask for.
inline constexpr std::size_t most_toml_copies = std::size_t{1} << 22U;

inline constexpr std::string_view placement_keys[] = {"transform", "transforms", "repeat"};

// Where `transform`, `transforms` and `repeat` put something, copy by copy; empty if none of them is there.
std::vector<TomlMap> read_placements(const TomlFields& fields);

} // namespace fastrt
