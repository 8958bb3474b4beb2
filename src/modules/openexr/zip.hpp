// SPDX-License-Identifier: Apache-2.0
// Rows of a picture as OpenEXR's "zip" keeps them, 16 to a chunk.
#pragma once

#include "src/modules/pictures.hpp"

#include <vector>

namespace fastrt {

inline constexpr int rows_in_chunk = 16;

// Each a chunk's bytes, from the top. `channels`: by their names' order, as the file holds them. Throws
// std::bad_alloc.
std::vector<std::vector<unsigned char>> zip_chunks(const LayersToEncode& layers,
                                                   const std::vector<LayerChannel>& channels);

} // namespace fastrt
