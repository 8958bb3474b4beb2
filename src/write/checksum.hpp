// SPDX-License-Identifier: Apache-2.0
// The two checksums of a PNG file.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fastrt {

// Adler-32 (RFC 1950), and that of two pieces one after the other from those of the pieces.
std::uint32_t adler32(const unsigned char* bytes, std::size_t count) noexcept;
std::uint32_t adler32_combine(std::uint32_t first, std::uint32_t second, std::size_t second_count) noexcept;

// CRC-32 (ISO 3309).
std::uint32_t crc32(const unsigned char* bytes, std::size_t count) noexcept;

} // namespace fastrt
