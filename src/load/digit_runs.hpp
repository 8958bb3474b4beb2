// SPDX-License-Identifier: Apache-2.0
// Several runs of digits between marks (see DigitMarks) to numbers at once, four lanes of eight digits. SSE2
// is part of every x86-64, so this needs no choice of ISA.
#pragma once

#include "src/load/number.hpp"

#include <emmintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastrt {

// Masks of the last so many of eight characters.
inline constexpr std::array<std::uint64_t, 9> last_characters = [] {
  std::array<std::uint64_t, 9> masks{};
  for (unsigned count = 1; count <= 8; ++count) masks[count] = ~std::uint64_t{0} << (64U - 8U * count);
  return masks;
}();

inline __m128i two_words(std::uint64_t first, std::uint64_t second) {
  return _mm_set_epi64x(static_cast<long long>(second), static_cast<long long>(first));
}

inline std::uint64_t low_word(__m128i words) { return static_cast<std::uint64_t>(_mm_cvtsi128_si64(words)); }

// The last `count` characters before `end` less '0': digits become numbers. At most eight; zeros fill up the
// lane in front.
[[gnu::always_inline]] inline __m128i digits_before(const char* end, std::size_t count) {
  const __m128i text = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(end - 8));
  const __m128i wanted = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&last_characters[count]));
  return _mm_and_si128(_mm_sub_epi8(text, _mm_set1_epi8('0')), wanted);
}

// The same of two runs.
[[gnu::always_inline]] inline __m128i digits_before(const char* end, std::size_t count, const char* other_end,
                                                    std::size_t other_count) {
  const __m128i text = two_words(load_eight(end - 8), load_eight(other_end - 8));
  const __m128i wanted = two_words(last_characters[count], last_characters[other_count]);
  return _mm_and_si128(_mm_sub_epi8(text, _mm_set1_epi8('0')), wanted);
}

inline bool are_digits(__m128i bytes) {
  const __m128i nine = _mm_set1_epi8(9);
  return _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(bytes, nine), nine)) == 0xFFFF;
}

// Sixteen digits to four numbers of four digits.
inline __m128i join_digits(__m128i digits) {
  const __m128i even = _mm_and_si128(digits, _mm_set1_epi16(0xFF)), odd = _mm_srli_epi16(digits, 8);
  return _mm_add_epi32(_mm_madd_epi16(even, _mm_set1_epi32(1000 + (10 << 16))),
                       _mm_madd_epi16(odd, _mm_set1_epi32(100 + (1 << 16))));
}

// Four runs of eight digits to four numbers.
inline __m128i join_runs(__m128i first, __m128i second) {
  const __m128i parts = _mm_packs_epi32(join_digits(first), join_digits(second));
  return _mm_madd_epi16(parts, _mm_set1_epi32(10000 + (1 << 16)));
}

} // namespace fastrt
