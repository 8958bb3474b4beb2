// SPDX-License-Identifier: Apache-2.0
// Rays through the wide tree one by one: a ray's lanes are a node's children and a block's primitives. For
// rays that share nothing with their neighbours. A few rays are under way at a time, so that one waits for
// its node while others go on.
#pragma once

#include "src/kernels/shape_leaves.hpp"
#include "src/kernels/sphere.hpp"
#include "src/trace/ray_batch.hpp"

#include <cstddef>

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Children of a node are met all at once where eight lanes exist, else in two halves.
inline constexpr int node_lanes = widest < wide_children ? widest : wide_children;
// Rays under way at a time.
inline constexpr int lone_rays_at_once = 6;

struct StackEntry {
  std::uint32_t child;
  float near;
};

// A ray that is on its way, with the closest hit so far. Plain numbers: a register is filled from memory as
// fast as it is loaded.
struct LoneRay {
  V3<float> origin, dir;
  SlabAxis<float> x, y, z;
  // Where the planes that the ray meets first and last lie among a node's columns, in floats.
  std::ptrdiff_t near_x, near_y, near_z, far_x, far_y, far_z;
  float t_min;
  float t, bound; // the closest hit so far, and how far boxes still matter
  std::int32_t exclude, primitive;
  // Runs of blocks and nodes that it, and others before it in its slot, were held against; side by side.
  alignas(8) std::uint32_t runs;
  std::uint32_t nodes;
};

// A ray's place in the tree: the inner node to be met next, what that found, and what waits.
struct LoneSlot {
  LoneRay ray;
  int index; // in the batch
  std::uint32_t child;
  std::uint32_t met;
  alignas(32) float near[wide_children];
  StackEntry* top;
  StackEntry stack[max_tree_stack];
};

FASTRT_INLINE void shorten(LoneRay& ray, float t, std::int32_t primitive) {
  ray.t = t;
  ray.bound = depth_bound(t);
  ray.primitive = primitive;
}

// Not finite or without direction: hits nothing.
FASTRT_INLINE bool is_traceable(float ox, float oy, float oz, float dx, float dy, float dz) {
  const float sum = ((__builtin_fabsf(ox) + __builtin_fabsf(oy)) + __builtin_fabsf(oz)) * 0.0F;
  const float length = (__builtin_fabsf(dx) + __builtin_fabsf(dy)) + __builtin_fabsf(dz);
  return sum == 0.0F && length > 0.0F && length < __builtin_inff();
}

FASTRT_INLINE SlabAxis<float> lone_axis(float origin, float dir, float padding) {
  const float pad = __builtin_copysignf(padding, dir);
  return {origin + pad, origin - pad, 1.0F / dir};
}

FASTRT_INLINE float largest_of(float x, float y, float z) {
  const float a = __builtin_fabsf(x), b = __builtin_fabsf(y), c = __builtin_fabsf(z);
  const float bc = b > c ? b : c;
  return a > bc ? a : bc;
}

FASTRT_INLINE void order_planes(float dir, int axis, std::ptrdiff_t& near, std::ptrdiff_t& far) {
  const std::ptrdiff_t lower = 2 * axis * wide_children, upper = lower + wide_children;
  const bool backwards = __builtin_signbitf(dir) != 0;
  near = backwards ? upper : lower;
  far = backwards ? lower : upper;
}

FASTRT_INLINE void load_lone_ray(const GeometryView& scene, const RayBatch& rays, const HitBatch& hits, int i,
                                 LoneRay& ray) {
  ray.origin = {rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]};
  ray.dir = {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]};
  const float origin = largest_of(ray.origin.x, ray.origin.y, ray.origin.z);
  const float padding = box_padding * (origin > scene.largest_coordinate ? origin : scene.largest_coordinate);
  ray.x = lone_axis(ray.origin.x, ray.dir.x, padding);
  ray.y = lone_axis(ray.origin.y, ray.dir.y, padding);
  ray.z = lone_axis(ray.origin.z, ray.dir.z, padding);
  order_planes(ray.dir.x, 0, ray.near_x, ray.far_x);
  order_planes(ray.dir.y, 1, ray.near_y, ray.far_y);
  order_planes(ray.dir.z, 2, ray.near_z, ray.far_z);
  ray.t_min = rays.t_min[i];
  ray.exclude = rays.exclude[i];
  shorten(ray, hits.t[i], hits.primitive[i]);
}

// Keeps the best of the lanes in `hit` (bits) if it beats what the ray has. Smallest t first, then smallest
// id.
template <class Block>
FASTRT_INLINE void keep_closest(LoneRay& ray, std::uint32_t hit, const LeafF& t, const BlockRun<Block>& run) {
  alignas(32) float lanes[leaf_lanes];
  t.store_aligned(lanes);
  for (; hit != 0; hit &= hit - 1) {
    const int lane = __builtin_ctz(hit);
    const std::int32_t id = run.primitive(lane);
    if (id == ray.exclude) continue;
    if (lanes[lane] < ray.t || (lanes[lane] == ray.t && id < ray.primitive)) shorten(ray, lanes[lane], id);
  }
}

FASTRT_INLINE V3<LeafF> spread(const V3<float>& v) { return {LeafF(v.x), LeafF(v.y), LeafF(v.z)}; }

FASTRT_INLINE void meet_run(LoneRay& ray, const BlockRun<TriangleBlock>& run) {
  const V3<LeafF> origin = spread(ray.origin);
  const V3<LeafF> a = load_vertices(run, 0) - origin, b = load_vertices(run, 1) - origin,
                  c = load_vertices(run, 2) - origin;
  const TriangleLanes<LeafF> lanes = intersect_triangle(set_up_triangle(a, b, c), spread(ray.dir),
                                                        [&] { return reach_of(a, b, c, largest(origin)); });
  const std::uint32_t hit = to_bits(lanes.inside & (lanes.t > LeafF(ray.t_min)) & (lanes.t <= LeafF(ray.t)));
  if (hit != 0) keep_closest(ray, hit, lanes.t, run);
}

FASTRT_INLINE void meet_run(LoneRay& ray, const BlockRun<SphereBlock>& run) {
  const SphereLanes<LeafF> lanes =
      intersect_sphere(load_centers(run), load_two<LeafF>(run.low->radius, run.high->radius),
                       spread(ray.origin), spread(ray.dir), LeafF(ray.t_min));
  const std::uint32_t hit = to_bits(lanes.hit & (lanes.t <= LeafF(ray.t)));
  if (hit != 0) keep_closest(ray, hit, lanes.t, run);
}

// Rays of a batch that are yet to start.
struct LoneQueue {
  const RayBatch& rays;
  HitBatch& hits;
  std::uint32_t start; // the subtree that they go through
  const std::uint8_t* next;
  const std::uint8_t* end; // of their places in the batch
};

template <bool any>
FASTRT_INLINE void meet_leaf(const GeometryView& scene, const LoneQueue& queue, int i, LoneRay& ray,
                             std::uint32_t leaf) {
  const auto meet = [&](const auto& run) {
    ++ray.runs;
    meet_run(ray, run);
  };
  if (leaf_group(leaf) == triangle_group)
    for_each_run(scene.triangles, leaf, meet);
  else if (leaf_group(leaf) == sphere_group)
    for_each_run(scene.spheres, leaf, meet);
  else
    meet_shapes<any>(scene, queue.rays, queue.hits, i, ray, leaf);
}

FASTRT_INLINE SlabAxis<Floats<node_lanes>> spread_axis(const SlabAxis<float>& axis) {
  using N = Floats<node_lanes>;
  return {N(axis.near_origin), N(axis.far_origin), N(axis.inverse)};
}

// The slot's node: which children the ray meets, and where.
FASTRT_INLINE void meet_node(const GeometryView& scene, LoneSlot& slot) {
  using N = Floats<node_lanes>;
  const LoneRay& ray = slot.ray;
  const float* columns = scene.nodes[slot.child].lower_x; // the six columns lie one after the other
  const SlabAxis<N> x = spread_axis(ray.x), y = spread_axis(ray.y), z = spread_axis(ray.z);
  std::uint32_t met = 0;
  for (int half = 0; half < wide_children; half += node_lanes) {
    const float* c = columns + half;
    const V3<N> near_planes = load3<N>(c + ray.near_x, c + ray.near_y, c + ray.near_z);
    const V3<N> far_planes = load3<N>(c + ray.far_x, c + ray.far_y, c + ray.far_z);
    const SlabLanes<N> slab = intersect_slabs(x, y, z, near_planes, far_planes, N(ray.t_min), N(ray.bound));
    slab.near.store_aligned(slot.near + half);
    met |= to_bits(slab.near <= slab.far) << half;
  }
  slot.met = met;
}

// Goes to the nearest of the children that were met; the others wait, nearer ones above farther ones.
FASTRT_INLINE void descend(const WideNode& node, LoneSlot& slot) {
  std::uint32_t bits = slot.met;
  const auto next = [&] {
    const int i = __builtin_ctz(bits);
    bits &= bits - 1;
    return StackEntry{node.child[i], slot.near[i]};
  };
  StackEntry nearest = next();
  StackEntry* const bottom = slot.top;
  while (bits != 0) {
    StackEntry entry = next();
    if (entry.near < nearest.near) {
      const StackEntry swapped = nearest;
      nearest = entry;
      entry = swapped;
    }
    StackEntry* place = slot.top++;
    for (; place != bottom && place[-1].near < entry.near; --place) *place = place[-1];
    *place = entry;
  }
  slot.child = nearest.child;
}

// Takes what waits on top; false if nothing does that still matters.
FASTRT_INLINE bool take_waiting(LoneSlot& slot) {
  while (slot.top != slot.stack) {
    const StackEntry entry = *--slot.top;
    if (entry.near > slot.ray.bound) continue;
    slot.child = entry.child;
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
FASTRT_INLINE bool reach_node(const GeometryView& scene, const LoneQueue& queue, LoneSlot& slot) {
  while (is_leaf(slot.child)) {
    meet_leaf<any>(scene, queue, slot.index, slot.ray, slot.child);
    if (any && slot.ray.primitive >= 0) return false;
    if (!take_waiting(slot)) return false;
  }
  prefetch_node(scene.nodes + slot.child);
  ++slot.ray.nodes;
  return true;
}

// A slot that takes no more rays: all that it counted, in one addition.
FASTRT_INLINE void retire(HitBatch& hits, const LoneSlot& slot) {
  std::uint64_t counts;
  __builtin_memcpy(&counts, &slot.ray.runs, sizeof counts);
  hits.lone += counts;
}

FASTRT_INLINE void count_tests(HitBatch& hits, std::uint64_t nodes, std::uint64_t primitives) {
  hits.boxes += nodes * wide_children;
  hits.primitives += primitives;
}

// Puts the next ray that reaches an inner node into the slot; false if there is none.
template <bool any>
static bool start_ray(const GeometryView& scene, LoneQueue& queue, LoneSlot& slot) noexcept {
  while (queue.next != queue.end) {
    const int i = *queue.next++;
    load_lone_ray(scene, queue.rays, queue.hits, i, slot.ray);
    slot.index = i;
    slot.child = queue.start;
    slot.top = slot.stack;
    if (reach_node<any>(scene, queue, slot)) return true;
    queue.hits.t[i] = slot.ray.t;
    queue.hits.primitive[i] = slot.ray.primitive;
  }
  return false;
}

// One step of a slot whose node has been met; false if its ray has come to its end.
template <bool any>
static bool go_on(const GeometryView& scene, const LoneQueue& queue, LoneSlot& slot) noexcept {
  if (slot.met != 0)
    descend(scene.nodes[slot.child], slot);
  else if (!take_waiting(slot))
    return false;
  return reach_node<any>(scene, queue, slot);
}

// The rays of the queue, each continuing from what `hits` holds. any: ends at the first hit, whichever it is.
template <bool any>
static void trace_lone_rays(const GeometryView& scene, LoneQueue queue) noexcept {
  LoneSlot memory[lone_rays_at_once];
  LoneSlot* slots[lone_rays_at_once];
  int count = 0;
  for (LoneSlot& slot : memory) {
    slot.ray.runs = slot.ray.nodes = 0;
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
      if (!go_on<any>(scene, queue, slot)) {
        queue.hits.t[slot.index] = slot.ray.t;
        queue.hits.primitive[slot.index] = slot.ray.primitive;
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
static void trace_rays_alone(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  std::uint8_t which[batch_size];
  int count = 0;
  for (int i = 0; i < rays.count; ++i) {
    which[count] = static_cast<std::uint8_t>(i);
    count +=
        rays.t_min[i] < rays.t_max[i] && is_traceable(rays.origin_x[i], rays.origin_y[i], rays.origin_z[i],
                                                      rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
  }
  trace_lone_rays<any>(scene, {rays, hits, scene.root, which, which + count});
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
