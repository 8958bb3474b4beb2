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
#if defined(__AVX512DQ__)
inline constexpr int lone_rays_at_once = 32;
inline constexpr std::uint32_t lone_nodes_at_once = 12, lone_leaves_at_once = 12;
#else
inline constexpr int lone_rays_at_once = 24;
inline constexpr std::uint32_t lone_nodes_at_once = 8, lone_leaves_at_once = 8;
#endif

// Under what waits lie entries that are no children, for the end: as many as are looked at together.
struct LoneSlot {
  LoneRay ray;
  Waiting next;         // the node or leaf that it meets next
  Waiting* top;         // above what waits
  std::uint32_t around; // triangles of the leaf that are left to test (bits)
#if !defined(__AVX2__)
  MetBoxes boxes; // of the node
#endif
  Waiting stack[waiting_at_once + most_later + max_tree_stack + wide_children];
};

enum LonePlace : std::uint32_t { at_node, at_leaf, at_end, lone_places };

// Lines of the cache that a node takes, and most of two blocks. To ask for more of these was not worth it.
inline constexpr std::uintptr_t lines_ahead = 4;

// What a child refers to, nodes or the blocks of a group of leaves: the bits above its place among these and
// a leaf's number of blocks.
FASTRT_INLINE constexpr std::uint64_t part_of(std::uint64_t child) { return child >> 28U; }

class LoneLines {
public:
  explicit LoneLines(const GeometryView& scene) {
    for (Part& part : parts_) part = make_part(scene.nodes, 0);
    parts_[part_of(0)] = make_part(scene.nodes, sizeof(WideNode));
    parts_[part_of(make_leaf(triangle_group, 0, 1))] = make_part(scene.triangles, sizeof(TriangleBlock));
    parts_[part_of(make_leaf(sphere_group, 0, 1))] = make_part(scene.spheres, sizeof(SphereBlock));
    parts_[part_of(make_leaf(shape_group, 0, 1))] = make_part(scene.shape_blocks, sizeof(ShapeBlock));
  }
  LoneLines(const LoneLines&) = delete;
  LoneLines& operator=(const LoneLines&) = delete;

  [[gnu::always_inline]] inline std::uint32_t count(LonePlace place) const {
    return static_cast<std::uint32_t>(tail_[place] - head_[place]);
  }
  // The slot goes to the end of the line for the child that it meets next, which is asked of memory. It is
  // written to all lines, but only that one grows.
  [[gnu::always_inline]] inline void add(LoneSlot& slot, std::uint64_t child) {
    const std::uint64_t not_node = child >> 31U, end = (child + 1U) >> 32U;
    const Part& part = parts_[part_of(child)];
    const std::uintptr_t memory = part.first + (child & (max_blocks - 1)) * part.size;
    for (std::uintptr_t i = 0; i < lines_ahead; ++i)
      __builtin_prefetch(reinterpret_cast<const void*>(memory + 64 * i));
    *tail_[at_node] = *tail_[at_leaf] = *tail_[at_end] = &slot;
    tail_[at_node] += 1U - not_node;
    tail_[at_leaf] += not_node - end;
    tail_[at_end] += end;
  }
  // Those who have stood in the line for longest. They may be looked at until some are taken from it again.
  [[gnu::always_inline]] inline LoneSlot* const* take(LonePlace place, std::uint32_t taken) {
    if (tail_[place] > slots_[place] + (size - lone_rays_at_once)) move_up(place);
    LoneSlot* const* const first = head_[place];
    head_[place] += taken;
    return first;
  }

private:
  static constexpr int size = 3 * lone_rays_at_once;
  static_assert(lone_nodes_at_once + lone_leaves_at_once <= lone_rays_at_once);

  // Where what children refer to lies, one after the other, by part_of().
  struct Part {
    std::uintptr_t first, size;
  };
  static Part make_part(const void* first, std::uintptr_t each) {
    return {reinterpret_cast<std::uintptr_t>(first), each};
  }

  // To the front of the memory, so that there is room behind for all.
  [[gnu::always_inline]] inline void move_up(LonePlace place) {
    LoneSlot** to = slots_[place];
    for (LoneSlot** from = head_[place]; from != tail_[place]; ++from) *to++ = *from;
    head_[place] = slots_[place];
    tail_[place] = to;
  }

  Part parts_[part_of(no_child) + 1];
  LoneSlot* slots_[lone_places][size + 1];
  LoneSlot** head_[lone_places] = {slots_[at_node], slots_[at_leaf], slots_[at_end]};
  LoneSlot** tail_[lone_places] = {slots_[at_node], slots_[at_leaf], slots_[at_end]};
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
FASTRT_INLINE void line_up(LoneLines& lines, LoneSlot& slot, Waiting next) {
  slot.next = next;
  lines.add(slot, child_of(next));
}

FASTRT_INLINE void clear_stack(LoneSlot& slot) {
  slot.top = slot.stack;
  for (int i = 0; i < waiting_at_once; ++i) *slot.top++ = make_waiting(no_child, 0.0F, 0);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
