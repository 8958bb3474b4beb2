// SPDX-License-Identifier: Apache-2.0
// Rays through the wide tree one by one, for rays that share nothing with their neighbours. A few are under
// way at a time, so that one waits for its node while others go on. All of them meet their nodes before the
// first goes on from there: its branches can hardly be foreseen, and cost least when what they ask is known.
#pragma once

#include "src/kernels/lone_ray.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Rays under way at a time.
inline constexpr int lone_rays_at_once = 10;

// A child that waits: its reference below, the distance to its box above, the lowest bits of which hold the
// size of the box.
using Waiting = std::uint64_t;
FASTRT_INLINE Waiting make_waiting(std::uint32_t child, float near, std::uint32_t size) {
  const std::uint32_t distance = __builtin_bit_cast(std::uint32_t, near) & ~size_bits;
  return static_cast<Waiting>(distance | size) << 32U | child;
}
FASTRT_INLINE std::uint32_t child_of(Waiting w) { return static_cast<std::uint32_t>(w); }
FASTRT_INLINE float near_of(Waiting w) {
  return __builtin_bit_cast(float, static_cast<std::uint32_t>(w >> 32U));
}
FASTRT_INLINE float size_of(Waiting w) { return box_size(static_cast<std::uint32_t>(w >> 32U) & size_bits); }

// A ray's place in the tree: the inner node to be met next, what that found, and what waits.
struct LoneSlot {
  LoneRay ray;
  Waiting next;
  std::uint32_t met;
  alignas(32) float near[wide_children];
  Waiting* top;
  // Runs of blocks and nodes that the slot's rays were held against; side by side.
  alignas(8) std::uint32_t runs;
  std::uint32_t nodes;
  Waiting stack[max_tree_stack];
};

// The slot's node: which children the ray meets, and where.
FASTRT_INLINE void meet_node(const GeometryView& scene, LoneSlot& slot) {
  slot.met = meet_boxes(slot.ray, scene.nodes[child_of(slot.next)], slot.near);
}

// Goes to the nearest of the children that were met; the others wait, nearer ones above farther ones.
FASTRT_INLINE void descend(const WideNode& node, LoneSlot& slot) {
  std::uint32_t bits = slot.met;
  const auto next = [&] {
    const int i = __builtin_ctz(bits);
    bits &= bits - 1;
    return make_waiting(node.child[i], slot.near[i], node.size[i]);
  };
  Waiting nearest = next();
  Waiting* const bottom = slot.top;
  while (bits != 0) {
    Waiting entry = next();
    if (entry < nearest) {
      const Waiting swapped = nearest;
      nearest = entry;
      entry = swapped;
    }
    Waiting* place = slot.top++;
    for (; place != bottom && place[-1] < entry; --place) *place = place[-1];
    *place = entry;
  }
  slot.next = nearest;
}

// Takes what waits on top; false if nothing does that still matters.
FASTRT_INLINE bool take_waiting(LoneSlot& slot) {
  while (slot.top != slot.stack) {
    const Waiting entry = *--slot.top;
    if (near_of(entry) > slot.ray.waiting_bound) continue;
    slot.next = entry;
    return true;
  }
  return false;
}

FASTRT_INLINE void prefetch_node(const WideNode* node) {
  const char* at = reinterpret_cast<const char*>(node);
  for (int i = 0; i < 4; ++i) __builtin_prefetch(at + 64 * i);
}

// Meets leaves until the slot is at an inner node; false if the ray has come to its end.
template <bool any>
FASTRT_INLINE bool reach_node(const GeometryView& scene, HitBatch& hits, LoneSlot& slot) {
  while (is_leaf(child_of(slot.next))) {
    meet_leaf<any>(scene, hits, slot.ray, child_of(slot.next), size_of(slot.next), slot.runs);
    if (any && slot.ray.primitive >= 0) return false;
    if (!take_waiting(slot)) return false;
  }
  prefetch_node(scene.nodes + child_of(slot.next));
  ++slot.nodes;
  return true;
}

// A slot that takes no more rays: all that it counted, in one addition.
FASTRT_INLINE void retire(HitBatch& hits, const LoneSlot& slot) {
  std::uint64_t counts;
  __builtin_memcpy(&counts, &slot.runs, sizeof counts);
  hits.lone += counts;
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
static bool start_ray(const GeometryView& scene, LoneQueue& queue, LoneSlot& slot) noexcept {
  while (queue.next != queue.end) {
    const int i = *queue.next++;
    if ((queue.columns.ready >> i / group_size & 1U) == 0)
      prepare_group(queue.columns, queue.rays, scene.largest_coordinate, i / group_size);
    slot.ray = lone_ray(queue.rays, queue.hits, i);
    copy_ray(queue.columns, i, slot.ray.own);
    slot.next = make_waiting(queue.start, 0.0F, size_bits);
    slot.top = slot.stack;
    if (reach_node<any>(scene, queue.hits, slot)) return true;
    queue.hits.t[i] = slot.ray.t;
    queue.hits.primitive[i] = slot.ray.primitive;
  }
  return false;
}

// One step of a slot whose node has been met; false if its ray has come to its end.
template <bool any>
static bool go_on(const GeometryView& scene, HitBatch& hits, LoneSlot& slot) noexcept {
  if (slot.met != 0)
    descend(scene.nodes[child_of(slot.next)], slot);
  else if (!take_waiting(slot))
    return false;
  return reach_node<any>(scene, hits, slot);
}

// The rays of the queue, each continuing from what `hits` holds. any: ends at the first hit, whichever it is.
template <bool any>
static void trace_lone_rays(const GeometryView& scene, LoneQueue queue) noexcept {
  LoneSlot memory[lone_rays_at_once];
  LoneSlot* slots[lone_rays_at_once];
  int count = 0;
  for (LoneSlot& slot : memory) {
    slot.runs = slot.nodes = 0;
    if (!start_ray<any>(scene, queue, slot)) {
      retire(queue.hits, slot);
      break;
    }
    slots[count++] = &slot;
  }
  while (count != 0) {
    for (int s = 0; s < count; ++s) meet_node(scene, *slots[s]);
    for (int s = 0; s < count;) {
      LoneSlot& slot = *slots[s];
      if (!go_on<any>(scene, queue.hits, slot)) {
        queue.hits.t[slot.ray.index] = slot.ray.t;
        queue.hits.primitive[slot.ray.index] = slot.ray.primitive;
        if (!start_ray<any>(scene, queue, slot)) {
          retire(queue.hits, slot);
          slots[s] = slots[--count];
          slots[count] = &slot;
          if (s == count) break;
          continue;
        }
      }
      ++s;
    }
  }
}

// All rays of a batch, each on its own.
template <bool any>
static void trace_rays_alone(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                             LoneColumns& columns) noexcept {
  std::uint8_t which[batch_size];
  int count = 0;
  for (int i = 0; i < rays.count; ++i) {
    which[count] = static_cast<std::uint8_t>(i);
    count +=
        rays.t_min[i] < rays.t_max[i] && is_traceable(rays.origin_x[i], rays.origin_y[i], rays.origin_z[i],
                                                      rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
  }
  trace_lone_rays<any>(scene, {rays, hits, columns, scene.root, which, which + count});
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
