// SPDX-License-Identifier: Apache-2.0
// Where runs of digits end, found for a stretch of text at once: so no number has to wait for the length of
// the one before it.
#pragma once

#include <emmintrin.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace fastrt {

// For each 8 bits: the places of those that are set, a byte each, and how many they are.
struct BitPlaces {
  std::array<std::uint64_t, 256> places{};
  std::array<std::uint8_t, 256> counts{};

  constexpr BitPlaces() {
    for (std::size_t bits = 0; bits < 256; ++bits)
      for (unsigned i = 0; i < 8; ++i)
        if ((bits >> i & 1U) != 0) places[bits] |= std::uint64_t{i} << (8U * counts[bits]++);
  }
};
inline constexpr BitPlaces bit_places;

// The marks of a stretch of text: all bytes up to '/', but for the minus sign, which is part of a number.
// These are points, slashes, blanks, line ends and other control characters.
class DigitMarks {
public:
  static constexpr std::size_t reach = 8192; // the longest stretch
  static constexpr std::size_t beyond = 16;  // so many bytes behind the text may be read

  // Finds the marks of text .. end - 1, or of the first `reach` bytes of it; and some behind the end.
  void find(const char* text, const char* end) {
    const auto length = static_cast<std::size_t>(end - text);
    const std::size_t size = length < reach ? length : reach;
    std::uint16_t* next = places_.data();
    __m128i base = _mm_setzero_si128();
    for (std::size_t i = 0; i < size; i += 16) {
      const unsigned bits = bits_of(_mm_loadu_si128(reinterpret_cast<const __m128i*>(text + i)));
      next = put(next, bits & 0xFFU, base);
      base = _mm_add_epi16(base, _mm_set1_epi16(8));
      next = put(next, bits >> 8U, base);
      base = _mm_add_epi16(base, _mm_set1_epi16(8));
    }
    end_ = next;
    std::fill(next, next + spare, std::uint16_t{0});
  }

  // Offsets from the text's begin, ascending. Behind them are some zeros, for those that look ahead.
  const std::uint16_t* begin() const { return places_.data(); }
  const std::uint16_t* end() const { return end_; }

private:
  static unsigned bits_of(__m128i bytes) {
    const __m128i slash = _mm_set1_epi8('/');
    const __m128i low = _mm_cmpeq_epi8(_mm_max_epu8(bytes, slash), slash);
    return static_cast<unsigned>(
        _mm_movemask_epi8(_mm_andnot_si128(_mm_cmpeq_epi8(bytes, _mm_set1_epi8('-')), low)));
  }

  // Writes eight places, and goes on behind those that are some.
  static std::uint16_t* put(std::uint16_t* to, unsigned bits, __m128i base) {
    const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&bit_places.places[bits]));
    const __m128i places = _mm_add_epi16(_mm_unpacklo_epi8(bytes, _mm_setzero_si128()), base);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), places);
    return to + bit_places.counts[bits];
  }

  static constexpr std::size_t spare = 8; // as many as put() may write too many, too

  std::array<std::uint16_t, reach + 16 + spare> places_;
  const std::uint16_t* end_ = nullptr;
};

} // namespace fastrt
