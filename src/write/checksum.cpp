// SPDX-License-Identifier: Apache-2.0
#include "src/write/checksum.hpp"

#include <algorithm>
#include <array>

namespace fastrt {

namespace {

constexpr std::uint32_t adler_base = 65521;
constexpr std::size_t slices = 8;

using CrcTables = std::array<std::array<std::uint32_t, 256>, slices>;

// tables[k][b]: what byte b does to the checksum, k bytes later.
constexpr CrcTables make_crc_tables() {
  CrcTables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    tables[0][byte] = crc;
  }
  for (std::size_t k = 1; k < slices; ++k)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t crc = tables[k - 1][byte];
      tables[k][byte] = (crc >> 8U) ^ tables[0][crc & 0xFFU];
    }
  return tables;
}

constexpr CrcTables crc_tables = make_crc_tables();

} // namespace

std::uint32_t adler32(const unsigned char* bytes, std::size_t count) noexcept {
  // Sums of so many bytes, and of these weighed by their place, fit into 32 bits.
  constexpr std::size_t run = 4096;
  std::uint32_t a = 1, b = 0;
  while (count != 0) {
    const auto n = static_cast<std::uint32_t>(std::min(count, run));
    std::uint32_t sum = 0, weighed = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      sum += bytes[i];
      weighed += (n - i) * bytes[i];
    }
    b = static_cast<std::uint32_t>((b + std::uint64_t{n} * a + weighed) % adler_base);
    a = (a + sum) % adler_base;
    bytes += n;
    count -= n;
  }
  return b << 16U | a;
}

std::uint32_t adler32_combine(std::uint32_t first, std::uint32_t second, std::size_t second_count) noexcept {
  // The second piece began its sum at 1, but would have begun it at `a - 1` more.
  const std::uint64_t a = first & 0xFFFFU, b = first >> 16U;
  const std::uint64_t before = a + adler_base - 1;
  const std::uint64_t a_all = (before + (second & 0xFFFFU)) % adler_base;
  const std::uint64_t b_all =
      (b + (second >> 16U) + (second_count % adler_base) * (before % adler_base)) % adler_base;
  return static_cast<std::uint32_t>(b_all << 16U | a_all);
}

std::uint32_t crc32(const unsigned char* bytes, std::size_t count) noexcept {
  const CrcTables& t = crc_tables;
  std::uint32_t crc = 0xFFFFFFFFU;
  for (; count >= slices; bytes += slices, count -= slices) {
    const std::uint32_t low =
        crc ^ (static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8U |
               static_cast<std::uint32_t>(bytes[2]) << 16U | static_cast<std::uint32_t>(bytes[3]) << 24U);
    crc = t[7][low & 0xFFU] ^ t[6][(low >> 8U) & 0xFFU] ^ t[5][(low >> 16U) & 0xFFU] ^ t[4][low >> 24U] ^
          t[3][bytes[4]] ^ t[2][bytes[5]] ^ t[1][bytes[6]] ^ t[0][bytes[7]];
  }
  for (; count != 0; ++bytes, --count) crc = (crc >> 8U) ^ t[0][(crc ^ *bytes) & 0xFFU];
  return ~crc;
}

} // namespace fastrt
