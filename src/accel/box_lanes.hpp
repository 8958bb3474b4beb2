// SPDX-License-Identifier: Apache-2.0
// Boxes in SSE2 registers, which every x86-64 has. The fourth lane is nobody's.
#pragma once

#include "src/accel/tree.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <bit>
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

// The half areas of three boxes; the fourth lane is nobody's.
inline __m128 half_areas(const LaneBox (&boxes)[3], __m128 scale) {
  const __m128 a = _mm_sub_ps(boxes[0].upper, boxes[0].lower);
  const __m128 b = _mm_sub_ps(boxes[1].upper, boxes[1].lower);
  const __m128 c = _mm_sub_ps(boxes[2].upper, boxes[2].lower);
  const __m128 xy = _mm_unpacklo_ps(a, b), zw = _mm_unpackhi_ps(a, b);
  const __m128 x = _mm_mul_ps(_mm_movelh_ps(xy, c), scale);
  const __m128 y = _mm_mul_ps(_mm_shuffle_ps(xy, c, _MM_SHUFFLE(1, 1, 3, 2)), scale);
  const __m128 z = _mm_mul_ps(_mm_shuffle_ps(zw, c, _MM_SHUFFLE(2, 2, 1, 0)), scale);
  return _mm_add_ps(_mm_mul_ps(x, _mm_add_ps(y, z)), _mm_mul_ps(y, z));
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

// The least costs of three axes side by side, and where they were found.
class LeastCosts {
public:
  // Costs that are not numbers are never the least.
  void offer(__m128 costs, int place) {
    const __m128i better = _mm_castps_si128(_mm_cmplt_ps(costs, costs_));
    costs_ = _mm_min_ps(costs, costs_);
    places_ = select(better, _mm_set1_epi32(place), places_);
  }
  // The axis of the least cost, or -1 if nothing cost less than infinity. Without branches: axes come in no
  // order that could be foretold.
  int axis() const {
    const __m128 least = _mm_min_ps(_mm_min_ps(lane<0>(costs_), lane<1>(costs_)), lane<2>(costs_));
    const int axes = _mm_movemask_ps(_mm_cmpeq_ps(costs_, least)) & 7;
    return _mm_cvtss_f32(least) < infinity ? std::countr_zero(static_cast<unsigned>(axes)) : -1;
  }
  float cost(int axis) const {
    alignas(16) float costs[4];
    _mm_store_ps(costs, costs_);
    return costs[axis];
  }
  int place(int axis) const {
    alignas(16) int places[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(places), places_);
    return places[axis];
  }

private:
  template <int i>
  static __m128 lane(__m128 values) {
    return _mm_shuffle_ps(values, values, _MM_SHUFFLE(i, i, i, i));
  }

  __m128 costs_ = _mm_set1_ps(infinity);
  __m128i places_ = _mm_setzero_si128();
};

} // namespace fastrt
