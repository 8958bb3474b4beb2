// SPDX-License-Identifier: Apache-2.0
// Moves the lanes that a mask picks to the front of a register.
#pragma once

#include "src/simd/lanes.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

#if !defined(__AVX512DQ__)
// For each mask of W lanes the lanes in it, lowest first; as lane numbers, or as their bytes.
template <int W>
struct LanesOfMask {
  static constexpr int bytes = W == 4 ? 4 : 1;
  alignas(32) std::uint8_t lanes[1 << W][W * bytes];
};

template <int W>
inline constexpr LanesOfMask<W> lanes_of_mask = [] {
  constexpr int bytes = LanesOfMask<W>::bytes;
  LanesOfMask<W> table{};
  for (int mask = 0; mask < 1 << W; ++mask)
    for (int lane = 0, at = 0; lane < W; ++lane) {
      if ((mask >> lane & 1) == 0) continue;
      for (int b = 0; b < bytes; ++b) table.lanes[mask][at++] = static_cast<std::uint8_t>(lane * bytes + b);
    }
  return table;
}();
#endif

// Prepared once for all registers that one mask of the widest register picks from.
class Compressor {
public:
  [[gnu::always_inline]] explicit inline Compressor(std::uint32_t bits) {
#if defined(__AVX512DQ__)
    mask_ = static_cast<__mmask16>(bits);
#elif defined(__AVX2__)
    const void* const lanes = lanes_of_mask<8>.lanes[bits];
    places_ = _mm256_cvtepu8_epi32(_mm_loadl_epi64(static_cast<const __m128i*>(lanes)));
#else
    const void* const lanes = lanes_of_mask<4>.lanes[bits];
    places_ = _mm_load_si128(static_cast<const __m128i*>(lanes));
#endif
  }

  // The picked lanes to `to`, and after them what is of no use: a whole register is written.
  [[gnu::always_inline]] inline void store(const Ints<widest>& value, std::int32_t* to) const {
#if defined(__AVX512DQ__)
    Ints<widest>(_mm512_maskz_compress_epi32(mask_, value.data)).store_unaligned(to);
#elif defined(__AVX2__)
    Ints<widest>(_mm256_permutevar8x32_epi32(value.data, places_)).store_unaligned(to);
#else
    Ints<widest>(_mm_shuffle_epi8(value.data, places_)).store_unaligned(to);
#endif
  }
  [[gnu::always_inline]] inline void store(const Floats<widest>& value, float* to) const {
#if defined(__AVX512DQ__)
    Floats<widest>(_mm512_maskz_compress_ps(mask_, value.data)).store_unaligned(to);
#elif defined(__AVX2__)
    Floats<widest>(_mm256_permutevar8x32_ps(value.data, places_)).store_unaligned(to);
#else
    const __m128i moved = _mm_shuffle_epi8(_mm_castps_si128(value.data), places_);
    Floats<widest>(_mm_castsi128_ps(moved)).store_unaligned(to);
#endif
  }

private:
#if defined(__AVX512DQ__)
  __mmask16 mask_;
#elif defined(__AVX2__)
  __m256i places_;
#else
  __m128i places_;
#endif
};

} // namespace fastrt::FASTRT_ISA_NAMESPACE
