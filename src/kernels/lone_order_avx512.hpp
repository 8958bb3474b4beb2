// SPDX-License-Identifier: Apache-2.0
// lone_order.hpp for AVX-512: entries of the stack are sorted as they are.
#pragma once

#include "src/kernels/waiting.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Each lane beside that of `others`: the greater stays, in the lanes of `less` (bits) the lesser.
FASTRT_INLINE __m256i order_lanes(__m256i lanes, __m256i others, __mmask8 less) {
  return _mm256_mask_min_epu64(_mm256_max_epu64(lanes, others), less, lanes, others);
}
FASTRT_INLINE __m512i order_lanes(__m512i lanes, __m512i others, __mmask8 less) {
  return _mm512_mask_min_epu64(_mm512_max_epu64(lanes, others), less, lanes, others);
}

// Greatest first; what is 0 goes last.
FASTRT_INLINE __m256i sort_lanes(__m256i w) {
  w = order_lanes(w, _mm256_shuffle_epi32(w, 0x4E), 0b1010);
  w = order_lanes(w, _mm256_permute4x64_epi64(w, 0x1B), 0b1100);
  return order_lanes(w, _mm256_shuffle_epi32(w, 0x4E), 0b1010);
}
FASTRT_INLINE __m512i sort_lanes(__m512i w) {
  w = order_lanes(w, _mm512_shuffle_epi32(w, _MM_PERM_BADC), 0b10101010);
  w = order_lanes(w, _mm512_permutex_epi64(w, 0x1B), 0b11001100);
  w = order_lanes(w, _mm512_shuffle_epi32(w, _MM_PERM_BADC), 0b10101010);
  w = order_lanes(w, _mm512_permutexvar_epi64(_mm512_setr_epi64(7, 6, 5, 4, 3, 2, 1, 0), w), 0b11110000);
  w = order_lanes(w, _mm512_permutex_epi64(w, 0x4E), 0b11001100);
  return order_lanes(w, _mm512_shuffle_epi32(w, _MM_PERM_BADC), 0b10101010);
}

// Of the boxes that were met, in no order: their children, the upper halves of their entries, and how many
// they are.
struct MetBoxes {
  __m256i children, above;
  int count;
};

template <class Meet>
FASTRT_INLINE void find_met(const WideNode& node, const Meet& meet, MetBoxes& boxes) {
  const BoxLanes lanes = meet(0);
  const __mmask8 met = _mm256_cmp_ps_mask(lanes.near.data, lanes.far.data, _CMP_LE_OQ);
  const __m256i child = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
  const __m256i size = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.size));
  constexpr int and_or = 0xEA; // (a & b) | c
  const __m256i above = _mm256_ternarylogic_epi32(
      _mm256_castps_si256(lanes.near.data), _mm256_set1_epi32(static_cast<int>(~size_bits)), size, and_or);
  boxes.children = _mm256_maskz_compress_epi32(met, child);
  boxes.above = _mm256_maskz_compress_epi32(met, above);
  boxes.count = __builtin_popcount(met);
}

// The first four entries, or all eight. (Seldom the latter: while registers of 512 bits are at work, some
// cores do fewer operations at a time.)
FASTRT_INLINE __m256i four_entries(const MetBoxes& boxes) {
  const __m256i in_turn = _mm256_setr_epi32(0, 8, 1, 9, 2, 10, 3, 11);
  return _mm256_permutex2var_epi32(boxes.children, in_turn, boxes.above);
}
FASTRT_INLINE __m512i all_entries(const MetBoxes& boxes) {
  const __m512i in_turn = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  return _mm512_permutex2var_epi32(_mm512_castsi256_si512(boxes.children), in_turn,
                                   _mm512_castsi256_si512(boxes.above));
}

FASTRT_INLINE Waiting* push_in_order(const WideNode&, const MetBoxes& boxes, Waiting* top) {
  if (__builtin_expect(boxes.count <= 4, 1))
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(top), sort_lanes(four_entries(boxes)));
  else
    _mm512_storeu_si512(top, sort_lanes(all_entries(boxes)));
  return top + boxes.count;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
