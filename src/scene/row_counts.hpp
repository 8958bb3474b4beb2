// SPDX-License-Identifier: Apache-2.0
// How many rows there are of each kind that prototypes may hold, in the order of PrimitiveKind.
#pragma once

#include <fastrt/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastrt {

inline constexpr std::array<const char*, 5> row_kind_names{"triangles", "spheres", "cones", "disks",
                                                           "polygons"};

// The scene need not have been checked.
std::array<std::size_t, 5> row_counts(const SceneDesc& desc);

// `size` as an id that indices of 32 bits can hold. Throws LimitError beyond.
std::uint32_t checked_size(std::size_t size, const char* what);

// The counts as such ids.
std::array<std::uint32_t, 5> checked_row_counts(const SceneDesc& desc);

} // namespace fastrt
