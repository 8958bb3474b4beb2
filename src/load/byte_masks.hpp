// SPDX-License-Identifier: Apache-2.0
// What kinds of bytes lie where in 64 bytes of text: a bit each.
#pragma once

#include <emmintrin.h>

#include <cstdint>

namespace fastrt {

struct ByteMasks {
  std::uint64_t line_ends; // line feed, carriage return
  std::uint64_t blanks;    // these, space and every control character
  std::uint64_t marks;     // # and backslash: the line wants a closer look
};

// Bytes of which only matters whether they occur: all ones where one did.
struct ByteTraces {
  __m128i nuls = _mm_setzero_si128();
  __m128i slashes = _mm_setzero_si128();
};

// SSE2 is part of every x86-64, so this needs no choice of ISA.
inline ByteMasks masks_of(const char* text, ByteTraces& traces) {
  ByteMasks masks{};
  const auto bits = [](__m128i lanes) { return static_cast<std::uint64_t>(_mm_movemask_epi8(lanes)); };
  const __m128i zero = _mm_setzero_si128();
  const __m128i space = _mm_set1_epi8(' ');
  for (unsigned i = 0; i < 64; i += 16) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(text + i));
    const auto equal = [bytes](char c) { return _mm_cmpeq_epi8(bytes, _mm_set1_epi8(c)); };
    masks.line_ends |= bits(_mm_or_si128(equal('\n'), equal('\r'))) << i;
    masks.blanks |= bits(_mm_cmpeq_epi8(_mm_max_epu8(bytes, space), space)) << i;
    masks.marks |= bits(_mm_or_si128(equal('#'), equal('\\'))) << i;
    traces.nuls = _mm_or_si128(traces.nuls, _mm_cmpeq_epi8(bytes, zero));
    traces.slashes = _mm_or_si128(traces.slashes, equal('/'));
  }
  return masks;
}

} // namespace fastrt
