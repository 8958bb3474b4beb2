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

// All children as entries of the stack.
FASTRT_INLINE __m512i entries_of(const WideNode& node, const Floats<8>& near) {
  const __m256i child = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
  const __m256i size = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.size));
  constexpr int and_or = 0xEA; // (a & b) | c
  const __m256i above = _mm256_ternarylogic_epi32(
      _mm256_castps_si256(near.data), _mm256_set1_epi32(static_cast<int>(~size_bits)), size, and_or);
  const __m512i in_turn = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  return _mm512_permutex2var_epi32(_mm512_castsi256_si512(child), in_turn, _mm512_castsi256_si512(above));
}

// The entries of the boxes that were met, in no order, and how many they are.
struct MetBoxes {
  __m512i entries;
  int count;
};

template <class Meet>
FASTRT_INLINE void find_met(const WideNode& node, const Meet& meet, MetBoxes& boxes) {
  const BoxLanes lanes = meet(0);
  const std::uint32_t met = to_bits(lanes.met);
  boxes.entries = _mm512_maskz_compress_epi64(static_cast<__mmask8>(met), entries_of(node, lanes.near));
  boxes.count = __builtin_popcount(met);
}

FASTRT_INLINE Waiting* push_in_order(const WideNode&, const MetBoxes& boxes, Waiting* top) {
  if (__builtin_expect(boxes.count <= 4, 1))
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(top), sort_lanes(_mm512_castsi512_si256(boxes.entries)));
  else
    _mm512_storeu_si512(top, sort_lanes(boxes.entries));
  return top + boxes.count;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
