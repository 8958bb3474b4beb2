// SPDX-License-Identifier: Apache-2.0
// A child that waits on the stack of a ray that goes alone: its reference below, the distance to its box
// above, the lowest bits of which hold the size of the box. As numbers such entries are in the order of their
// distances; negative distances count as the farthest.
#pragma once

#include "src/accel/wide_node.hpp"
#include "src/simd/lanes.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

using Waiting = std::uint64_t;

FASTRT_INLINE Waiting make_waiting(std::uint32_t child, float near, std::uint32_t size) {
  const std::uint32_t distance = __builtin_bit_cast(std::uint32_t, near) & ~size_bits;
  return static_cast<Waiting>(distance | size) << 32U | child;
}
FASTRT_INLINE std::uint32_t child_of(Waiting w) { return static_cast<std::uint32_t>(w); }
FASTRT_INLINE float size_of(Waiting w) { return box_size(static_cast<std::uint32_t>(w >> 32U) & size_bits); }

// Greater entries no longer matter to a ray that looks no farther than `bound`. For a ray that begins behind
// its origin all of them do.
FASTRT_INLINE Waiting waiting_limit(float bound, float t_min) {
  if ((__builtin_bit_cast(std::uint32_t, t_min) >> 31U) != 0) return ~Waiting{0}; // -0 as well
  return static_cast<Waiting>(__builtin_bit_cast(std::uint32_t, bound) | size_bits) << 32U | 0xFFFFFFFFU;
}

// Entries that are looked at together where lanes are enough, and which of them (bits) are no greater than
// `limit`.
inline constexpr int waiting_at_once = 4;
#if defined(__AVX2__)
FASTRT_INLINE std::uint32_t bits_within(const Waiting* entries, Waiting limit) {
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entries));
#if defined(__AVX512VL__)
  return _mm256_cmple_epu64_mask(all, _mm256_set1_epi64x(static_cast<long long>(limit)));
#else
  const __m256i sign = _mm256_set1_epi64x(static_cast<long long>(Waiting{1} << 63U));
  const __m256i most = _mm256_set1_epi64x(static_cast<long long>(limit ^ Waiting{1} << 63U));
  const __m256i beyond = _mm256_cmpgt_epi64(_mm256_xor_si256(all, sign), most);
  return ~static_cast<std::uint32_t>(_mm256_movemask_pd(_mm256_castsi256_pd(beyond))) & 15U;
#endif
}
#endif

// Children of a node are met all at once where eight lanes exist, else in two halves.
inline constexpr int node_lanes = widest < wide_children ? widest : wide_children;

// Between where a ray is in boxes; it meets those where near <= far.
struct BoxLanes {
  Floats<node_lanes> near, far;
};

} // namespace fastrt::FASTRT_ISA_NAMESPACE
