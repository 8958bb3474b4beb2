// SPDX-License-Identifier: Apache-2.0
// The rays of a beam that reach the children of a node, and the stack that these wait on: nearer ones above
// farther ones. As with lone rays (lone_order.hpp) the order is made without a branch where registers allow.
#pragma once

#include "src/kernels/beam_setup.hpp"
#include "src/kernels/lone_order.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// What waits, and the rays that may reach it, side by side. A push writes up to eight places from the top on.
struct BeamStack {
  alignas(64) Waiting entries[max_tree_stack + wide_children];
  alignas(64) std::uint64_t rays[max_tree_stack + wide_children];
};

// Of a beam's entry: no more than the distance that it was made from, whose lowest bits tell nothing here.
FASTRT_INLINE float near_of(Waiting w) {
  return __builtin_bit_cast(float, static_cast<std::uint32_t>(w >> 32U) & ~size_bits);
}

#if defined(__AVX512DQ__)
class ReachedRays {
public:
  // pairs: bit 4 * child + group.
  [[gnu::always_inline]] inline ReachedRays(std::uint32_t pairs, std::uint64_t rays)
      : rays_(_mm512_maskz_mov_epi16(pairs, _mm512_set1_epi64(static_cast<long long>(rays)))) {}

  // Of the pair in `pair`, one bit, only the rays in `reached` are left.
  [[gnu::always_inline]] inline void narrow(std::uint32_t pair, std::uint32_t reached) {
    rays_ = _mm512_andnot_si512(_mm512_maskz_set1_epi16(pair, static_cast<short>(~reached)), rays_);
  }

  // Puts the children that are reached onto the stack; returns the new top.
  [[gnu::always_inline]] inline int push(const WideNode& node, const float (&near)[wide_children],
                                         BeamStack& stack, int top) const {
    const __mmask8 reached = _mm512_test_epi64_mask(rays_, rays_);
    const int count = __builtin_popcount(reached);
    const __m512i entries = _mm512_maskz_compress_epi64(reached, entries_of(node, near));
    if (__builtin_expect(count <= 4, 1)) {
      const __m256i sorted = sort_lanes(_mm512_castsi512_si256(entries));
      const __m512i places = _mm512_castsi256_si512(_mm256_srli_epi64(sorted, 32));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.entries + top), sorted);
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.rays + top),
                          _mm512_castsi512_si256(_mm512_permutexvar_epi64(places, rays_)));
    } else {
      const __m512i sorted = sort_lanes(entries);
      _mm512_storeu_si512(stack.entries + top, sorted);
      _mm512_storeu_si512(stack.rays + top, _mm512_permutexvar_epi64(_mm512_srli_epi64(sorted, 32), rays_));
    }
    return top + count;
  }

private:
  // All children as entries, each with its place in the node among the bits that tell nothing.
  [[gnu::always_inline]] static inline __m512i entries_of(const WideNode& node,
                                                          const float (&near)[wide_children]) {
    const __m256i child = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
    const __m256i distance = _mm256_castps_si256(_mm256_load_ps(near));
    const __m256i places = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    constexpr int and_or = 0xEA; // (a & b) | c
    const __m256i above =
        _mm256_ternarylogic_epi32(distance, _mm256_set1_epi32(static_cast<int>(~size_bits)), places, and_or);
    const __m512i in_turn = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    return _mm512_permutex2var_epi32(_mm512_castsi256_si512(child), in_turn, _mm512_castsi256_si512(above));
  }

  __m512i rays_; // of each child
};
#else
class ReachedRays {
public:
  // pairs: bit 4 * child + group.
  [[gnu::always_inline]] inline ReachedRays(std::uint32_t pairs, std::uint64_t rays) {
    for (std::uint64_t& of_child : rays_) {
      of_child = rays & rays_of_groups(from_bits<beam_groups>(pairs & 15U));
      pairs >>= beam_groups;
    }
  }

  // Of the pair in `pair`, one bit, only the rays in `reached` are left.
  [[gnu::always_inline]] inline void narrow(std::uint32_t pair, std::uint32_t reached) {
    const int at = __builtin_ctz(pair);
    rays_[at / beam_groups] &=
        ~(static_cast<std::uint64_t>(~reached & 0xFFFFU) << at % beam_groups * group_size);
  }

  // Puts the children that are reached onto the stack; returns the new top.
  [[gnu::always_inline]] inline int push(const WideNode& node, const float (&near)[wide_children],
                                         BeamStack& stack, int top) const {
    const int bottom = top;
    for (int i = 0; i < wide_children; ++i) {
      if (rays_[i] == 0) continue;
      const Waiting entry = make_waiting(node.child[i], near[i], 0);
      int place = top++;
      for (; place != bottom && stack.entries[place - 1] < entry; --place) {
        stack.entries[place] = stack.entries[place - 1];
        stack.rays[place] = stack.rays[place - 1];
      }
      stack.entries[place] = entry;
      stack.rays[place] = rays_[i];
    }
    return top;
  }

private:
  std::uint64_t rays_[wide_children];
};
#endif

} // namespace fastrt::FASTRT_ISA_NAMESPACE
