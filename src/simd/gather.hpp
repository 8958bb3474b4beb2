// SPDX-License-Identifier: Apache-2.0
// A number for each lane from a place of its own.
#pragma once

#include "src/simd/lanes.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// from[places] of the lanes in `bits`, 0 in the others. Numbers that are written one by one and then read as
// a register would make the reader wait.
FASTRT_INLINE Ints<widest> gather(const std::int32_t* from, const Ints<widest>& places, std::uint32_t bits) {
#if defined(__AVX512DQ__)
  return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), static_cast<__mmask16>(bits), places.data, from,
                                     4);
#elif defined(__AVX2__)
  const __m256i mask = _mm256_castps_si256(from_bits<8>(bits).data);
  return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), from, places.data, mask, 4);
#else
  if (bits == 0) return Ints<widest>(0);
  const __m128i mask = _mm_castps_si128(from_bits<4>(bits).data), at = _mm_and_si128(places.data, mask);
  const __m128i found = _mm_setr_epi32(from[_mm_cvtsi128_si32(at)], from[_mm_extract_epi32(at, 1)],
                                       from[_mm_extract_epi32(at, 2)], from[_mm_extract_epi32(at, 3)]);
  return _mm_and_si128(found, mask);
#endif
}
FASTRT_INLINE Ints<widest> gather(const std::uint32_t* from, const Ints<widest>& places, std::uint32_t bits) {
  return gather(reinterpret_cast<const std::int32_t*>(from), places, bits);
}
FASTRT_INLINE Floats<widest> gather(const float* from, const Ints<widest>& places, std::uint32_t bits) {
  return as_floats<Floats<widest>>(gather(reinterpret_cast<const std::int32_t*>(from), places, bits));
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
