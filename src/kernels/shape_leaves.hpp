// SPDX-License-Identifier: Apache-2.0
// Leaves of cones, disks, polygons and instances: each one's own box first, for their tests take long.
#pragma once

#include "src/kernels/instances.hpp"
#include "src/kernels/leaf_lanes.hpp"
#include "src/kernels/shapes.hpp"
#include "src/kernels/slab.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

FASTRT_INLINE V3<LeafF> load_low(const BlockRun<ShapeBlock>& run) {
  return {load_two<LeafF>(run.low->low_x, run.high->low_x), load_two<LeafF>(run.low->low_y, run.high->low_y),
          load_two<LeafF>(run.low->low_z, run.high->low_z)};
}
FASTRT_INLINE V3<LeafF> load_high(const BlockRun<ShapeBlock>& run) {
  return {load_two<LeafF>(run.low->high_x, run.high->high_x),
          load_two<LeafF>(run.low->high_y, run.high->high_y),
          load_two<LeafF>(run.low->high_z, run.high->high_z)};
}

FASTRT_INLINE SlabAxis<LeafF> spread_leaf(const SlabAxis<float>& axis) {
  return {LeafF(axis.near_origin), LeafF(axis.far_origin), LeafF(axis.inverse)};
}

// The lanes whose boxes the ray meets before `bound`, and where. Rows that are not used have an inverted box.
template <class Ray>
FASTRT_INLINE std::uint32_t boxes_met(const Ray& ray, const BlockRun<ShapeBlock>& run, LeafF& at) {
  const V3<LeafF> low = load_low(run), high = load_high(run);
  const bool bx = ray.near_x > ray.far_x, by = ray.near_y > ray.far_y, bz = ray.near_z > ray.far_z;
  const V3<LeafF> near{bx ? high.x : low.x, by ? high.y : low.y, bz ? high.z : low.z};
  const V3<LeafF> far{bx ? low.x : high.x, by ? low.y : high.y, bz ? low.z : high.z};
  const SlabLanes<LeafF> slab = intersect_slabs(spread_leaf(ray.x), spread_leaf(ray.y), spread_leaf(ray.z),
                                                near, far, LeafF(ray.t_min), LeafF(ray.bound));
  at = slab.near;
  return to_bits(slab.near <= slab.far) & ((1U << run.lanes) - 1U);
}

// An instance (planes are in no leaf), or a row that is not used.
FASTRT_INLINE bool is_no_shape(const GeometryView& scene, std::int32_t id) {
  return static_cast<std::uint32_t>(id) >= static_cast<std::uint32_t>(scene.shapes.first_plane);
}

// Ray i of a batch, which is `ray`, against an instance.
template <bool any, class Ray>
FASTRT_INLINE void meet_instance_alone(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                                       std::int32_t id, int i, Ray& ray) {
  hits.t[i] = ray.t;
  hits.primitive[i] = ray.primitive;
  meet_instance_alone<any>(scene, rays, hits, id, i);
  shorten(ray, hits.t[i], hits.primitive[i]);
}

// One ray against the shapes of a leaf; the same in all lanes. It is ray i of a batch.
template <bool any, class Ray>
[[gnu::noinline]] static void meet_shapes(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                                          int i, Ray& ray, std::uint32_t leaf) noexcept {
  const V3<LeafF> origin = {LeafF(ray.origin.x), LeafF(ray.origin.y), LeafF(ray.origin.z)};
  const V3<LeafF> dir = {LeafF(ray.dir.x), LeafF(ray.dir.y), LeafF(ray.dir.z)};
  WaitingInstances waiting;
  for_each_run(scene.shape_blocks, leaf, [&](const BlockRun<ShapeBlock>& run) {
    ++ray.runs;
    LeafF at;
    for (std::uint32_t bits = boxes_met(ray, run, at); bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      const std::int32_t id = run.primitive(lane);
      if (is_no_shape(scene, id)) {
        if (id >= 0) waiting.add(id, at.get(static_cast<std::size_t>(lane)), 1);
        continue;
      }
      if (id == ray.exclude) continue;
      const ShapeLanes<LeafF> met = intersect_shape(scene.shapes, id, origin, dir, LeafF(ray.t_min));
      if ((to_bits(met.hit) & 1U) == 0) continue;
      const float t = met.t.get(0);
      if (t < ray.t || (t == ray.t && id < ray.primitive)) shorten(ray, t, id);
    }
  });
  while (waiting.count != 0) {
    const int next = waiting.take();
    if (waiting.near[next] <= ray.bound)
      meet_instance_alone<any>(scene, rays, hits, waiting.id[next], i, ray);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
