// SPDX-License-Identifier: Apache-2.0
// Lone rays under way: each has a place in the tree and stands in the line of those that do the same next,
// meet a node, meet a leaf, or end. Which of these is next can hardly be foreseen, so nothing branches on it:
// it says in which line the ray is put.
#pragma once

#include "src/kernels/lone_later.hpp"
#include "src/kernels/lone_ray.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Rays under way at a time, and how many of them meet their nodes, or their leaves, in one go: so many that
// one of the lines is always long enough.
inline constexpr int lone_rays_at_once = 24;
inline constexpr std::uint32_t lone_nodes_at_once = 8, lone_leaves_at_once = 8;

// Under what waits lie entries that are no children, for the end: as many as are looked at together.
struct LoneSlot {
  LoneRay ray;
  Waiting next;         // the node or leaf that it meets next
  Waiting* top;         // above what waits
  std::uint32_t around; // triangles of the leaf that are left to test (bits)
  MetBoxes boxes;
  Waiting stack[waiting_at_once + most_later + max_tree_stack + wide_children];
};

enum LonePlace : std::uint32_t { at_node, at_leaf, at_end, lone_places };

class LoneLines {
public:
  [[gnu::always_inline]] inline std::uint32_t count(LonePlace place) const {
    return tail_[place] - head_[place];
  }
  [[gnu::always_inline]] inline void add(LoneSlot& slot, std::uint32_t place) {
    slots_[place][tail_[place]++ % size] = &slot;
  }
  // Who has stood in the line for longest.
  [[gnu::always_inline]] inline LoneSlot& take(LonePlace place) {
    return *slots_[place][head_[place]++ % size];
  }

private:
  static constexpr std::uint32_t size = 32;
  static_assert(lone_rays_at_once <= static_cast<int>(size) &&
                lone_nodes_at_once + lone_leaves_at_once <= lone_rays_at_once);

  LoneSlot* slots_[lone_places][size];
  std::uint32_t head_[lone_places] = {}, tail_[lone_places] = {};
};

// Takes off the stack what waits next, and what lies too far for it to matter.
FASTRT_INLINE Waiting next_waiting(LoneSlot& slot) {
  Waiting entry = 0;
  do entry = *--slot.top;
  while (entry > slot.ray.limit);
  return entry;
}

// The same where nothing was put there lately (registers are not filled from stores that are under way), a
// few entries at a time: after a hit many lie too far.
FASTRT_INLINE Waiting next_of_old(LoneSlot& slot) {
#if defined(__AVX2__)
  std::uint32_t within = 0;
  do within = bits_within(slot.top -= waiting_at_once, slot.ray.limit);
  while (within == 0);
  slot.top += 31 - __builtin_clz(within);
  return *slot.top;
#else
  return next_waiting(slot);
#endif
}

// Puts the slot in the line for what it meets next.
FASTRT_INLINE void line_up(const GeometryView& scene, LoneLines& lines, LoneSlot& slot, Waiting next) {
  const std::uint32_t child = child_of(next), leaf = child >> 31U;
  slot.next = next;
  const char* const node = reinterpret_cast<const char*>(scene.nodes + (child & (leaf - 1U)));
  for (int i = 0; i < 4; ++i) __builtin_prefetch(node + 64 * i);
  lines.add(slot, leaf + (child == no_child ? 1U : 0U));
}

FASTRT_INLINE void clear_stack(LoneSlot& slot) {
  slot.top = slot.stack;
  for (int i = 0; i < waiting_at_once; ++i) *slot.top++ = make_waiting(no_child, 0.0F, 0);
  no_boxes(slot.boxes);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
