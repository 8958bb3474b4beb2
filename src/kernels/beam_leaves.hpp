// SPDX-License-Identifier: Apache-2.0
// A beam in a leaf: spheres and shapes are tested with a register of rays; triangles: beam_triangles.hpp.
#pragma once

#include "src/kernels/beam_triangles.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

template <bool any>
FASTRT_INLINE void meet_run(BeamTraversal<any>& t, const BlockRun<SphereBlock>& run, std::uint64_t rays) {
  for (int lane = 0; lane < run.lanes; ++lane) {
    const SphereBlock& block = run.block_of(lane);
    const int s = lane % block_size;
    if (block.primitive[s] < 0) break;
    const V3<PacketF> center = broadcast3<PacketF>(block.x[s], block.y[s], block.z[s]);
    for (int g = 0; g < beam_groups; ++g) {
      const std::uint32_t group = rays_of_group(rays, g);
      if (group == 0) continue;
      const std::uint32_t changed = meet_beam_group(t, g, group, block.primitive[s], [&](int i) -> MetLanes {
        const SphereLanes<PacketF> lanes = intersect_sphere(
            center, PacketF(block.radius[s]), load_origin(t.rays, i), load_dir(t.rays, i),
            PacketF::load_aligned(t.rays.t_min + i), group >> ((i - t.first) % group_size) & register_bits);
        return {lanes.hit, lanes.t};
      });
      if (changed != 0) shorten_group(t, g, changed);
    }
  }
}

// The extents of a run's shapes: those of their boxes.
FASTRT_INLINE Extents<LeafF> extents_of_shapes(const Beam& beam, const BlockRun<ShapeBlock>& run) {
  const V3<LeafF> low = load_low(run), high = load_high(run);
  const LeafF lows[3] = {low.x, low.y, low.z}, highs[3] = {high.x, high.y, high.z}, padding(beam.padding);
  const auto along = [&](int axis) { return padded({lows[axis], highs[axis]}, padding); };
  return {along(beam.x), along(beam.y), in_depth(beam, along(beam.z))};
}

// An instance against the rays of the beam in `rays`.
template <bool any>
FASTRT_INLINE void meet_instance(BeamTraversal<any>& t, std::int32_t id, std::uint64_t rays) {
  InstanceVisit visit;
  visit.unit = group_size / widest;
  visit.count = 0;
  for (int g = 0; g < beam_groups; ++g)
    if (const std::uint32_t group = rays_of_group(any ? rays & t.open : rays, g); group != 0)
      add_group(visit, t.first + g * group_size, group);
  std::uint32_t changed[batch_groups] = {};
  meet_instance<any>(t.scene, t.rays, t.hits, id, visit, changed);
  for (int g = 0; g < beam_groups; ++g) {
    const int group = t.first / group_size + g;
    if (group < batch_groups && changed[group] != 0) shorten_group(t, g, changed[group]);
  }
}

// Instances are met by all groups together, after the run's other shapes.
template <bool any>
FASTRT_INLINE void meet_waiting(BeamTraversal<any>& t, WaitingInstances& waiting) {
  while (waiting.count != 0) {
    const int i = waiting.take();
    const std::uint64_t rays = waiting.rays[i] & rays_as_far_as(t.beam.rays, waiting.near[i]);
    if (rays != 0) meet_instance(t, waiting.id[i], rays);
  }
}

template <bool any>
[[gnu::noinline]] static void meet_shapes(BeamTraversal<any>& t, const BlockRun<ShapeBlock>& run,
                                          std::uint64_t rays) noexcept {
  const Extents<LeafF> e = extents_of_shapes(t.beam, run);
  const std::uint32_t touched = touch_boxes(t.beam, e) & places_of(rays);
  if (touched == 0) return;
  StoredExtents boxes;
  boxes.store({e.u, e.v, {max(e.w.low, LeafF(0.0F)), e.w.high}}, 0);
  std::uint64_t visitors[leaf_lanes] = {}; // of instances
  std::uint32_t instances = 0;
  for (int g = 0; g < beam_groups; ++g) {
    const std::uint32_t group = rays_of_group(rays, g);
    if (group == 0) continue;
    std::uint32_t changed = 0;
    for (std::uint32_t lanes = touched >> (g * pair_lanes) & 0xFFU; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      const std::int32_t id = run.primitive(lane);
      if (id < 0 || lane >= run.lanes) continue;
      if (is_no_shape(t.scene, id)) {
        visitors[lane] |= static_cast<std::uint64_t>(group) << (g * group_size);
        instances |= 1U << lane;
        continue;
      }
      const std::uint32_t asked = touch_rays(t.beam.rays, boxes.of(static_cast<std::uint32_t>(lane)), g) &
                                  group & ~rays_that_exclude(t.rays, t.first + g * group_size, id);
      if (asked == 0) continue;
      changed |= meet_beam_group(t, g, asked, id, [&](int i) -> MetLanes {
        const ShapeLanes<PacketF> met =
            intersect_shape(t.scene.shapes, id, load_origin(t.rays, i), load_dir(t.rays, i),
                            {PacketF::load_aligned(t.rays.t_min + i), PacketF::load_aligned(t.hits.t + i),
                             asked >> ((i - t.first) % group_size) & register_bits});
        return {met.hit, met.t};
      });
    }
    if (changed != 0) shorten_group(t, g, changed);
  }
  if (instances == 0) return;
  WaitingInstances waiting;
  for (; instances != 0; instances &= instances - 1) {
    const int lane = __builtin_ctz(instances);
    waiting.add(run.primitive(lane), e.w.low.get(static_cast<std::size_t>(lane)), visitors[lane]);
  }
  meet_waiting(t, waiting);
}

template <bool any>
FASTRT_INLINE void meet_run(BeamTraversal<any>& t, const BlockRun<ShapeBlock>& run, std::uint64_t rays) {
  meet_shapes(t, run, rays);
}

template <bool any>
FASTRT_INLINE void meet_leaf(BeamTraversal<any>& t, std::uint32_t leaf, std::uint64_t rays) {
  const auto meet = [&](const auto& run) { meet_run(t, run, any ? rays & t.open : rays); };
  if (leaf_group(leaf) == triangle_group)
    for_each_run(t.scene.triangles, leaf, meet);
  else if (leaf_group(leaf) == shape_group)
    for_each_run(t.scene.shape_blocks, leaf, meet);
  else
    for_each_run(t.scene.spheres, leaf, meet);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
