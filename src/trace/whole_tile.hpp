// SPDX-License-Identifier: Apache-2.0
// A tile's pixels into the frame where all of them are in it, four neighbours at a time.
#pragma once

#include "src/simd/lanes.hpp"
#include "src/trace/tile_places.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Four pixels side by side: r g b r  g b r g  b r g b.
FASTRT_INLINE void put_four_colors(float* to, __m128 r, __m128 g, __m128 b) {
  const __m128 rg01 = _mm_unpacklo_ps(r, g), rg23 = _mm_unpackhi_ps(r, g);
  const __m128 b0_r1 = _mm_shuffle_ps(b, rg01, _MM_SHUFFLE(2, 2, 0, 0));
  const __m128 g1_b1 = _mm_shuffle_ps(rg01, b, _MM_SHUFFLE(1, 1, 3, 3));
  const __m128 b2_r3 = _mm_shuffle_ps(b, rg23, _MM_SHUFFLE(2, 2, 2, 2));
  const __m128 g3_b3 = _mm_shuffle_ps(rg23, b, _MM_SHUFFLE(3, 3, 3, 3));
  _mm_storeu_ps(to, _mm_shuffle_ps(rg01, b0_r1, _MM_SHUFFLE(2, 0, 1, 0)));
  _mm_storeu_ps(to + 4, _mm_shuffle_ps(g1_b1, rg23, _MM_SHUFFLE(1, 0, 2, 0)));
  _mm_storeu_ps(to + 8, _mm_shuffle_ps(b2_r3, g3_b3, _MM_SHUFFLE(2, 0, 2, 0)));
}

// Two rows of four pixels from eight places of a tile in its order (tile_order.hpp).
struct TwoRows {
  __m128 upper, lower;
};
FASTRT_INLINE TwoRows two_rows(const float* places) {
  const __m128 left = _mm_loadu_ps(places), right = _mm_loadu_ps(places + 4);
  return {_mm_movelh_ps(left, right), _mm_movehl_ps(right, left)};
}

// The tile's one sample.
static void write_whole_tile(const TileJob& job, const TileScratch& scratch) noexcept {
  for (int i = 0; i < batch_size; i += 8) {
    const TwoRows r = two_rows(scratch.radiance_r + i), g = two_rows(scratch.radiance_g + i),
                  b = two_rows(scratch.radiance_b + i),
                  id = two_rows(reinterpret_cast<const float*>(scratch.first_primitive + i));
    const long upper = frame_pixel(job, i), lower = frame_pixel(job, i + 2);
    put_four_colors(job.rgb + 3 * upper, r.upper, g.upper, b.upper);
    put_four_colors(job.rgb + 3 * lower, r.lower, g.lower, b.lower);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(job.primitive + upper), _mm_castps_si128(id.upper));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(job.primitive + lower), _mm_castps_si128(id.lower));
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
