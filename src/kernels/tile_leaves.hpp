// SPDX-License-Identifier: Apache-2.0
// A tile in a leaf: triangles, spheres and the boxes of other shapes are projected and sieved, and what is
// left is tested with one register of rays at a time. Rays of a common origin share a triangle's set-up
// without changing a bit.
#pragma once

#include "src/kernels/tile_edges.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// All that a traversal carries. View: how the rays are seen.
template <bool any, class View = TileView>
struct TileTraversal {
  TileTraversal(const GeometryView& s, const RayBatch& r, HitBatch& h, const LiveRays& l)
      : scene(s), rays(r), hits(h) {
    for (int g = 0; g < batch_groups; ++g) open[g] = l.bits[g];
  }

  const GeometryView& scene;
  const RayBatch& rays;
  HitBatch& hits;
  std::uint32_t open[batch_groups]; // the rays that still look for a hit: bit l of word g is ray 16 g + l
  typename View::Points points;
  View view;
  std::uint32_t nodes = 0, tests = 0;
  std::uint32_t shortened = 0; // groups that may look less far than the view knows
};

// A triangle that covers more groups than this by its rectangle is first held against their corners by its
// edges.
inline constexpr int many_groups = 3;

// After hits of the rays in `bits` of group g. Rays that have a hit look no more if any will do.
template <bool any, class View>
FASTRT_INLINE void shorten_group(TileTraversal<any, View>& tile, int g, std::uint32_t bits) {
  if constexpr (any) tile.open[g] &= ~bits;
  tile.shortened |= (!any || tile.open[g] == 0 ? 1U : 0U) << g;
}

// After a leaf: how far the groups that have changed still look. (Not after each test: a group is met by several
// triangles of a leaf, and finding out takes as long as another test.)
template <bool any, class View>
FASTRT_INLINE void shorten_view(TileTraversal<any, View>& tile) {
  TileGroups& groups = tile.view.groups;
  if constexpr (any) {
    for (std::uint32_t left = tile.shortened; left != 0; left &= left - 1)
      groups.far[__builtin_ctz(left)] = -__builtin_inff();
  } else {
    for (int g = 0; g < batch_groups; g += 4)
      if ((tile.shortened >> g & 15U) != 0) bound_depths(tile.hits, tile.open, g, groups);
  }
  tile.view.far = most_of(groups.far);
  tile.shortened = 0;
}

// Keeps hits of the rays from row i on. Returns the lanes that took them.
template <bool any, class View>
FASTRT_INLINE std::uint32_t keep_hits(TileTraversal<any, View>& tile, int i, const PacketM& hit,
                                      const PacketF& t, std::int32_t primitive) {
  const PacketI exclude = PacketI::load_aligned(tile.rays.exclude + i);
  PacketF best_t = PacketF::load_aligned(tile.hits.t + i);
  PacketI best_primitive = PacketI::load_aligned(tile.hits.primitive + i);
  if constexpr (any) {
    const PacketI id(primitive);
    const PacketM taken = hit & (t < best_t) & simd::bool_cast(id != exclude);
    select_ints<PacketF>(taken, id, best_primitive).store_aligned(tile.hits.primitive + i);
    return to_bits(taken);
  } else {
    const std::uint32_t kept = keep_closest(best_t, best_primitive, exclude, hit, t, primitive);
    if (kept == 0) return 0;
    best_t.store_aligned(tile.hits.t + i);
    best_primitive.store_aligned(tile.hits.primitive + i);
    return kept;
  }
}

// One primitive against the rays of group g in `bits`. meet(ray) gives the lanes that it hits and their t.
template <bool any, class View, class Meet>
FASTRT_INLINE void meet_group(TileTraversal<any, View>& tile, int g, std::uint32_t bits,
                              std::int32_t primitive, const Meet& meet) {
  tile.tests += static_cast<std::uint32_t>(__builtin_popcount(bits));
  std::uint32_t changed = 0;
  for (int k = 0; k < group_size; k += widest) {
    if (widest < group_size && (bits >> k & ((1U << (widest - 1)) * 2U - 1U)) == 0) continue;
    const int i = g * group_size + k;
    const auto [hit, t] = meet(i);
    const PacketM counted = hit & from_bits<widest>(bits >> k);
    if (to_bits(counted) == 0) continue;
    changed |= keep_hits(tile, i, counted, t, primitive) << k;
  }
  if (changed != 0) shorten_group(tile, g, changed);
}

struct MetLanes {
  PacketM hit;
  PacketF t;
};

FASTRT_INLINE V3<PacketF> load_dir(const RayBatch& rays, int i) {
  return {PacketF::load_aligned(rays.dir_x + i), PacketF::load_aligned(rays.dir_y + i),
          PacketF::load_aligned(rays.dir_z + i)};
}
FASTRT_INLINE V3<PacketF> load_origin(const RayBatch& rays, int i) {
  return {PacketF::load_aligned(rays.origin_x + i), PacketF::load_aligned(rays.origin_y + i),
          PacketF::load_aligned(rays.origin_z + i)};
}

// Set-ups and reaches of a run as columns, so that one can be spread over a register.
struct BlockSetup {
  alignas(32) float columns[19][leaf_lanes];
};

FASTRT_INLINE BlockSetup store_setup(const TriangleSetup<LeafF>& s, const TriangleReach<LeafF>& r) {
  BlockSetup out;
  store3(s.edge_a, out.columns[0], out.columns[1], out.columns[2]);
  store3(s.edge_b, out.columns[3], out.columns[4], out.columns[5]);
  store3(s.edge_c, out.columns[6], out.columns[7], out.columns[8]);
  store3(s.normal, out.columns[9], out.columns[10], out.columns[11]);
  s.offset.store_aligned(out.columns[12]);
  store3(r.low, out.columns[13], out.columns[14], out.columns[15]);
  store3(r.high, out.columns[16], out.columns[17], out.columns[18]);
  return out;
}

FASTRT_INLINE V3<PacketF> spread(const BlockSetup& s, int column, int i) {
  return broadcast3<PacketF>(s.columns[column][i], s.columns[column + 1][i], s.columns[column + 2][i]);
}

// A triangle of a run and the rays of a group that its edges let through.
struct MetPair {
  std::int32_t triangle, group;
  std::uint32_t rays;
};

// Of the 16 rays from row `first` on those that a primitive is excluded for: often it is the surface that
// they leave or go to, which all of them would be tested against.
FASTRT_INLINE std::uint32_t rays_that_exclude(const RayBatch& rays, int first, std::int32_t primitive) {
  const PacketI id(primitive);
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest)
    bits |= to_bits(simd::bool_cast(PacketI::load_aligned(rays.exclude + first + k) == id)) << k;
  return bits;
}

// What the edges of a run's triangles let through of the groups that they touch: act(triangle, group, rays).
// First all triangles against their groups' corners, then all pairs against the rays, then what is left:
// three loops whose ends and branches can be foreseen better than those of loops in each other.
template <bool any, class View, class Edges, class Act>
FASTRT_INLINE void for_each_pair(const TileTraversal<any, View>& tile, const BlockRun<TriangleBlock>& run,
                                 const Edges& edges, std::uint32_t some, const std::uint32_t* touched,
                                 const Act& act) {
  constexpr int at_once = 64 / batch_groups;
  std::uint64_t pairs[leaf_lanes / at_once] = {};
  for (; some != 0; some &= some - 1) {
    const int i = __builtin_ctz(some);
    std::uint32_t groups = touched[i];
    if (__builtin_popcount(groups) > many_groups)
      groups = groups_inside_edges(tile.view.groups, edges, i, groups);
    pairs[i / at_once] |= static_cast<std::uint64_t>(groups) << (i % at_once * batch_groups);
  }
  alignas(32) std::int32_t ids[leaf_lanes];
  run.store_primitives(ids);
  MetPair met[leaf_lanes * batch_groups];
  int count = 0;
  for (int first = 0; first < leaf_lanes; first += at_once)
    for (std::uint64_t left = pairs[first / at_once]; left != 0; left &= left - 1) {
      const int bit = __builtin_ctzll(left), i = first + bit / batch_groups, g = bit % batch_groups;
      const std::uint32_t rays = rays_inside_edges(tile.points, edges, i, g) & tile.open[g] &
                                 ~rays_that_exclude(tile.rays, g * group_size, ids[i]);
      met[count] = {i, g, rays};
      count += rays != 0 ? 1 : 0;
    }
  for (int k = 0; k < count; ++k) {
    const std::uint32_t rays = any ? met[k].rays & tile.open[met[k].group] : met[k].rays;
    if (rays != 0) act(met[k].triangle, met[k].group, rays);
  }
}

// The triangles of a run in `some` against the groups that they touch, all rays from one origin.
template <bool any>
FASTRT_INLINE void meet_from_origin(TileTraversal<any>& tile, const BlockRun<TriangleBlock>& run,
                                    const BlockSetup& block, const EdgeLines& lines, std::uint32_t some,
                                    const std::uint32_t* touched) {
  for_each_pair(tile, run, lines, some, touched, [&](int i, int g, std::uint32_t rays) {
    const TriangleSetup<PacketF> setup{spread(block, 0, i), spread(block, 3, i), spread(block, 6, i),
                                       spread(block, 9, i), PacketF(block.columns[12][i])};
    const auto reach = [&] { return TriangleReach<PacketF>{spread(block, 13, i), spread(block, 16, i)}; };
    meet_group(tile, g, rays, run.primitive(i), [&](int ray) -> MetLanes {
      const TriangleLanes<PacketF> lanes = intersect_triangle(
          setup, load_dir(tile.rays, ray), rays >> (ray % group_size) & register_bits, reach);
      return {lanes.inside & (lanes.t > PacketF::load_aligned(tile.rays.t_min + ray)), lanes.t};
    });
  });
}

// Triangle i of a run against the rays of group g in `rays`, each from its own origin.
template <bool any, class View>
FASTRT_INLINE void meet_own_origins(TileTraversal<any, View>& tile, const BlockRun<TriangleBlock>& run, int i,
                                    int g, std::uint32_t rays) {
  const V3<PacketF> v0 = spread_vertex<PacketF>(run, 0, i), v1 = spread_vertex<PacketF>(run, 1, i),
                    v2 = spread_vertex<PacketF>(run, 2, i);
  meet_group(tile, g, rays, run.primitive(i), [&](int ray) -> MetLanes {
    const V3<PacketF> origin = load_origin(tile.rays, ray);
    const V3<PacketF> a = v0 - origin, b = v1 - origin, c = v2 - origin;
    const TriangleLanes<PacketF> lanes = intersect_triangle(
        a, b, c, load_dir(tile.rays, ray), largest(origin), rays >> (ray % group_size) & register_bits);
    return {lanes.inside & (lanes.t > PacketF::load_aligned(tile.rays.t_min + ray)), lanes.t};
  });
}

// The triangles of a run in `some` against the groups that they touch, parallel rays.
template <bool any>
FASTRT_INLINE void meet_parallel(TileTraversal<any>& tile, const BlockRun<TriangleBlock>& run,
                                 const EdgeLines& lines, std::uint32_t some, const std::uint32_t* touched) {
  for_each_pair(tile, run, lines, some, touched,
                [&](int i, int g, std::uint32_t rays) { meet_own_origins(tile, run, i, g, rays); });
}

// All lanes of a run that hold primitives.
template <class Block>
FASTRT_INLINE std::uint32_t lanes_of(const BlockRun<Block>& run) {
  return (1U << run.lanes) - 1U;
}

template <bool any>
FASTRT_INLINE void meet_run(TileTraversal<any>& tile, const BlockRun<TriangleBlock>& run,
                            std::uint32_t groups) {
  const TileFrame& f = tile.view.frame;
  const V3<LeafF> origin = broadcast3<LeafF>(f.origin);
  const V3<LeafF> a = load_vertices(run, 0) - origin, b = load_vertices(run, 1) - origin,
                  c = load_vertices(run, 2) - origin;
  const ProjectedTriangles projected = project_triangles(tile.view, a, b, c);
  std::uint32_t touched[leaf_lanes];
  const std::uint32_t some = touch_groups(tile.view.groups, projected.bounds, lanes_of(run), groups, touched);
  if (some == 0) return;
  EdgeLines lines;
  const TriangleReach<LeafF> reach = reach_of(a, b, c, largest(origin));
  if (!f.perspective) {
    lines_from_corners(f, projected.corners, reach, lines);
    meet_parallel(tile, run, lines, some, touched);
    return;
  }
  const TriangleSetup<LeafF> setup = set_up_triangle(a, b, c);
  lines_from_setup(f, setup, reach, lines);
  const BlockSetup stored = store_setup(setup, reach);
  meet_from_origin(tile, run, stored, lines, some, touched);
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
  std::uint32_t some =
      touch_groups(tile.view.groups, project_spheres(tile.view.frame, run), lanes_of(run), groups, touched);
  for (; some != 0; some &= some - 1) {
    const int lane = __builtin_ctz(some);
    const SphereBlock& block = run.block_of(lane);
    const int i = lane % block_size;
    const V3<PacketF> center = broadcast3<PacketF>(block.x[i], block.y[i], block.z[i]);
    const PacketF radius(block.radius[i]);
    for (std::uint32_t left = touched[lane]; left != 0; left &= left - 1) {
      const int g = __builtin_ctz(left);
      meet_group(tile, g, tile.open[g], block.primitive[i], [&](int ray) -> MetLanes {
        const SphereLanes<PacketF> lanes =
            intersect_sphere(center, radius, load_origin(tile.rays, ray), load_dir(tile.rays, ray),
                             PacketF::load_aligned(tile.rays.t_min + ray));
        return {lanes.hit, lanes.t};
      });
    }
  }
}

// The rectangles of boxes whose corners are given relative to the origin.
template <class Frame>
FASTRT_INLINE Rectangles<LeafF> project_box(const Frame& f, const V3<LeafF>& low, const V3<LeafF>& high) {
  const V3<LeafF> half = (high - low) * LeafF(0.5F), middle = low + half;
  const LeafF padding(f.padding);
  const auto at = [&](const V3<float>& axis) { return cull_dot(middle, broadcast3<LeafF>(axis)); };
  const auto reach = [&](const V3<float>& axis) {
    const V3<LeafF> a = broadcast3<LeafF>(axis);
    return cull_dot(V3<LeafF>{abs(a.x), abs(a.y), abs(a.z)}, half) + padding;
  };
  const LeafF u = at(f.u), v = at(f.v), w = at(f.w), ru = reach(f.u), rv = reach(f.v), rw = reach(f.w);
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
    std::uint32_t some = touch_groups(tile.view.groups, boxes, lanes_of(run), groups, touched);
    for (; some != 0; some &= some - 1) {
      const int lane = __builtin_ctz(some);
      const std::int32_t id = run.primitive(lane);
      if (is_no_shape(tile.scene, id)) {
        if (id >= 0) waiting.add(id, boxes.near.get(static_cast<std::size_t>(lane)), touched[lane]);
        continue;
      }
      for (std::uint32_t left = touched[lane]; left != 0; left &= left - 1) {
        const int g = __builtin_ctz(left);
        meet_group(tile, g, tile.open[g], id, [&](int ray) -> MetLanes {
          const ShapeLanes<PacketF> met =
              intersect_shape(tile.scene.shapes, id, load_origin(tile.rays, ray), load_dir(tile.rays, ray),
                              PacketF::load_aligned(tile.rays.t_min + ray));
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
  const auto meet = [&](const auto& run) { meet_run(tile, run, groups); };
  if (leaf_group(leaf) == triangle_group)
    for_each_run(tile.scene.triangles, leaf, meet);
  else if (leaf_group(leaf) == sphere_group)
    for_each_run(tile.scene.spheres, leaf, meet);
  else
    meet_shapes(tile, leaf, groups);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
