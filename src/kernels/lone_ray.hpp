// SPDX-License-Identifier: Apache-2.0
// A ray that follows no other: how it meets the boxes of a node and the primitives of a leaf. Its lanes are
// the boxes, or the primitives.
#pragma once

#include "src/kernels/lone_columns.hpp"
#include "src/kernels/lone_order.hpp"
#include "src/kernels/shape_leaves.hpp"
#include "src/kernels/sphere.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// A ray that is on its way, with the closest hit so far. Plain numbers: a register is filled from memory as
// fast as it is loaded.
struct LoneRay {
  LoneNumbers own;
  const RayBatch* rays;
  std::ptrdiff_t index;
  float t_min;
  float t, bound; // the closest hit so far, and how far boxes still matter
  Waiting limit;  // the same for what waits
  std::int32_t primitive;
};

FASTRT_INLINE void shorten(LoneRay& ray, float t, std::int32_t primitive) {
  ray.t = t;
  ray.bound = depth_bound(t);
  ray.limit = waiting_limit(ray.bound, ray.t_min);
  ray.primitive = primitive;
}

// Its own numbers are set by copy_ray(), where boxes are to be met.
FASTRT_INLINE LoneRay lone_ray(const RayBatch& rays, const HitBatch& hits, int index) {
  LoneRay ray;
  ray.rays = &rays;
  ray.index = index;
  ray.t_min = rays.t_min[index];
  shorten(ray, hits.t[index], hits.primitive[index]);
  return ray;
}

// Where the ray is in the node's boxes: in half of them where registers hold four.
FASTRT_INLINE BoxLanes meet_boxes(const LoneRay& ray, const WideNode& node, int half) {
  using N = Floats<node_lanes>;
  const LoneNumbers& own = ray.own;
  const float* const columns = node.lower_x + half; // the six columns lie one after the other
  const auto entry = [&](int axis) {
    return cull_mul_sub(load<N>(columns + own.near_planes[axis]), N(own.inverse[axis]),
                        N(own.near_start[axis]));
  };
  const auto exit = [&](int axis) {
    return cull_mul_sub(load<N>(columns + own.far_planes[axis]), N(own.inverse[axis]),
                        N(own.far_start[axis]));
  };
  // The running value goes second: max and min return that one where the other is NaN.
  const N first = max(entry(0), max(entry(1), max(entry(2), N(ray.t_min))));
  const N last = min(exit(0), min(exit(1), min(exit(2), N(ray.bound))));
  return {first, last};
}

// The triangles that lie around the ray, as seen along it. Only culls; what is left goes through the exact
// test. size: no less than that of the triangles' boxes. The triangle that the ray leaves out does not count:
// a ray that starts on it would find it around itself.
FASTRT_INLINE std::uint32_t triangles_around(const LoneRay& ray, const BlockRun<TriangleBlock>& run,
                                             float size) {
  const LoneNumbers& own = ray.own;
  const float margin = size * own.margin;
  if (!(margin < __builtin_inff())) return (1U << run.lanes) - 1U;
  const float* const low = run.low->x[0];
  const float* const high = run.high->x[0];
  const std::ptrdiff_t across_x = own.across_x, across_y = own.across_y, along = own.along;
  const LeafF slope_x(own.slope_x), slope_y(own.slope_y), at_x(own.at_x), at_y(own.at_y);
  LeafF x[3], y[3];
  for (int v = 0; v < 3; ++v) {
    const std::ptrdiff_t at = v * block_size;
    const LeafF z = load_two<LeafF>(low + along + at, high + along + at);
    x[v] = cull_less(slope_x, z, load_two<LeafF>(low + across_x + at, high + across_x + at)) - at_x;
    y[v] = cull_less(slope_y, z, load_two<LeafF>(low + across_y + at, high + across_y + at)) - at_y;
  }
  const LeafF p = cull_mul_sub(x[1], y[2], y[1] * x[2]), q = cull_mul_sub(x[2], y[0], y[2] * x[0]),
              r = cull_mul_sub(x[0], y[1], y[0] * x[1]);
  const auto ids = primitives_of(run);
  const std::uint32_t others = to_bits(simd::bool_cast(ids != IntsOf<LeafF>(ray.rays->exclude[ray.index])));
  return others & to_bits((min(p, min(q, r)) >= LeafF(-margin)) | (max(p, max(q, r)) <= LeafF(margin)));
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
    if (id == ray.rays->exclude[ray.index]) continue;
    if (lanes[lane] < ray.t || (lanes[lane] == ray.t && id < ray.primitive)) shorten(ray, lanes[lane], id);
  }
}

FASTRT_INLINE V3<LeafF> origin_of(const LoneRay& ray) {
  return {LeafF(ray.rays->origin_x[ray.index]), LeafF(ray.rays->origin_y[ray.index]),
          LeafF(ray.rays->origin_z[ray.index])};
}
FASTRT_INLINE V3<LeafF> dir_of(const LoneRay& ray) {
  return {LeafF(ray.rays->dir_x[ray.index]), LeafF(ray.rays->dir_y[ray.index]),
          LeafF(ray.rays->dir_z[ray.index])};
}

// The run's triangles in the lanes of `asked` (bits).
FASTRT_INLINE void meet_triangles(LoneRay& ray, const BlockRun<TriangleBlock>& run, std::uint32_t asked) {
  const V3<LeafF> origin = origin_of(ray);
  const V3<LeafF> a = load_vertices(run, 0) - origin, b = load_vertices(run, 1) - origin,
                  c = load_vertices(run, 2) - origin;
  const TriangleLanes<LeafF> lanes = intersect_triangle(a, b, c, dir_of(ray), largest(origin), asked);
  const std::uint32_t hit =
      to_bits(lanes.inside & (lanes.t > LeafF(ray.t_min)) & (lanes.t <= LeafF(ray.t))) & asked;
  if (hit != 0) keep_closest(ray, hit, lanes.t, run);
}

FASTRT_INLINE void meet_run(LoneRay& ray, const BlockRun<SphereBlock>& run) {
  const SphereLanes<LeafF> lanes =
      intersect_sphere(load_centers(run), load_two<LeafF>(run.low->radius, run.high->radius), origin_of(ray),
                       dir_of(ray), LeafF(ray.t_min));
  const std::uint32_t hit = to_bits(lanes.hit & (lanes.t <= LeafF(ray.t)));
  if (hit != 0) keep_closest(ray, hit, lanes.t, run);
}

// Leaves that hold no triangles. Counts the runs of blocks that it takes.
template <bool any>
FASTRT_INLINE void meet_other_leaf(const GeometryView& scene, HitBatch& hits, LoneRay& ray,
                                   std::uint32_t leaf, std::uint32_t& runs) {
  if (leaf_group(leaf) == sphere_group)
    for_each_run(scene.spheres, leaf, [&](const BlockRun<SphereBlock>& run) {
      ++runs;
      meet_run(ray, run);
    });
  else
    meet_shapes<any>(scene, hits, ray, leaf, runs);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
