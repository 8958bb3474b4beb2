// SPDX-License-Identifier: Apache-2.0
// One ray through the wide tree: its lanes are a node's children and a block's primitives. For rays that
// share nothing with their neighbours.
#pragma once

#include "src/kernels/leaf_lanes.hpp"
#include "src/kernels/slab.hpp"
#include "src/kernels/sphere.hpp"
#include "src/trace/ray_batch.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Children of a node are met all at once where eight lanes exist, else in two halves.
inline constexpr int node_lanes = widest < wide_children ? widest : wide_children;

struct StackEntry {
  std::uint32_t child;
  float near;
};

// A ray that is on its way, with the closest hit so far.
struct LoneRay {
  V3<LeafF> origin, dir; // broadcast over the blocks of a leaf
  SlabAxis<Floats<node_lanes>> x, y, z;
  int near_x, near_y, near_z; // 8 where the ray meets the upper plane first: offset into the node's columns
  float t_min;
  std::int32_t exclude;
  float t;
  std::int32_t primitive;
};

// Not finite or without direction: hits nothing.
FASTRT_INLINE bool is_traceable(float ox, float oy, float oz, float dx, float dy, float dz) {
  const float sum = ((__builtin_fabsf(ox) + __builtin_fabsf(oy)) + __builtin_fabsf(oz)) * 0.0F;
  const float length = (__builtin_fabsf(dx) + __builtin_fabsf(dy)) + __builtin_fabsf(dz);
  return sum == 0.0F && length > 0.0F && length < __builtin_inff();
}

FASTRT_INLINE LoneRay make_lone_ray(const GeometryView& scene, const RayBatch& rays, int i, float t,
                                    std::int32_t primitive) {
  using N = Floats<node_lanes>;
  LoneRay ray;
  ray.origin = broadcast3<LeafF>(rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]);
  ray.dir = broadcast3<LeafF>(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
  const V3<N> origin = broadcast3<N>(rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]);
  const V3<N> dir = broadcast3<N>(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
  const N padding = padding_of(origin, N(scene.largest_coordinate));
  ray.x = slab_axis(origin.x, dir.x, padding);
  ray.y = slab_axis(origin.y, dir.y, padding);
  ray.z = slab_axis(origin.z, dir.z, padding);
  ray.near_x = __builtin_signbitf(rays.dir_x[i]) != 0 ? wide_children : 0;
  ray.near_y = __builtin_signbitf(rays.dir_y[i]) != 0 ? wide_children : 0;
  ray.near_z = __builtin_signbitf(rays.dir_z[i]) != 0 ? wide_children : 0;
  ray.t_min = rays.t_min[i];
  ray.exclude = rays.exclude[i];
  ray.t = t;
  ray.primitive = primitive;
  return ray;
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
    if (lanes[lane] < ray.t || (lanes[lane] == ray.t && id < ray.primitive)) {
      ray.t = lanes[lane];
      ray.primitive = id;
    }
  }
}

FASTRT_INLINE void meet_run(LoneRay& ray, const BlockRun<TriangleBlock>& run) {
  const V3<LeafF> a = load_vertices(run, 0) - ray.origin, b = load_vertices(run, 1) - ray.origin,
                  c = load_vertices(run, 2) - ray.origin;
  const TriangleLanes<LeafF> lanes = intersect_triangle(
      set_up_triangle(a, b, c), ray.dir, [&] { return reach_of(a, b, c, largest(ray.origin)); });
  const std::uint32_t hit = to_bits(lanes.inside & (lanes.t > LeafF(ray.t_min)) & (lanes.t <= LeafF(ray.t)));
  if (hit != 0) keep_closest(ray, hit, lanes.t, run);
}

FASTRT_INLINE void meet_run(LoneRay& ray, const BlockRun<SphereBlock>& run) {
  const SphereLanes<LeafF> lanes =
      intersect_sphere(load_centers(run), load_two<LeafF>(run.low->radius, run.high->radius), ray.origin,
                       ray.dir, LeafF(ray.t_min));
  const std::uint32_t hit = to_bits(lanes.hit & (lanes.t <= LeafF(ray.t)));
  if (hit != 0) keep_closest(ray, hit, lanes.t, run);
}

FASTRT_INLINE void meet_leaf(const GeometryView& scene, LoneRay& ray, std::uint32_t leaf) {
  const auto meet = [&](const auto& run) { meet_run(ray, run); };
  if (leaf_group(leaf) == triangle_group)
    for_each_run(scene.triangles, leaf, meet);
  else
    for_each_run(scene.spheres, leaf, meet);
}

struct NodeHits {
  alignas(32) float near[wide_children];
  std::uint32_t bits;
};

FASTRT_INLINE void meet_node(const LoneRay& ray, const WideNode& node, NodeHits& hits) {
  using N = Floats<node_lanes>;
  hits.bits = 0;
  const float* columns = node.lower_x; // the six columns lie one after the other
  for (int half = 0; half < wide_children; half += node_lanes) {
    const float* c = columns + half;
    const V3<N> near_planes =
        load3<N>(c + ray.near_x, c + 2 * wide_children + ray.near_y, c + 4 * wide_children + ray.near_z);
    const V3<N> far_planes = load3<N>(c + (wide_children - ray.near_x), c + (3 * wide_children - ray.near_y),
                                      c + (5 * wide_children - ray.near_z));
    const SlabLanes<N> slab =
        intersect_slabs(ray.x, ray.y, ray.z, near_planes, far_planes, N(ray.t_min), N(depth_bound(ray.t)));
    slab.near.store_aligned(hits.near + half);
    hits.bits |= to_bits(slab.near <= slab.far) << half;
  }
}

// Puts the children that were met onto the stack, the nearest on top.
FASTRT_INLINE StackEntry* push_ordered(StackEntry* top, const WideNode& node, const NodeHits& hits) {
  StackEntry* const bottom = top;
  for (std::uint32_t bits = hits.bits; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctz(bits);
    const StackEntry entry{node.child[i], hits.near[i]};
    StackEntry* place = top++;
    for (; place != bottom && place[-1].near < entry.near; --place) *place = place[-1];
    *place = entry;
  }
  return top;
}

// Follows the ray through the subtree `start`. any: ends at the first hit, whichever it is.
template <bool any>
static void trace_lone_ray(const GeometryView& scene, LoneRay& ray, std::uint32_t start) noexcept {
  StackEntry stack[max_tree_stack];
  stack[0] = {start, ray.t_min};
  StackEntry* top = stack + 1;
  NodeHits hits;
  while (top != stack) {
    const StackEntry entry = *--top;
    if (entry.near > depth_bound(ray.t)) continue;
    if (is_leaf(entry.child)) {
      meet_leaf(scene, ray, entry.child);
      if (any && ray.primitive >= 0) return;
      continue;
    }
    const WideNode& node = scene.nodes[entry.child];
    meet_node(ray, node, hits);
    top = push_ordered(top, node, hits);
    if (top != stack && !is_leaf(top[-1].child)) __builtin_prefetch(&scene.nodes[top[-1].child]);
  }
}

// Rays first .. end - 1 of a batch, each on its own. Continues from what `hits` holds.
template <bool any>
static void trace_rays_alone(const GeometryView& scene, const RayBatch& rays, HitBatch& hits, int first,
                             int end) noexcept {
  for (int i = first; i < end; ++i) {
    if (!is_traceable(rays.origin_x[i], rays.origin_y[i], rays.origin_z[i], rays.dir_x[i], rays.dir_y[i],
                      rays.dir_z[i]))
      continue;
    LoneRay ray = make_lone_ray(scene, rays, i, hits.t[i], hits.primitive[i]);
    trace_lone_ray<any>(scene, ray, scene.root);
    hits.t[i] = ray.t;
    hits.primitive[i] = ray.primitive;
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
