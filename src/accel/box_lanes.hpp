// SPDX-License-Identifier: Apache-2.0
// Boxes in SSE2 registers, which every x86-64 has. The fourth lane is nobody's.
#pragma once

#include "src/accel/tree.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastrt {

struct LaneBox {
  __m128 lower = _mm_set1_ps(infinity);
  __m128 upper = _mm_set1_ps(-infinity);

  void extend(const LaneBox& other) {
    lower = _mm_min_ps(lower, other.lower);
    upper = _mm_max_ps(upper, other.upper);
  }
  void extend(__m128 point) {
    lower = _mm_min_ps(lower, point);
    upper = _mm_max_ps(upper, point);
  }
};

// Ids and groups are cleared: as floats they are denormals, which take a hundred cycles to compute with.
inline LaneBox clear_fourth(const LaneBox& box) {
  const __m128 xyz = _mm_castsi128_ps(_mm_set_epi32(0, -1, -1, -1));
  return {_mm_and_ps(box.lower, xyz), _mm_and_ps(box.upper, xyz)};
}

inline LaneBox load(const PrimitiveBox& box) {
  return clear_fourth({_mm_load_ps(box.lower), _mm_load_ps(box.upper)});
}

// Twice the centre.
inline __m128 doubled_centroid(const LaneBox& box) { return _mm_add_ps(box.lower, box.upper); }

// Half the area is the sum of the first three lanes. `scale` keeps it from running out of floats.
inline __m128 area_terms(const LaneBox& box, __m128 scale) {
  const __m128 extent = _mm_mul_ps(_mm_sub_ps(box.upper, box.lower), scale);
  return _mm_mul_ps(extent, _mm_shuffle_ps(extent, extent, _MM_SHUFFLE(3, 0, 2, 1)));
}

// What keeps the areas of boxes within `bounds` from running out of floats.
inline __m128 area_scale(const LaneBox& bounds) {
  alignas(16) float extent[4];
  _mm_store_ps(extent, _mm_sub_ps(bounds.upper, bounds.lower));
  const float largest = std::max(extent[0], std::max(extent[1], extent[2]));
  const bool usable = largest >= std::numeric_limits<float>::min() && largest < infinity;
  return _mm_set1_ps(usable ? std::ldexp(1.0F, -std::min(std::ilogb(largest), 126)) : 1.0F);
}

// The half areas of four boxes from their terms.
inline __m128 sum_terms(__m128 a, __m128 b, __m128 c, __m128 d) {
  _MM_TRANSPOSE4_PS(a, b, c, d);
  return _mm_add_ps(_mm_add_ps(a, b), c);
}

inline float half_area(const LaneBox& box, __m128 scale) {
  const __m128 terms = area_terms(box, scale);
  return _mm_cvtss_f32(sum_terms(terms, terms, terms, terms));
}

// In how many runs of 2^run_log2 so many primitives are met.
inline __m128 runs_of(__m128i count, int run_log2) {
  const __m128i rounded = _mm_add_epi32(count, _mm_set1_epi32((1 << run_log2) - 1));
  return _mm_cvtepi32_ps(_mm_srl_epi32(rounded, _mm_cvtsi32_si128(run_log2)));
}

inline float runs_of(std::size_t count, int run_log2) {
  return static_cast<float>((count + (std::size_t{1} << run_log2) - 1) >> run_log2);
}

inline __m128 select(__m128 mask, __m128 yes, __m128 no) {
  return _mm_or_ps(_mm_and_ps(mask, yes), _mm_andnot_ps(mask, no));
}

inline __m128i select(__m128i mask, __m128i yes, __m128i no) {
  return _mm_or_si128(_mm_and_si128(mask, yes), _mm_andnot_si128(mask, no));
}

} // namespace fastrt
