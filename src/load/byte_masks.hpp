// SPDX-License-Identifier: Apache-2.0
// What kinds of bytes lie where in 64 bytes of text: a bit each.
#pragma once

#include <emmintrin.h>

#include <cstdint>

namespace fastrt {

struct ByteMasks {
  std::uint64_t line_ends = 0; // line feed, carriage return
  std::uint64_t blanks = 0;    // these, space and every control character
  bool has_comment = false;    // or something like one: a # somewhere
};

// What occurred in blocks so far.
struct ByteTraces {
  __m128i least = _mm_set1_epi8(-1); // of the bytes of each lane: 0 where a NUL was
  __m128i slashes = _mm_setzero_si128();

  bool has_nul() const { return _mm_movemask_epi8(_mm_cmpeq_epi8(least, _mm_setzero_si128())) != 0; }
  bool has_slash() const { return _mm_movemask_epi8(slashes) != 0; }
};

inline __m128i load_16(const char* text) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(text)); }
inline __m128i equal_16(__m128i bytes, char c) { return _mm_cmpeq_epi8(bytes, _mm_set1_epi8(c)); }
inline std::uint64_t bits_16(__m128i lanes) { return static_cast<unsigned>(_mm_movemask_epi8(lanes)); }

// SSE2 is part of every x86-64, so this needs no choice of ISA.
[[gnu::always_inline]] inline ByteMasks masks_of(const char* text, ByteTraces& traces) {
  ByteMasks masks;
  const __m128i space = _mm_set1_epi8(' ');
  __m128i comments = _mm_setzero_si128();
  for (unsigned i = 0; i < 64; i += 16) {
    const __m128i bytes = load_16(text + i);
    masks.line_ends |= bits_16(_mm_or_si128(equal_16(bytes, '\n'), equal_16(bytes, '\r'))) << i;
    masks.blanks |= bits_16(_mm_cmpeq_epi8(_mm_max_epu8(bytes, space), space)) << i;
    comments = _mm_or_si128(comments, equal_16(bytes, '#'));
    traces.least = _mm_min_epu8(traces.least, bytes);
    traces.slashes = _mm_or_si128(traces.slashes, equal_16(bytes, '/'));
  }
  masks.has_comment = bits_16(comments) != 0;
  return masks;
}

// Where a # stands.
inline std::uint64_t comments_of(const char* text) {
  std::uint64_t comments = 0;
  for (unsigned i = 0; i < 64; i += 16) comments |= bits_16(equal_16(load_16(text + i), '#')) << i;
  return comments;
}

} // namespace fastrt
