// SPDX-License-Identifier: Apache-2.0
// Rays through the wide tree one by one, for rays that share nothing with their neighbours. Some are under
// way at a time, so that one waits for its node while others go on, and those that meet nodes, and those that
// meet leaves, do so a fixed number at a time, step by step: hardly a branch is left that depends on a ray.
#pragma once

#include "src/kernels/lone_lines.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

FASTRT_INLINE void meet_node(const GeometryView& scene, const LoneSlot& slot, MetBoxes& boxes) {
  const WideNode& node = scene.nodes[child_of(slot.next)];
  const auto meet = [&](int half) { return meet_boxes(slot.ray, node, half); };
  find_met(node, meet, boxes);
}

FASTRT_INLINE void push_children(const GeometryView& scene, const MetBoxes& boxes, LoneSlot& slot) {
  slot.top = push_in_order(scene.nodes[child_of(slot.next)], boxes, slot.top);
}

// The first of the line of those at nodes. All meet their boxes before the first goes on from there: what
// comes next waits for what the boxes give. So does their order: where that takes no branches, the next ray
// meets its boxes between the two.
FASTRT_INLINE void meet_nodes(const GeometryView& scene, LoneLines& lines, std::uint32_t count) {
  if (count == 0) return;
  LoneSlot* const* const slots = lines.take(at_node, count);
#if defined(__AVX2__)
  MetBoxes boxes, next;
  meet_node(scene, *slots[0], boxes);
  for (std::uint32_t i = 1; i < count; ++i) {
    meet_node(scene, *slots[i], next);
    push_children(scene, boxes, *slots[i - 1]);
    boxes = next;
  }
  push_children(scene, boxes, *slots[count - 1]);
  for (std::uint32_t i = 0; i < count; ++i) line_up(lines, *slots[i], next_waiting(*slots[i]));
#else
  for (std::uint32_t i = 0; i < count; ++i) meet_node(scene, *slots[i], slots[i]->boxes);
  for (std::uint32_t i = 0; i < count; ++i) {
    push_children(scene, slots[i]->boxes, *slots[i]);
    line_up(lines, *slots[i], next_waiting(*slots[i]));
  }
#endif
}

// Sieves the triangles of a leaf's first run. The other runs wait as a leaf of their own.
FASTRT_INLINE void sieve_run(const GeometryView& scene, LoneSlot& slot) {
  const std::uint32_t leaf = child_of(slot.next);
  slot.around = triangles_around(slot.ray, first_run(scene.triangles, leaf), size_of(slot.next));
  *slot.top = slot.next + blocks_at_once - (blocks_at_once << 26U);
  slot.top += leaf_blocks(leaf) > blocks_at_once ? 1 : 0;
}

// The first of the line of those at leaves. few: what waits for them may have been put there just now.
template <bool any, bool few>
FASTRT_INLINE void meet_leaves(const GeometryView& scene, HitBatch& hits, LoneLines& lines,
                               std::uint32_t count, std::uint32_t& runs) {
  LoneSlot* const* const slots = lines.take(at_leaf, count);
  LoneSlot* tests[lone_rays_at_once];
  std::uint32_t test_count = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    LoneSlot& slot = *slots[i];
    tests[test_count] = &slot;
    if (leaf_group(child_of(slot.next)) != triangle_group) {
      meet_other_leaf<any>(scene, hits, slot.ray, child_of(slot.next), runs);
      continue;
    }
    ++runs;
    sieve_run(scene, slot);
    test_count += slot.around != 0 ? 1U : 0U;
  }
  for (std::uint32_t i = 0; i < test_count; ++i)
    meet_triangles(tests[i]->ray, first_run(scene.triangles, child_of(tests[i]->next)), tests[i]->around);
  for (std::uint32_t i = 0; i < count; ++i) {
    LoneSlot& slot = *slots[i];
    if (any && slot.ray.primitive >= 0) clear_stack(slot);
    line_up(lines, slot, few ? next_waiting(slot) : next_of_old(slot));
  }
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
  std::uint32_t start; // the subtree that they go through ..
  LoneLater* later;    // .. unless this holds subtrees of each
  const std::uint8_t* next;
  const std::uint8_t* end; // of their places in the batch
};

// What was put off for the slot's ray, and the first of it.
template <bool any>
[[gnu::noinline]] static Waiting next_of_later(LoneLater& later, LoneSlot& slot) noexcept {
  slot.top = take_up(later, slot.ray.index, slot.top);
  if (any && slot.ray.primitive >= 0) clear_stack(slot);
  return next_waiting(slot);
}

template <bool any>
FASTRT_INLINE void start_ray(const GeometryView& scene, LoneQueue& queue, LoneLines& lines, LoneSlot& slot) {
  const int i = *queue.next++;
  if ((queue.columns.ready >> i / group_size & 1U) == 0)
    prepare_group(queue.columns, queue.rays, scene.largest_coordinate, i / group_size);
  slot.ray = lone_ray(queue.rays, queue.hits, i);
  copy_ray(queue.columns, i, slot.ray.own);
  clear_stack(slot);
  line_up(lines, slot,
          __builtin_expect(queue.later != nullptr, 0) ? next_of_later<any>(*queue.later, slot)
                                                      : make_waiting(queue.start, 0.0F, size_bits));
}

FASTRT_INLINE void end_ray(HitBatch& hits, const LoneSlot& slot) {
  hits.t[slot.ray.index] = slot.ray.t;
  hits.primitive[slot.ray.index] = slot.ray.primitive;
}

// The rays of the queue, each continuing from what `hits` holds. any: ends at the first hit, whichever it is.
template <bool any>
static void trace_lone_rays(const GeometryView& scene, LoneQueue queue) noexcept {
  LoneSlot memory[lone_rays_at_once];
  LoneLines lines(scene);
  std::uint32_t nodes = 0, runs = 0;
  for (int s = 0; s < lone_rays_at_once && queue.next != queue.end; ++s)
    start_ray<any>(scene, queue, lines, memory[s]);
  for (;;) {
    if (lines.count(at_node) >= lone_nodes_at_once) {
      nodes += lone_nodes_at_once;
      meet_nodes(scene, lines, lone_nodes_at_once);
    } else if (lines.count(at_leaf) >= lone_leaves_at_once) {
      meet_leaves<any, false>(scene, queue.hits, lines, lone_leaves_at_once, runs);
    } else if (queue.next != queue.end) {
      for (std::uint32_t left = lines.count(at_end); left != 0 && queue.next != queue.end; --left) {
        LoneSlot& slot = **lines.take(at_end, 1);
        end_ray(queue.hits, slot);
        start_ray<any>(scene, queue, lines, slot);
      }
    } else { // the last ones
      const std::uint32_t nodes_left = lines.count(at_node), leaves_left = lines.count(at_leaf);
      if (nodes_left + leaves_left == 0) break;
      nodes += nodes_left;
      meet_nodes(scene, lines, nodes_left);
      meet_leaves<any, true>(scene, queue.hits, lines, leaves_left, runs);
    }
  }
  while (lines.count(at_end) != 0) end_ray(queue.hits, **lines.take(at_end, 1));
  queue.hits.lone += static_cast<std::uint64_t>(nodes) << 32U | runs;
}

// What was put off.
template <bool any>
static void trace_later(const GeometryView& scene, const RayBatch& rays, HitBatch& hits, LoneColumns& columns,
                        LoneLater& later) noexcept {
  if (later.count == 0) return;
  trace_lone_rays<any>(scene, {rays, hits, columns, no_child, &later, later.rays, later.rays + later.count});
  later.count = 0;
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
  trace_lone_rays<any>(scene, {rays, hits, columns, scene.root, nullptr, which, which + count});
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
