// SPDX-License-Identifier: Apache-2.0
// The wide tree as the kernels see it: plain data, no containers. Kernel files include this; so nothing here
// may have a symbol of its own (see docs/architecture.md, "one object, one ISA").
#pragma once

#include <cstdint>

namespace fastrt {

inline constexpr int wide_children = 8;   // children of a wide node
inline constexpr int block_size = 4;      // primitives of a leaf block
inline constexpr int max_leaf_blocks = 4; // blocks of a leaf
inline constexpr int max_groups = 8;      // groups (kinds of primitive) that a tree can tell apart
inline constexpr int max_tree_depth = 80; // levels; the builder keeps to it
inline constexpr int max_tree_stack = max_tree_depth * (wide_children - 1) + wide_children;
inline constexpr std::uint32_t max_blocks = 1U << 26;

// Eight children, their boxes as columns. An unused child has an inverted box (lower = +inf, upper = -inf)
// and `no_child`. Used children come first, the smallest (by `size`) before the larger ones.
struct alignas(64) WideNode {
  float lower_x[wide_children], upper_x[wide_children];
  float lower_y[wide_children], upper_y[wide_children];
  float lower_z[wide_children], upper_z[wide_children];
  std::uint32_t child[wide_children];
  std::uint32_t size[wide_children]; // the largest side of each box, as box_size() takes it
};

// Sizes are powers of two, no less than the box's largest side, by their exponent: 8 bits.
inline constexpr std::uint32_t size_bits = 0xFFU;

// A child is an inner node (its index) or a leaf: bit 31 set, then 3 bits group, 2 bits blocks - 1, 26 bits
// first block among the blocks of that group.
inline constexpr std::uint32_t leaf_bit = 0x80000000U;
inline constexpr std::uint32_t no_child =
    0xFFFFFFFFU; // of an unused child; never met, since its box is inverted

#define FASTRT_INLINE [[gnu::always_inline]] static inline

FASTRT_INLINE constexpr std::uint32_t make_leaf(std::uint32_t group, std::uint32_t first_block,
                                                std::uint32_t blocks) {
  return leaf_bit | group << 28U | (blocks - 1U) << 26U | first_block;
}
FASTRT_INLINE std::uint32_t size_exponent(float side) {
  return (__builtin_bit_cast(std::uint32_t, side) + 0x7FFFFFU) >> 23U;
}
FASTRT_INLINE float box_size(std::uint32_t exponent) { return __builtin_bit_cast(float, exponent << 23U); }
FASTRT_INLINE constexpr bool is_leaf(std::uint32_t child) { return (child & leaf_bit) != 0; }
FASTRT_INLINE constexpr std::uint32_t leaf_group(std::uint32_t leaf) { return leaf >> 28U & 7U; }
FASTRT_INLINE constexpr std::uint32_t leaf_blocks(std::uint32_t leaf) { return (leaf >> 26U & 3U) + 1U; }
FASTRT_INLINE constexpr std::uint32_t leaf_first_block(std::uint32_t leaf) { return leaf & 0x3FFFFFFU; }

} // namespace fastrt
