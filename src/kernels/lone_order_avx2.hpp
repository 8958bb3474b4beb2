// SPDX-License-Identifier: Apache-2.0
// lone_order.hpp for AVX2, which can't compare 64 unsigned bits: keys are sorted, and entries follow them.
#pragma once

#include "src/kernels/waiting.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Keys are distances whose lowest bits hold the child's place in its node. Each is compared with the one that
// `swap` puts beside it: the greater stays, in the lanes of `less` (bits) the lesser.
template <int swap, int less>
FASTRT_INLINE __m128i order_keys(__m128i keys) {
  const __m128i others = _mm_shuffle_epi32(keys, swap);
  return _mm_blend_epi32(_mm_max_epu32(keys, others), _mm_min_epu32(keys, others), less);
}
template <int swap, int less>
FASTRT_INLINE __m256i order_keys(__m256i keys) {
  const __m256i others = _mm256_shuffle_epi32(keys, swap);
  return _mm256_blend_epi32(_mm256_max_epu32(keys, others), _mm256_min_epu32(keys, others), less);
}

// Greatest first; what is 0 goes last.
FASTRT_INLINE __m128i sort_keys(__m128i keys) {
  return order_keys<0xB1, 0b1010>(order_keys<0x1B, 0b1100>(order_keys<0xB1, 0b1010>(keys)));
}
FASTRT_INLINE __m256i sort_keys(__m256i keys) {
  keys = order_keys<0xB1, 0b10101010>(order_keys<0x1B, 0b11001100>(order_keys<0xB1, 0b10101010>(keys)));
  const __m256i others = _mm256_permutevar8x32_epi32(keys, _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0));
  keys = _mm256_blend_epi32(_mm256_max_epu32(keys, others), _mm256_min_epu32(keys, others), 0b11110000);
  return order_keys<0xB1, 0b10101010>(order_keys<0x4E, 0b11001100>(keys));
}

// For every set of lanes (bits): these first, then the others; a byte for each.
struct LanesFirst {
  std::uint64_t lanes[256];
  constexpr LanesFirst() : lanes() {
    for (std::uint32_t set = 0; set < 256; ++set) {
      std::uint32_t to = 0;
      for (std::uint32_t wanted : {1U, 0U})
        for (std::uint32_t i = 0; i < 8; ++i)
          if ((set >> i & 1U) == wanted) lanes[set] |= static_cast<std::uint64_t>(i) << (8U * to++);
    }
  }
};
constexpr LanesFirst lanes_first;

// The entries of the children whose places are the lowest bits of `keys`.
FASTRT_INLINE __m256i entries_of(const WideNode& node, __m128i keys) {
  const __m256i child = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
  const __m256i size = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.size));
  const __m256i at = _mm256_castsi128_si256(keys);
  const __m128i below = _mm256_castsi256_si128(_mm256_permutevar8x32_epi32(child, at));
  const __m128i above = _mm_or_si128(_mm_and_si128(keys, _mm_set1_epi32(static_cast<int>(~size_bits))),
                                     _mm256_castsi256_si128(_mm256_permutevar8x32_epi32(size, at)));
  return _mm256_setr_m128i(_mm_unpacklo_epi32(below, above), _mm_unpackhi_epi32(below, above));
}

// Which boxes were met: their keys in their places, and 0 elsewhere; and their places (bits).
struct MetBoxes {
  __m256i keys;
  std::uint32_t met;
};

template <class Meet>
FASTRT_INLINE void find_met(const WideNode&, const Meet& meet, MetBoxes& boxes) {
  const BoxLanes lanes = meet(0);
  const __m256i distance = _mm256_and_si256(_mm256_castps_si256(lanes.near.data), _mm256_set1_epi32(~7));
  const __m256i keys = _mm256_or_si256(distance, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  const Mask<node_lanes> met = lanes.near <= lanes.far;
  boxes.keys = _mm256_and_si256(keys, _mm256_castps_si256(met.data));
  boxes.met = to_bits(met);
}

FASTRT_INLINE Waiting* push_in_order(const WideNode& node, const MetBoxes& boxes, Waiting* top) {
  const __m256i lanes = _mm256_cvtepu8_epi32(_mm_loadu_si64(lanes_first.lanes + boxes.met));
  const __m256i together = _mm256_permutevar8x32_epi32(boxes.keys, lanes);
  const int count = __builtin_popcount(boxes.met);
  const auto to = reinterpret_cast<__m256i*>(top);
  if (__builtin_expect(count <= 4, 1)) {
    _mm256_storeu_si256(to, entries_of(node, sort_keys(_mm256_castsi256_si128(together))));
  } else {
    const __m256i sorted = sort_keys(together);
    _mm256_storeu_si256(to, entries_of(node, _mm256_castsi256_si128(sorted)));
    _mm256_storeu_si256(to + 1, entries_of(node, _mm256_extracti128_si256(sorted, 1)));
  }
  return top + count;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
