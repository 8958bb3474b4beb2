// SPDX-License-Identifier: Apache-2.0
#include "src/write/checksum.hpp"

#include <emmintrin.h>

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

constexpr std::size_t block_size = 16;

// weighed: each byte times the number of bytes from it on.
struct ByteSums {
  std::uint64_t plain, weighed;
};

std::uint64_t sum_of_halves(__m128i halves) {
  return static_cast<std::uint64_t>(
      _mm_cvtsi128_si64(_mm_add_epi64(halves, _mm_unpackhi_epi64(halves, halves))));
}

ByteSums sum_blocks(const unsigned char* bytes, std::size_t blocks) {
  const __m128i zero = _mm_setzero_si128();
  const __m128i first_weights = _mm_setr_epi16(16, 15, 14, 13, 12, 11, 10, 9),
                last_weights = _mm_setr_epi16(8, 7, 6, 5, 4, 3, 2, 1);
  __m128i plain = zero, before = zero, within = zero;
  for (const unsigned char* const end = bytes + blocks * block_size; bytes != end; bytes += block_size) {
    const __m128i block = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
    before =
        _mm_add_epi64(before, plain); // bytes of earlier blocks count once more for each byte of this one
    plain = _mm_add_epi64(plain, _mm_sad_epu8(block, zero));
    within = _mm_add_epi32(within, _mm_madd_epi16(_mm_unpacklo_epi8(block, zero), first_weights));
    within = _mm_add_epi32(within, _mm_madd_epi16(_mm_unpackhi_epi8(block, zero), last_weights));
  }
  const __m128i within_halves =
      _mm_add_epi64(_mm_unpacklo_epi32(within, zero), _mm_unpackhi_epi32(within, zero));
  return {sum_of_halves(plain), block_size * sum_of_halves(before) + sum_of_halves(within_halves)};
}

} // namespace

std::uint32_t adler32(const unsigned char* bytes, std::size_t count) noexcept {
  constexpr std::size_t run = 4096; // sums of so many bytes fit into 32 bits
  std::uint64_t a = 1, b = 0;
  while (count != 0) {
    const std::size_t n = std::min(count, run), blocks = n / block_size;
    const ByteSums sums = sum_blocks(bytes, blocks);
    b += blocks * block_size * a + sums.weighed;
    a += sums.plain;
    for (std::size_t i = blocks * block_size; i < n; ++i) b += a += bytes[i];
    a %= adler_base;
    b %= adler_base;
    bytes += n;
    count -= n;
  }
  return static_cast<std::uint32_t>(b << 16U | a);
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
