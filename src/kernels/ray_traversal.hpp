// SPDX-License-Identifier: Apache-2.0
// Rays through the wide tree one by one, for rays that share nothing with their neighbours. A few are under
// way at a time, so that one waits for its node while others go on. All of them meet their nodes before the
// first goes on from there: its branches can hardly be foreseen, and cost least when what they ask is known.
// Only those that come to a leaf or to their end take them.
#pragma once

#include "src/kernels/lone_ray.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Rays under way at a time.
inline constexpr int lone_rays_at_once = 10;

// A ray's place in the tree: the inner node that it meets next, and what waits. Under what waits lies an
// entry that is no child, for the end.
struct LoneSlot {
  LoneRay ray;
  std::uint32_t node;
  Waiting* top;
  MetBoxes boxes;
  Waiting stack[max_tree_stack + wide_children + 1];
};

FASTRT_INLINE void meet_node(const GeometryView& scene, LoneSlot& slot) {
  const WideNode& node = scene.nodes[slot.node];
  slot.top =
      meet_in_order(node, slot.top, slot.boxes, [&](int half) { return meet_boxes(slot.ray, node, half); });
}

FASTRT_INLINE void prefetch_node(const WideNode* node) {
  const char* at = reinterpret_cast<const char*>(node);
  for (int i = 0; i < 4; ++i) __builtin_prefetch(at + 64 * i);
}

// Takes off the stack what waits next, and what lies too far for it to matter.
FASTRT_INLINE Waiting next_waiting(LoneSlot& slot) {
  Waiting entry = 0;
  do entry = *--slot.top;
  while (entry > slot.ray.limit);
  return entry;
}

FASTRT_INLINE void go_to_node(const GeometryView& scene, LoneSlot& slot, std::uint32_t node) {
  slot.node = node;
  prefetch_node(scene.nodes + node);
}

// Meets the leaf that was taken last, and those that wait next, until the slot is at an inner node; false if
// the ray has come to its end.
template <bool any>
FASTRT_INLINE bool meet_leaves(const GeometryView& scene, HitBatch& hits, LoneSlot& slot,
                               std::uint32_t& runs) {
  for (Waiting entry = *slot.top;;) {
    if (child_of(entry) == no_child) return false;
    meet_leaf<any>(scene, hits, slot.ray, child_of(entry), size_of(entry), runs);
    if (any && slot.ray.primitive >= 0) return false;
    entry = next_waiting(slot);
    if (is_leaf(child_of(entry))) continue;
    go_to_node(scene, slot, child_of(entry));
    return true;
  }
}

// Takes what waits next; true if it is a leaf. Which it is can hardly be foreseen, so there is no branch: at
// a leaf the slot stays at its node.
FASTRT_INLINE std::uint32_t take_next(const GeometryView& scene, LoneSlot& slot) {
  slot.top = push_met(scene.nodes + slot.node, slot.boxes, slot.top);
  const std::uint32_t child = child_of(next_waiting(slot)), leaf = child >> 31U;
  go_to_node(scene, slot, child ^ ((child ^ slot.node) & (0U - leaf)));
  return leaf;
}

FASTRT_INLINE void count_tests(HitBatch& hits, std::uint64_t nodes, std::uint64_t primitives) {
  hits.boxes += nodes * wide_children;
  hits.primitives += primitives;
}

// Rays of a batch that are yet to start.
struct LoneQueue {
  const RayBatch& rays;
  HitBatch& hits;
  LoneColumns& columns;
  std::uint32_t start; // the subtree that they go through
  const std::uint8_t* next;
  const std::uint8_t* end; // of their places in the batch
};

// Puts the next ray that reaches an inner node into the slot; false if there is none.
template <bool any>
static bool start_ray(const GeometryView& scene, LoneQueue& queue, LoneSlot& slot,
                      std::uint32_t& runs) noexcept {
  while (queue.next != queue.end) {
    const int i = *queue.next++;
    if ((queue.columns.ready >> i / group_size & 1U) == 0)
      prepare_group(queue.columns, queue.rays, scene.largest_coordinate, i / group_size);
    slot.ray = lone_ray(queue.rays, queue.hits, i);
    copy_ray(queue.columns, i, slot.ray.own);
    no_boxes(slot.boxes);
    slot.stack[0] = make_waiting(no_child, 0.0F, 0);
    slot.stack[1] = make_waiting(queue.start, 0.0F, size_bits);
    slot.top = slot.stack + 1;
    if (!is_leaf(queue.start)) {
      go_to_node(scene, slot, queue.start);
      return true;
    }
    if (meet_leaves<any>(scene, queue.hits, slot, runs)) return true;
    queue.hits.t[i] = slot.ray.t;
    queue.hits.primitive[i] = slot.ray.primitive;
  }
  return false;
}

// A slot that has come to a leaf, or to the end of its ray; false if it takes no more rays.
template <bool any>
FASTRT_INLINE bool go_on(const GeometryView& scene, LoneQueue& queue, LoneSlot& slot, std::uint32_t& runs) {
  if (meet_leaves<any>(scene, queue.hits, slot, runs)) return true;
  queue.hits.t[slot.ray.index] = slot.ray.t;
  queue.hits.primitive[slot.ray.index] = slot.ray.primitive;
  return start_ray<any>(scene, queue, slot, runs);
}

// The rays of the queue, each continuing from what `hits` holds. any: ends at the first hit, whichever it is.
template <bool any>
static void trace_lone_rays(const GeometryView& scene, LoneQueue queue) noexcept {
  LoneSlot memory[lone_rays_at_once];
  LoneSlot* slots[lone_rays_at_once];
  LoneSlot* leaves[lone_rays_at_once];
  std::uint32_t nodes = 0, runs = 0;
  int count = 0;
  for (LoneSlot& slot : memory) {
    if (!start_ray<any>(scene, queue, slot, runs)) break;
    slots[count++] = &slot;
  }
  while (count != 0) {
    nodes += static_cast<std::uint32_t>(count);
    for (int s = 0; s < count; ++s) meet_node(scene, *slots[s]);
    std::uint32_t left = 0, at_leaves = 0;
    for (int s = 0; s < count; ++s) {
      LoneSlot* const slot = slots[s];
      const std::uint32_t leaf = take_next(scene, *slot);
      slots[left] = leaves[at_leaves] = slot;
      at_leaves += leaf;
      left += 1U - leaf;
    }
    for (std::uint32_t s = 0; s < at_leaves; ++s)
      if (go_on<any>(scene, queue, *leaves[s], runs)) slots[left++] = leaves[s];
    count = static_cast<int>(left);
  }
  queue.hits.lone += static_cast<std::uint64_t>(nodes) << 32U | runs;
}

// All rays of a batch, each on its own.
template <bool any>
static void trace_rays_alone(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                             LoneColumns& columns) noexcept {
  std::uint8_t which[batch_size];
  int count = 0;
  for (int i = 0; i < rays.count; i += widest) {
    const PacketM live =
        traceable_lanes(load3<PacketF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i),
                        load3<PacketF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i), rays.count - i) &
        (load<PacketF>(rays.t_min + i) < load<PacketF>(rays.t_max + i));
    for (std::uint32_t bits = to_bits(live); bits != 0; bits &= bits - 1)
      which[count++] = static_cast<std::uint8_t>(i + __builtin_ctz(bits));
  }
  trace_lone_rays<any>(scene, {rays, hits, columns, scene.root, which, which + count});
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
