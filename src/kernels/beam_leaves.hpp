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

// A triangle of a run and the rays of a group that have to be tested against it.
struct BeamPair {
  std::uint32_t place; // 8 * group + lane
  std::uint32_t rays;
};

struct BeamPairs {
  BeamPair pairs[beam_groups * pair_lanes];
  int count;
  std::uint64_t rays;      // of all of them
  std::uint32_t triangles; // bits of places
};

// Of the pairs in `touched` (bits of places) those that the sieve leaves.
template <bool any>
FASTRT_INLINE void find_pairs(const BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run,
                              const FrameTriangles& f, std::uint32_t touched, std::uint64_t rays,
                              BeamPairs& found) {
  found.count = 0;
  found.rays = 0;
  found.triangles = 0;
  alignas(32) std::int32_t ids[leaf_lanes];
  primitives_of(run).store_aligned(ids);
  for (; touched != 0; touched &= touched - 1) {
    const auto place = static_cast<std::uint32_t>(__builtin_ctz(touched));
    const int g = static_cast<int>(place / pair_lanes), lane = static_cast<int>(place % pair_lanes);
    const std::uint32_t inside = rays_inside(t.beam.rays, f, lane, g) & rays_of_group(rays, g) &
                                 ~rays_that_exclude(t.rays, t.first + g * group_size, ids[lane]);
    found.pairs[found.count] = {place, inside};
    found.count += inside != 0;
    found.rays |= static_cast<std::uint64_t>(inside) << (g * group_size);
    found.triangles |= static_cast<std::uint32_t>(inside != 0) << place;
  }
}

// A test of all triangles of a run against one ray costs as much as one triangle against a register of rays,
// times this / 16.
inline constexpr int lone_test_share = 16;

// Returns the rays that have a new hit.
template <bool any>
FASTRT_INLINE std::uint64_t meet_run_alone(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run,
                                           const BeamPairs& found) {
  t.tests += static_cast<std::uint32_t>(__builtin_popcountll(found.rays) * run.lanes);
  std::uint64_t changed = 0;
  for (std::uint64_t rays = found.rays; rays != 0; rays &= rays - 1) {
    const int at = __builtin_ctzll(rays), i = t.first + at;
    LoneRay ray = lone_ray(t.rays, t.hits, i);
    meet_triangles(ray, run, found.triangles >> (at / group_size * pair_lanes) & 0xFFU);
    if (ray.primitive == t.hits.primitive[i]) continue;
    t.hits.t[i] = ray.t;
    t.hits.primitive[i] = ray.primitive;
    changed |= std::uint64_t{1} << at;
  }
  return changed;
}

template <bool any>
FASTRT_INLINE std::uint64_t meet_run_together(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run,
                                              const BeamPairs& found) {
  std::uint64_t changed = 0;
  for (int i = 0; i < found.count; ++i) {
    const BeamPair& pair = found.pairs[i];
    const int g = static_cast<int>(pair.place / pair_lanes), lane = static_cast<int>(pair.place % pair_lanes);
    changed |= static_cast<std::uint64_t>(meet_triangle(t, run, lane, g, pair.rays)) << (g * group_size);
  }
  return changed;
}

// The places that hold triangles of their own.
FASTRT_INLINE std::uint32_t places_of(const BlockRun<TriangleBlock>& run) {
  return ((1U << run.lanes) - 1U) * 0x01010101U;
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
  const std::uint32_t touched = touch_boxes(beam, e) & places_of(rays) & places_of(run);
  if (touched == 0) return;
  const LeafF side = max(e.u.high - e.u.low, max(e.v.high - e.v.low, e.w.high - e.w.low));
  (side * LeafF(4.0F * beam.padding)).store_aligned(f.margin);
  BeamPairs found;
  find_pairs(t, run, f, touched, rays, found);
  if (found.count == 0) return;
  const std::uint64_t changed = __builtin_popcountll(found.rays) * widest <= found.count * lone_test_share
                                    ? meet_run_alone(t, run, found)
                                    : meet_run_together(t, run, found);
  for (std::uint32_t groups = groups_with(changed); groups != 0; groups &= groups - 1) {
    const int g = __builtin_ctz(groups);
    shorten_group(t, g, rays_of_group(changed, g));
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
    const std::uint64_t rays = waiting.rays[i] & rays_as_far_as(t.beam, waiting.near[i]);
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
