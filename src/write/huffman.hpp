// SPDX-License-Identifier: Apache-2.0
// Huffman codes as deflate wants them.
#pragma once

#include <cstdint>
#include <span>

namespace fastrt {

// lengths[i]: bits of symbol i's code, 1..limit, 0 where counts[i] is 0. At most 2^limit symbols; a single
// symbol gets one bit.
void huffman_lengths(std::span<const std::uint32_t> counts, unsigned limit, std::span<std::uint8_t> lengths);

// The canonical codes of these lengths, with the first bit lowest, as deflate writes them.
void huffman_codes(std::span<const std::uint8_t> lengths, std::span<std::uint16_t> codes);

} // namespace fastrt
