// SPDX-License-Identifier: Apache-2.0
// A beam in a leaf: triangles are sieved, then tested with a register full of rays or of triangles, whichever
// takes fewer tests; spheres and shapes are tested with a register of rays.
#pragma once

#include "src/kernels/beam_children.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

template <bool any>
struct BeamTraversal {
  const GeometryView& scene;
  const RayBatch& rays;
  HitBatch& hits;
  LoneColumns& columns; // of rays that go on alone
  int first;            // ray 0 of the beam in the batch
  Beam& beam;
  std::uint64_t open; // rays that still look for a hit
  std::uint32_t nodes = 0, tests = 0;
};

// After new hits of the rays in `bits` of group g.
template <bool any>
FASTRT_INLINE void shorten_group(BeamTraversal<any>& t, int g, std::uint32_t bits) {
  if constexpr (any) t.open &= ~(static_cast<std::uint64_t>(bits) << (g * group_size));
  const std::uint32_t open = rays_of_group(t.open, g);
  set_far(t.beam, g, beam_far(t.beam, t.hits, t.first, g, open));
}

// One primitive against the rays of group g in `bits`.
template <bool any, class Meet>
FASTRT_INLINE std::uint32_t meet_beam_group(BeamTraversal<any>& t, int g, std::uint32_t bits,
                                            std::int32_t primitive, const Meet& meet) {
  t.tests += static_cast<std::uint32_t>(__builtin_popcount(bits));
  std::uint32_t changed = 0;
  for (int k = 0; k < group_size; k += widest) {
    if ((bits >> k & register_bits) == 0) continue;
    const int i = t.first + g * group_size + k;
    const auto [hit, distance] = meet(i);
    const PacketM counted = hit & from_bits<widest>(bits >> k & register_bits);
    if (to_bits(counted) == 0) continue;
    PacketF best_t = PacketF::load_aligned(t.hits.t + i);
    PacketI best_primitive = PacketI::load_aligned(t.hits.primitive + i);
    const std::uint32_t kept =
        keep_closest(best_t, best_primitive, load<PacketI>(t.rays.exclude + i), counted, distance, primitive);
    if (kept == 0) continue;
    best_t.store_aligned(t.hits.t + i);
    best_primitive.store_aligned(t.hits.primitive + i);
    changed |= kept << k;
  }
  return changed;
}

template <bool any>
FASTRT_INLINE std::uint32_t meet_triangle(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run, int lane,
                                          int g, std::uint32_t bits) {
  const V3<PacketF> v0 = spread_vertex<PacketF>(run, 0, lane), v1 = spread_vertex<PacketF>(run, 1, lane),
                    v2 = spread_vertex<PacketF>(run, 2, lane);
  return meet_beam_group(t, g, bits, run.primitive(lane), [&](int i) -> MetLanes {
    const V3<PacketF> origin = load_origin(t.rays, i);
    const V3<PacketF> a = v0 - origin, b = v1 - origin, c = v2 - origin;
    const TriangleLanes<PacketF> lanes = intersect_triangle(
        a, b, c, load_dir(t.rays, i), largest(origin), bits >> ((i - t.first) % group_size) & register_bits);
    return {lanes.inside & (lanes.t > PacketF::load_aligned(t.rays.t_min + i)), lanes.t};
  });
}

// What a group's rays have to be tested against.
struct Candidates {
  std::uint32_t rays; // of all triangles
  int triangles;
  alignas(32) std::uint32_t rays_of[leaf_lanes];

  // The triangles that ray i of the group may hit.
  [[gnu::always_inline]] inline std::uint32_t triangles_of(int i) const {
    return set_bits(Ints<leaf_lanes>::load_aligned(reinterpret_cast<const std::int32_t*>(rays_of)), i);
  }
};

FASTRT_INLINE Candidates find_candidates(const Beam& beam, const FrameTriangles& f, std::uint32_t lanes,
                                         int g, std::uint32_t group) {
  Candidates found;
  found.rays = 0;
  found.triangles = 0;
  for (int lane = 0; lane < leaf_lanes; ++lane) found.rays_of[lane] = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = __builtin_ctz(lanes);
    found.rays_of[lane] = rays_inside(beam.rays, f, lane, g) & group;
    found.rays |= found.rays_of[lane];
    found.triangles += found.rays_of[lane] != 0;
  }
  return found;
}

// A test of all triangles of a run against one ray costs as much as one triangle against a register of rays,
// times this / 16.
inline constexpr int lone_test_share = 16;

// Returns the rays that have a new hit.
template <bool any>
FASTRT_INLINE std::uint32_t meet_run_alone(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run, int g,
                                           const Candidates& found) {
  t.tests += static_cast<std::uint32_t>(__builtin_popcount(found.rays) * run.lanes);
  std::uint32_t changed = 0;
  for (std::uint32_t rays = found.rays; rays != 0; rays &= rays - 1) {
    const int lane = __builtin_ctz(rays), i = t.first + g * group_size + lane;
    LoneRay ray = lone_ray(t.rays, t.hits, i);
    meet_triangles(ray, run, found.triangles_of(lane));
    if (ray.primitive == t.hits.primitive[i]) continue;
    t.hits.t[i] = ray.t;
    t.hits.primitive[i] = ray.primitive;
    changed |= 1U << lane;
  }
  return changed;
}

template <bool any>
FASTRT_INLINE std::uint32_t meet_run_together(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run,
                                              int g, const Candidates& found) {
  std::uint32_t changed = 0;
  for (int lane = 0; lane < run.lanes; ++lane)
    if (found.rays_of[lane] != 0) changed |= meet_triangle(t, run, lane, g, found.rays_of[lane]);
  return changed;
}

template <bool any>
FASTRT_INLINE void meet_run(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run, std::uint64_t rays) {
  const Beam& beam = t.beam;
  FrameTriangles f;
  const LeafF zero(0.0F), padding(beam.padding);
  const Extents<LeafF> e{
      padded(place_corners(run, beam.x, zero, zero, f.u), padding),
      padded(place_corners(run, beam.y, zero, zero, f.v), padding),
      padded(place_corners(run, beam.z, LeafF(beam.backwards ? -0.0F : 0.0F), LeafF(beam.depth), f.w),
             padding)};
  std::uint32_t touched[group_steps];
  touch_boxes(beam, e, touched);
  const LeafF side = max(e.u.high - e.u.low, max(e.v.high - e.v.low, e.w.high - e.w.low));
  (side * LeafF(4.0F * beam.padding)).store_aligned(f.margin);
  for (int g = 0; g < beam_groups; ++g) {
    const std::uint32_t group = rays_of_group(rays, g);
    if (group == 0) continue;
    const Candidates found = find_candidates(beam, f, boxes_of_group(touched, g), g, group);
    if (found.rays == 0) continue;
    const std::uint32_t changed = __builtin_popcount(found.rays) * widest <= found.triangles * lone_test_share
                                      ? meet_run_alone(t, run, g, found)
                                      : meet_run_together(t, run, g, found);
    if (changed != 0) shorten_group(t, g, changed);
  }
}

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
        const SphereLanes<PacketF> lanes =
            intersect_sphere(center, PacketF(block.radius[s]), load_origin(t.rays, i), load_dir(t.rays, i),
                             PacketF::load_aligned(t.rays.t_min + i));
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
    const std::uint64_t rays = waiting.rays[i] & rays_as_far_as(t.beam, waiting.near[i]);
    if (rays != 0) meet_instance(t, waiting.id[i], rays);
  }
}

template <bool any>
[[gnu::noinline]] static void meet_shapes(BeamTraversal<any>& t, const BlockRun<ShapeBlock>& run,
                                          std::uint64_t rays) noexcept {
  const Extents<LeafF> e = extents_of_shapes(t.beam, run);
  std::uint32_t touched[group_steps];
  touch_boxes(t.beam, e, touched);
  std::uint64_t visitors[leaf_lanes] = {}; // of instances
  std::uint32_t instances = 0;
  for (int g = 0; g < beam_groups; ++g) {
    const std::uint32_t group = rays_of_group(rays, g);
    if (group == 0) continue;
    std::uint32_t changed = 0;
    for (std::uint32_t lanes = boxes_of_group(touched, g); lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      const std::int32_t id = run.primitive(lane);
      if (id < 0 || lane >= run.lanes) continue;
      if (is_no_shape(t.scene, id)) {
        visitors[lane] |= static_cast<std::uint64_t>(group) << (g * group_size);
        instances |= 1U << lane;
        continue;
      }
      changed |= meet_beam_group(t, g, group, id, [&](int i) -> MetLanes {
        const ShapeLanes<PacketF> met =
            intersect_shape(t.scene.shapes, id, load_origin(t.rays, i), load_dir(t.rays, i),
                            PacketF::load_aligned(t.rays.t_min + i));
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
