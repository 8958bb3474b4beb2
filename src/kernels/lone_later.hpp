// SPDX-License-Identifier: Apache-2.0
// Subtrees that rays of a batch are to follow alone, kept until many rays have such: rays that go alone are
// fast where some are under way at a time.
#pragma once

#include "src/kernels/waiting.hpp"
#include "src/trace/ray_batch.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Of one ray, before they must be followed.
inline constexpr int most_later = 16;

struct LoneLater {
  int count; // of rays that have any, and their places in the batch
  std::uint8_t rays[batch_size];
  std::uint8_t subtree_counts[batch_size];
  Waiting subtrees[most_later][batch_size]; // the first is to be followed first
};

FASTRT_INLINE void clear(LoneLater& later) {
  later.count = 0;
  __builtin_memset(later.subtree_counts, 0, sizeof later.subtree_counts);
}

// near: no more than the distance to the subtree's box. Returns whether there is room for another one.
FASTRT_INLINE bool put_off(LoneLater& later, int ray, std::uint32_t subtree, float near) {
  const int n = later.subtree_counts[ray]++;
  if (n == 0) later.rays[later.count++] = static_cast<std::uint8_t>(ray);
  later.subtrees[n][ray] = make_waiting(subtree, near, size_bits);
  return n + 1 < most_later;
}

// Puts what the ray is to follow onto a stack, and forgets it. Returns the new top.
FASTRT_INLINE Waiting* take_up(LoneLater& later, std::ptrdiff_t ray, Waiting* top) {
  int left = later.subtree_counts[ray];
  later.subtree_counts[ray] = 0;
  while (left != 0) *top++ = later.subtrees[--left][ray];
  return top;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
