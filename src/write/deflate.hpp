// SPDX-License-Identifier: Apache-2.0
// A fast deflate (RFC 1951) for filtered picture rows: bytes and runs of equal bytes under Huffman codes made
// for the piece. Filtered renders hold few other repeats, so not searching for them costs little size.
#pragma once

#include <cstddef>
#include <vector>

namespace fastrt {

// Appends the bytes as one block that is not the last one, then an empty block that ends at a whole byte. So
// pieces that were compressed by themselves make one stream when put together.
void deflate_piece(const unsigned char* bytes, std::size_t count, std::vector<unsigned char>& out);

// Appends the empty last block.
void deflate_end(std::vector<unsigned char>& out);

} // namespace fastrt
