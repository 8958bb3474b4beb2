// SPDX-License-Identifier: Apache-2.0
// A tile in a leaf: spheres and the boxes of other shapes are projected and sieved, and what is left is
// tested with one register of rays at a time. Triangles wait until they fill a register (tile_triangles.hpp).
#pragma once

#include "src/kernels/tile_triangles.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// All lanes of a run that hold primitives.
template <class Block>
FASTRT_INLINE std::uint32_t lanes_of(const BlockRun<Block>& run) {
  return (1U << run.lanes) - 1U;
}

// The rectangles of a run's spheres: those of the boxes around them, along the frame's axes.
FASTRT_INLINE Rectangles<LeafF> project_spheres(const TileFrame& f, const BlockRun<SphereBlock>& run) {
  const V3<LeafF> center = load_centers(run) - broadcast3<LeafF>(f.origin);
  const LeafF reach = load_two<LeafF>(run.low->radius, run.high->radius) + LeafF(f.padding);
  const LeafF u = cull_dot(center, broadcast3<LeafF>(f.u)), v = cull_dot(center, broadcast3<LeafF>(f.v)),
              w = cull_dot(center, broadcast3<LeafF>(f.w));
  return project_extent(f, u - reach, u + reach, v - reach, v + reach, w - reach, w + reach);
}

template <bool any, class View>
FASTRT_INLINE void meet_run(TileTraversal<any, View>& tile, const BlockRun<SphereBlock>& run,
                            std::uint32_t groups) {
  std::uint32_t touched[leaf_lanes];
  const Rectangles<LeafF> boxes = project_spheres(tile.view.frame, run);
  std::uint32_t some = touch_groups(tile.view, boxes, lanes_of(run), groups, touched);
  if (some == 0) return;
  const StoredRectangles<LeafF> rectangles(boxes);
  for (; some != 0; some &= some - 1) {
    const int lane = __builtin_ctz(some);
    const SphereBlock& block = run.block_of(lane);
    const int i = lane % block_size;
    const V3<PacketF> center = broadcast3<PacketF>(block.x[i], block.y[i], block.z[i]);
    const PacketF radius(block.radius[i]);
    const LoneRectangle around = rectangles.of(lane);
    for (std::uint32_t left = touched[lane]; left != 0; left &= left - 1) {
      const int g = __builtin_ctz(left);
      const std::uint32_t rays = rays_in_rectangle(tile.view, tile.points, around, g) & tile.open[g];
      if (rays == 0) continue;
      meet_group(tile, g, rays, block.primitive[i], [&](int ray) -> MetLanes {
        const SphereLanes<PacketF> lanes = intersect_sphere(
            center, radius, load_origin(tile.rays, ray), load_dir(tile.rays, ray),
            PacketF::load_aligned(tile.rays.t_min + ray), rays >> (ray % group_size) & register_bits);
        return {lanes.hit, lanes.t};
      });
    }
  }
}

// The rectangles of boxes whose corners are given relative to the origin.
template <class Frame, class F>
FASTRT_INLINE Rectangles<F> project_box(const Frame& f, const V3<F>& low, const V3<F>& high) {
  const V3<F> half = (high - low) * F(0.5F), middle = low + half;
  const F padding(f.padding);
  const auto at = [&](const V3<float>& axis) { return cull_dot(middle, broadcast3<F>(axis)); };
  const auto reach = [&](const V3<float>& axis) {
    const V3<F> a = broadcast3<F>(axis);
    return cull_dot(V3<F>{abs(a.x), abs(a.y), abs(a.z)}, half) + padding;
  };
  const F u = at(f.u), v = at(f.v), w = at(f.w), ru = reach(f.u), rv = reach(f.v), rw = reach(f.w);
  return project_extent(f, u - ru, u + ru, v - rv, v + rv, w - rw, w + rw);
}

// The rectangles of a run's shapes: those of their boxes.
template <class Frame>
FASTRT_INLINE Rectangles<LeafF> project_boxes(const Frame& f, const BlockRun<ShapeBlock>& run) {
  const V3<LeafF> origin = broadcast3<LeafF>(f.origin);
  return project_box(f, load_low(run) - origin, load_high(run) - origin);
}

// An instance against whole groups.
template <bool any, class View>
FASTRT_INLINE void meet_instance(TileTraversal<any, View>& tile, std::int32_t id, std::uint32_t groups) {
  InstanceVisit visit;
  visit.unit = group_size / widest;
  visit.count = 0;
  for (std::uint32_t left = groups; left != 0; left &= left - 1) {
    const int g = __builtin_ctz(left);
    add_group(visit, g * group_size, tile.open[g]);
  }
  std::uint32_t changed[batch_groups] = {};
  meet_instance<any>(tile.scene, tile.rays, tile.hits, id, visit, changed);
  for (std::uint32_t left = groups; left != 0; left &= left - 1) {
    const int g = __builtin_ctz(left);
    if (changed[g] != 0) shorten_group(tile, g, changed[g]);
  }
}

template <bool any, class View>
[[gnu::noinline]] static void meet_shapes(TileTraversal<any, View>& tile, std::uint32_t leaf,
                                          std::uint32_t groups) noexcept {
  WaitingInstances waiting;
  for_each_run(tile.scene.shape_blocks, leaf, [&](const BlockRun<ShapeBlock>& run) {
    std::uint32_t touched[leaf_lanes];
    const Rectangles<LeafF> boxes = project_boxes(tile.view.frame, run);
    std::uint32_t some = touch_groups(tile.view, boxes, lanes_of(run), groups, touched);
    if (some == 0) return;
    const StoredRectangles<LeafF> rectangles(boxes);
    for (; some != 0; some &= some - 1) {
      const int lane = __builtin_ctz(some);
      const std::int32_t id = run.primitive(lane);
      if (is_no_shape(tile.scene, id)) {
        if (id >= 0) waiting.add(id, boxes.near.get(static_cast<std::size_t>(lane)), touched[lane]);
        continue;
      }
      const LoneRectangle around = rectangles.of(lane);
      for (std::uint32_t left = touched[lane]; left != 0; left &= left - 1) {
        const int g = __builtin_ctz(left);
        const std::uint32_t rays = rays_in_rectangle(tile.view, tile.points, around, g) & tile.open[g] &
                                   ~rays_that_exclude(tile.rays, g * group_size, id);
        if (rays == 0) continue;
        meet_group(tile, g, rays, id, [&](int ray) -> MetLanes {
          const ShapeLanes<PacketF> met = intersect_shape(
              tile.scene.shapes, id, load_origin(tile.rays, ray), load_dir(tile.rays, ray),
              {PacketF::load_aligned(tile.rays.t_min + ray), PacketF::load_aligned(tile.hits.t + ray),
               rays >> (ray % group_size) & register_bits});
          return {met.hit, met.t};
        });
      }
    }
  });
  while (waiting.count != 0) {
    const int i = waiting.take();
    const std::uint32_t left =
        static_cast<std::uint32_t>(waiting.rays[i]) & far_groups(tile.view.groups, waiting.near[i]);
    if (left != 0) meet_instance(tile, waiting.id[i], left);
  }
}

template <bool any, class View>
FASTRT_INLINE void meet_leaf(TileTraversal<any, View>& tile, std::uint32_t leaf, std::uint32_t groups) {
  if (leaf_group(leaf) == triangle_group)
    add_triangles(tile, leaf, groups);
  else if (leaf_group(leaf) == sphere_group)
    for_each_run(tile.scene.spheres, leaf, [&](const auto& run) { meet_run(tile, run, groups); });
  else
    meet_shapes(tile, leaf, groups);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
