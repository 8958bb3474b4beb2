// SPDX-License-Identifier: Apache-2.0
// Pairs of a triangle and a group of rays as a list, so that one loop goes through all of them: of loops in
// each other no branch predictor foresees where they end.
#pragma once

#include "src/simd/compress.hpp"
#include "src/trace/ray_batch.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// A triangle of a run and the rays of a group, in one word: the rays below, the group's number and the
// triangle's above.
using MetPair = std::uint32_t;
static_assert(batch_groups == 16 && group_size == 16 && widest <= 16);

FASTRT_INLINE int triangle_of(MetPair pair) { return static_cast<int>(pair >> 20U); }
FASTRT_INLINE int group_of(MetPair pair) { return static_cast<int>(pair >> 16U & 15U); }
FASTRT_INLINE std::uint32_t rays_of(MetPair pair) { return pair & 0xFFFFU; }

// Pairs without rays yet.
#if defined(__AVX2__)

struct PairList {
  alignas(64) std::int32_t pairs[widest * batch_groups + widest];
  int count = 0;
};

template <class Act>
FASTRT_INLINE void for_each_listed(const PairList& list, const Act& act) {
  for (int k = 0; k < list.count; ++k) act(static_cast<MetPair>(list.pairs[k]));
}

// 0, 1, 2 ... above `shift` bits.
FASTRT_INLINE PacketI numbers_above(int shift) {
  alignas(64) std::int32_t numbers[widest];
  for (int i = 0; i < widest; ++i) numbers[i] = i << shift;
  return PacketI::load_aligned(numbers);
}

// Those of a register of pairs that are in `bits`.
FASTRT_INLINE void append_pairs(const PacketI& pairs, std::uint32_t bits, PairList& list) {
  Compressor(bits).store(pairs, list.pairs + list.count);
  list.count += __builtin_popcount(bits);
}

// Triangle i and the groups in `groups`.
FASTRT_INLINE void append_groups(int i, std::uint32_t groups, PairList& list) {
  for (int g = 0; g < batch_groups; g += widest)
    append_pairs(numbers_above(16) | PacketI(i << 20 | g << 16), groups >> g & register_bits, list);
}

#else

// The four triangles' groups, as a bit for each pair.
struct PairList {
  std::uint64_t bits = 0;
};

template <class Act>
FASTRT_INLINE void for_each_listed(const PairList& list, const Act& act) {
  for (std::uint64_t left = list.bits; left != 0; left &= left - 1)
    act(static_cast<MetPair>(__builtin_ctzll(left)) << 16U);
}

FASTRT_INLINE void append_groups(int i, std::uint32_t groups, PairList& list) {
  list.bits |= static_cast<std::uint64_t>(groups) << (i * batch_groups);
}

#endif

} // namespace fastrt::FASTRT_ISA_NAMESPACE
