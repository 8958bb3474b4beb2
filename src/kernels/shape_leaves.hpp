// SPDX-License-Identifier: Apache-2.0
// Leaves of cones, disks, polygons and instances: each one's own box first, for their tests take long.
#pragma once

#include "src/kernels/instances.hpp"
#include "src/kernels/lone_columns.hpp"
#include "src/kernels/shapes.hpp"

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

// The lanes whose boxes the ray meets before its bound, and where. Rows that are not used have an inverted
// box.
template <class Ray>
FASTRT_INLINE std::uint32_t boxes_met(const Ray& ray, const BlockRun<ShapeBlock>& run, LeafF& at) {
  const V3<LeafF> low = load_low(run), high = load_high(run);
  const LeafF lows[3] = {low.x, low.y, low.z}, highs[3] = {high.x, high.y, high.z};
  LeafF first(ray.t_min), last(ray.bound);
  for (int axis = 0; axis < 3; ++axis) {
    const bool backwards = (ray.own.near_planes[axis] & wide_children) != 0;
    const LeafF& near = backwards ? highs[axis] : lows[axis];
    const LeafF& far = backwards ? lows[axis] : highs[axis];
    const LeafF inverse(ray.own.inverse[axis]);
    first = max(cull_mul_sub(near, inverse, LeafF(ray.own.near_start[axis])), first);
    last = min(cull_mul_sub(far, inverse, LeafF(ray.own.far_start[axis])), last);
  }
  at = first;
  return to_bits(first <= last) & ((1U << run.lanes) - 1U);
}

// An instance (planes are in no leaf), or a row that is not used.
FASTRT_INLINE bool is_no_shape(const GeometryView& scene, std::int32_t id) {
  return static_cast<std::uint32_t>(id) >= static_cast<std::uint32_t>(scene.shapes.first_plane);
}

// The ray against an instance.
template <bool any, class Ray>
FASTRT_INLINE void meet_instance_alone(const GeometryView& scene, HitBatch& hits, std::int32_t id, Ray& ray) {
  const int i = static_cast<int>(ray.index);
  hits.t[i] = ray.t;
  hits.primitive[i] = ray.primitive;
  meet_instance_alone<any>(scene, *ray.rays, hits, id, i);
  shorten(ray, hits.t[i], hits.primitive[i]);
}

// One ray against the shapes of a leaf; the same in all lanes. Counts runs of blocks.
template <bool any, class Ray>
[[gnu::noinline]] static void meet_shapes(const GeometryView& scene, HitBatch& hits, Ray& ray,
                                          std::uint32_t leaf, std::uint32_t& runs) noexcept {
  const V3<LeafF> origin = origin_of(ray), dir = dir_of(ray);
  WaitingInstances waiting;
  for_each_run(scene.shape_blocks, leaf, [&](const BlockRun<ShapeBlock>& run) {
    ++runs;
    LeafF at;
    for (std::uint32_t bits = boxes_met(ray, run, at); bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      const std::int32_t id = run.primitive(lane);
      if (is_no_shape(scene, id)) {
        if (id >= 0) waiting.add(id, at.get(static_cast<std::size_t>(lane)), 1);
        continue;
      }
      if (id == ray.rays->exclude[ray.index]) continue;
      const ShapeLanes<LeafF> met =
          intersect_shape(scene.shapes, id, origin, dir, {LeafF(ray.t_min), LeafF(ray.t), 1U});
      if ((to_bits(met.hit) & 1U) == 0) continue;
      const float t = met.t.get(0);
      if (t < ray.t || (t == ray.t && id < ray.primitive)) shorten(ray, t, id);
    }
  });
  while (waiting.count != 0) {
    const int next = waiting.take();
    if (waiting.near[next] <= ray.bound) meet_instance_alone<any>(scene, hits, waiting.id[next], ray);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
