// SPDX-License-Identifier: Apache-2.0
// Leaves of cones, disks and polygons: each primitive's own box first, for their tests take long.
#pragma once

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

// The lanes whose boxes the ray meets before its bound. Rows that are not used have an inverted box.
template <class Ray>
FASTRT_INLINE std::uint32_t boxes_met(const Ray& ray, const BlockRun<ShapeBlock>& run) {
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
  return to_bits(first <= last) & ((1U << run.lanes) - 1U);
}

// One ray against the shapes of a leaf; the same in all lanes.
template <class Ray>
[[gnu::noinline]] static void meet_shapes(const GeometryView& scene, Ray& ray, std::uint32_t leaf) noexcept {
  const V3<LeafF> origin = origin_of(ray), dir = dir_of(ray);
  for_each_run(scene.shape_blocks, leaf, [&](const BlockRun<ShapeBlock>& run) {
    for (std::uint32_t bits = boxes_met(ray, run); bits != 0; bits &= bits - 1) {
      const std::int32_t id = run.primitive(__builtin_ctz(bits));
      if (id < 0 || id == ray.rays->exclude[ray.index]) continue;
      const ShapeLanes<LeafF> met = intersect_shape(scene.shapes, id, origin, dir, LeafF(ray.t_min));
      if ((to_bits(met.hit) & 1U) == 0) continue;
      const float t = met.t.get(0);
      if (t < ray.t || (t == ray.t && id < ray.primitive)) shorten(ray, t, id);
    }
  });
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
