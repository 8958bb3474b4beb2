// SPDX-License-Identifier: Apache-2.0
#include "src/write/png_filter.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace fastrt {

namespace {

constexpr std::size_t pixel = 3; // bytes

enum Filter : unsigned char { sub = 1, up = 2, paeth = 4 };

constexpr std::size_t block_size = 16;

// At most sixteen bytes; zeros behind them.
__m128i load(const unsigned char* bytes, std::size_t count) {
  __m128i block = _mm_setzero_si128();
  std::memcpy(&block, bytes, count);
  return block;
}

__m128i pick(__m128i mask, __m128i yes, __m128i no) {
  return _mm_or_si128(_mm_and_si128(mask, yes), _mm_andnot_si128(mask, no));
}
__m128i difference(__m128i a, __m128i b) { return _mm_or_si128(_mm_subs_epu8(a, b), _mm_subs_epu8(b, a)); }
__m128i not_greater(__m128i a, __m128i b) { return _mm_cmpeq_epi8(_mm_min_epu8(a, b), a); }

__m128i left_of(__m128i left, __m128i, __m128i) { return left; }
__m128i above_of(__m128i, __m128i above, __m128i) { return above; }

// The one of the three that is closest to left + above - corner.
__m128i closest_of(__m128i left, __m128i above, __m128i corner) {
  const __m128i to_left = difference(above, corner), to_above = difference(left, corner);
  // Both differences with their signs make the third.
  const __m128i same_sign = _mm_cmpeq_epi8(not_greater(above, corner), not_greater(left, corner));
  const __m128i to_corner = pick(same_sign, _mm_adds_epu8(to_left, to_above), difference(to_left, to_above));
  const __m128i others = _mm_min_epu8(to_above, to_corner);
  return pick(not_greater(to_left, others), left, pick(not_greater(to_above, to_corner), above, corner));
}

// Writes what is left of a row without its prediction. Returns the sum of the sizes of that.
template <class Predict>
std::uint64_t filter(const unsigned char* row, const unsigned char* above, std::size_t count,
                     unsigned char* out, const Predict& predict) {
  const __m128i zero = _mm_setzero_si128();
  __m128i sum = zero; // of eight bytes each
  const auto filter_block = [&](std::size_t i, std::size_t bytes) {
    const __m128i prediction =
        predict(load(row + i - pixel, bytes), load(above + i, bytes), load(above + i - pixel, bytes));
    const __m128i rest = _mm_sub_epi8(load(row + i, bytes), prediction);
    std::memcpy(out + i, &rest, bytes);
    sum = _mm_add_epi64(sum, _mm_sad_epu8(_mm_min_epu8(rest, _mm_sub_epi8(zero, rest)), zero));
  };
  std::size_t i = 0;
  for (; i + block_size <= count; i += block_size) filter_block(i, block_size);
  if (i < count) filter_block(i, count - i);
  return static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_add_epi64(sum, _mm_unpackhi_epi64(sum, sum))));
}

} // namespace

void filter_row(const unsigned char* row, const unsigned char* above, std::size_t count,
                unsigned char* scratch, unsigned char* out) noexcept {
  out[0] = up;
  std::uint64_t best = filter(row, above, count, out + 1, above_of);
  const auto keep_if_smaller = [&](std::uint64_t size, Filter filter) {
    if (size >= best) return;
    best = size;
    out[0] = filter;
    std::copy_n(scratch, count, out + 1);
  };
  if (best == 0) return;
  keep_if_smaller(filter(row, above, count, scratch, left_of), sub);
  if (best == 0) return;
  keep_if_smaller(filter(row, above, count, scratch, closest_of), paeth);
}

} // namespace fastrt
