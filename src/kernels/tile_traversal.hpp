// SPDX-License-Identifier: Apache-2.0
// A whole batch of rays with a common origin or a common direction through the wide tree at once. A node is
// met once for all rays; each entry of the stack knows which groups of 16 rays it concerns, so deep nodes
// concern few. A block's four triangles are projected together, and set up only if some group can touch them;
// rays of a common origin share the set-up without changing a bit.
#pragma once

#include "src/kernels/tile_edges.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

struct TileEntry {
  std::uint32_t child;
  std::uint32_t groups;
  float near;
};

// All that a traversal carries.
template <bool any>
struct TileTraversal {
  TileTraversal(const GeometryView& s, const RayBatch& r, HitBatch& h, const LiveRays& l)
      : scene(s), rays(r), hits(h), live(l) {}

  const GeometryView& scene;
  const RayBatch& rays;
  HitBatch& hits;
  const LiveRays& live;
  TilePoints points;
  TileView view;
};

// A triangle that covers more groups than this by its rectangle is held against their corners by its edges;
// one that covers fewer against their rays.
inline constexpr int many_groups = 3;

// After a hit: how far the group's rays still look. A group whose rays all have a hit looks nowhere if any
// will do.
template <bool any>
FASTRT_INLINE void shorten_group(TileTraversal<any>& tile, int g) {
  if constexpr (any) {
    std::uint32_t open = 0;
    for (int k = 0; k < group_size; k += widest)
      open |= to_bits(simd::bool_cast(PacketI::load_aligned(tile.hits.primitive + g * group_size + k) <
                                      PacketI(0)))
              << k;
    if ((open & tile.live.bits[g]) == 0) tile.view.groups.far[g] = -__builtin_inff();
  } else {
    tile.view.groups.far[g] = group_far(tile.hits, tile.view.groups, tile.live.bits[g], g);
  }
}

// Rays that have a hit are no points any more.
FASTRT_INLINE void close_rays(TilePoints& points, const PacketI& primitive, int i) {
  const PacketM hit = simd::bool_cast(primitive >= PacketI(0));
  select(hit, PacketF(__builtin_inff()), PacketF::load_aligned(points.x + i)).store_aligned(points.x + i);
}

// One primitive against the rays of group g. meet(dir, origin, t_min) gives the lanes that it hits and their
// t.
template <bool any, class Meet>
FASTRT_INLINE void meet_group(TileTraversal<any>& tile, int g, std::int32_t primitive, const Meet& meet) {
  bool changed = false;
  for (int k = 0; k < group_size; k += widest) {
    const int i = g * group_size + k;
    const auto [hit, t] = meet(i);
    const PacketM counted = hit & from_bits<widest>(tile.live.bits[g] >> k);
    if (to_bits(counted) == 0) continue;
    PacketF best_t = PacketF::load_aligned(tile.hits.t + i);
    PacketI best_primitive = PacketI::load_aligned(tile.hits.primitive + i);
    if (keep_closest(best_t, best_primitive, PacketI::load_aligned(tile.rays.exclude + i), counted, t,
                     primitive) == 0)
      continue;
    best_t.store_aligned(tile.hits.t + i);
    best_primitive.store_aligned(tile.hits.primitive + i);
    if constexpr (any) close_rays(tile.points, best_primitive, i);
    changed = true;
  }
  if (changed) shorten_group(tile, g);
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
  alignas(32) float columns[22][leaf_lanes];
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
  store3(V3<LeafF>{s.slack_a, s.slack_b, s.slack_c}, out.columns[19], out.columns[20], out.columns[21]);
  return out;
}

FASTRT_INLINE V3<PacketF> spread(const BlockSetup& s, int column, int i) {
  return broadcast3<PacketF>(s.columns[column][i], s.columns[column + 1][i], s.columns[column + 2][i]);
}

// Triangle i of a run against the groups in `groups`, all rays from one origin.
template <bool any>
FASTRT_INLINE void meet_from_origin(TileTraversal<any>& tile, const BlockSetup& block, int i,
                                    std::int32_t primitive, std::uint32_t groups) {
  const V3<PacketF> slack = spread(block, 19, i);
  const TriangleSetup<PacketF> setup{spread(block, 0, i),
                                     spread(block, 3, i),
                                     spread(block, 6, i),
                                     spread(block, 9, i),
                                     PacketF(block.columns[12][i]),
                                     slack.x,
                                     slack.y,
                                     slack.z};
  const auto reach = [&] { return TriangleReach<PacketF>{spread(block, 13, i), spread(block, 16, i)}; };
  for (; groups != 0; groups &= groups - 1)
    meet_group(tile, __builtin_ctz(groups), primitive, [&](int ray) -> MetLanes {
      const TriangleLanes<PacketF> lanes = intersect_triangle(setup, load_dir(tile.rays, ray), reach);
      return {lanes.inside & (lanes.t > PacketF::load_aligned(tile.rays.t_min + ray)), lanes.t};
    });
}

// The same for parallel rays, each with its own origin.
template <bool any>
FASTRT_INLINE void meet_parallel(TileTraversal<any>& tile, const BlockRun<TriangleBlock>& run, int i,
                                 std::uint32_t groups) {
  const V3<PacketF> v0 = spread_vertex<PacketF>(run, 0, i), v1 = spread_vertex<PacketF>(run, 1, i),
                    v2 = spread_vertex<PacketF>(run, 2, i);
  for (; groups != 0; groups &= groups - 1)
    meet_group(tile, __builtin_ctz(groups), run.primitive(i), [&](int ray) -> MetLanes {
      const V3<PacketF> origin = load_origin(tile.rays, ray);
      const V3<PacketF> a = v0 - origin, b = v1 - origin, c = v2 - origin;
      const TriangleLanes<PacketF> lanes =
          intersect_triangle(set_up_triangle(a, b, c), load_dir(tile.rays, ray),
                             [&] { return reach_of(a, b, c, largest(origin)); });
      return {lanes.inside & (lanes.t > PacketF::load_aligned(tile.rays.t_min + ray)), lanes.t};
    });
}

struct Sieve {
  bool some; // some triangle touches some group
  bool many; // some triangle touches more than many_groups
};

// The groups that each of the run's triangles touches by its rectangle, and if these are few, with a ray in
// it.
template <bool any>
FASTRT_INLINE Sieve sieve_rectangles(const TileTraversal<any>& tile, const Rectangles<LeafF>& r, int lanes,
                                     std::uint32_t groups, std::uint32_t* touched) {
  alignas(32) float x0[leaf_lanes], x1[leaf_lanes], y0[leaf_lanes], y1[leaf_lanes], near[leaf_lanes];
  r.x0.store_aligned(x0);
  r.x1.store_aligned(x1);
  r.y0.store_aligned(y0);
  r.y1.store_aligned(y1);
  r.near.store_aligned(near);
  Sieve sieve{false, false};
  for (int i = 0; i < lanes; ++i) {
    touched[i] = touched_groups(tile.view.groups, x0[i], x1[i], y0[i], y1[i], near[i]) & groups;
    if (__builtin_popcount(touched[i]) > many_groups)
      sieve.many = true;
    else if (touched[i] != 0)
      touched[i] = groups_with_rays(tile.points, x0[i], x1[i], y0[i], y1[i], touched[i]);
    sieve.some = sieve.some || touched[i] != 0;
  }
  return sieve;
}

template <bool any>
FASTRT_INLINE std::uint32_t sieve_edges(const TileTraversal<any>& tile, const EdgeLines& lines, int i,
                                        std::uint32_t touched) {
  if (__builtin_popcount(touched) <= many_groups) return touched;
  return groups_inside_edges(tile.view.groups, lines, i, touched);
}

template <bool any>
FASTRT_INLINE void meet_run(TileTraversal<any>& tile, const BlockRun<TriangleBlock>& run,
                            std::uint32_t groups) {
  const V3<LeafF> origin = broadcast3<LeafF>(tile.view.frame.origin);
  const V3<LeafF> a = load_vertices(run, 0) - origin, b = load_vertices(run, 1) - origin,
                  c = load_vertices(run, 2) - origin;
  const ProjectedTriangles projected = project_triangles(tile.view, a, b, c);
  std::uint32_t touched[leaf_lanes];
  const Sieve sieve = sieve_rectangles(tile, projected.bounds, run.lanes, groups, touched);
  if (!sieve.some) return;
  EdgeLines lines;
  if (!tile.view.frame.perspective) {
    if (sieve.many) lines_from_corners(tile.view.frame, projected, lines);
    for (int i = 0; i < run.lanes; ++i)
      if (touched[i] != 0) meet_parallel(tile, run, i, sieve_edges(tile, lines, i, touched[i]));
    return;
  }
  const TriangleSetup<LeafF> setup = set_up_triangle(a, b, c);
  if (sieve.many) lines_from_setup(tile.view.frame, setup, lines);
  const BlockSetup stored = store_setup(setup, reach_of(a, b, c, largest(origin)));
  for (int i = 0; i < run.lanes; ++i)
    if (touched[i] != 0)
      meet_from_origin(tile, stored, i, run.primitive(i), sieve_edges(tile, lines, i, touched[i]));
}

// The rectangles of a run's spheres: those of the boxes around them, along the frame's axes.
FASTRT_INLINE Rectangles<LeafF> project_spheres(const TileFrame& f, const BlockRun<SphereBlock>& run) {
  const V3<LeafF> center = load_centers(run) - broadcast3<LeafF>(f.origin);
  const LeafF reach = load_two<LeafF>(run.low->radius, run.high->radius) + LeafF(f.padding);
  const LeafF u = dot(center, broadcast3<LeafF>(f.u)), v = dot(center, broadcast3<LeafF>(f.v)),
              w = dot(center, broadcast3<LeafF>(f.w));
  return project_extent(f, u - reach, u + reach, v - reach, v + reach, w - reach, w + reach);
}

template <bool any>
FASTRT_INLINE void meet_run(TileTraversal<any>& tile, const BlockRun<SphereBlock>& run,
                            std::uint32_t groups) {
  std::uint32_t touched[leaf_lanes];
  const Sieve sieve =
      sieve_rectangles(tile, project_spheres(tile.view.frame, run), run.lanes, groups, touched);
  if (!sieve.some) return;
  for (int lane = 0; lane < run.lanes; ++lane) {
    const SphereBlock& block = run.block_of(lane);
    const int i = lane % block_size;
    const V3<PacketF> center = broadcast3<PacketF>(block.x[i], block.y[i], block.z[i]);
    const PacketF radius(block.radius[i]);
    for (std::uint32_t left = touched[lane]; left != 0; left &= left - 1)
      meet_group(tile, __builtin_ctz(left), block.primitive[i], [&](int ray) -> MetLanes {
        const SphereLanes<PacketF> lanes =
            intersect_sphere(center, radius, load_origin(tile.rays, ray), load_dir(tile.rays, ray),
                             PacketF::load_aligned(tile.rays.t_min + ray));
        return {lanes.hit, lanes.t};
      });
  }
}

template <bool any>
FASTRT_INLINE void meet_leaf(TileTraversal<any>& tile, std::uint32_t leaf, std::uint32_t groups) {
  const auto meet = [&](const auto& run) { meet_run(tile, run, groups); };
  if (leaf_group(leaf) == triangle_group)
    for_each_run(tile.scene.triangles, leaf, meet);
  else
    for_each_run(tile.scene.spheres, leaf, meet);
}

// What will be looked at soon is asked for now: a miss beyond the last cache costs as much as testing a few
// blocks.
FASTRT_INLINE void prefetch_child(const GeometryView& scene, std::uint32_t child) {
  const char* at;
  int lines = 4;
  if (!is_leaf(child)) {
    at = reinterpret_cast<const char*>(&scene.nodes[child]);
  } else if (leaf_group(child) == triangle_group) {
    at = reinterpret_cast<const char*>(&scene.triangles[leaf_first_block(child)]);
    lines = 3;
  } else {
    at = reinterpret_cast<const char*>(&scene.spheres[leaf_first_block(child)]);
    lines = 2;
  }
  for (int i = 0; i < lines; ++i) __builtin_prefetch(at + 64 * i);
}

template <bool any>
FASTRT_INLINE TileEntry* push_children(const TileTraversal<any>& tile, const WideNode& node,
                                       const ChildRectangles& c, std::uint32_t groups, TileEntry* top) {
  TileEntry* const bottom = top;
  for (std::uint32_t bits = c.bits; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctz(bits);
    const std::uint32_t touched =
        touched_groups(tile.view.groups, c.x0[i], c.x1[i], c.y0[i], c.y1[i], c.near[i]) & groups;
    if (touched == 0) continue;
    prefetch_child(tile.scene, node.child[i]);
    const TileEntry entry{node.child[i], touched, c.near[i]};
    TileEntry* place = top++;
    for (; place != bottom && place[-1].near < entry.near; --place) *place = place[-1];
    *place = entry;
  }
  return top;
}

template <bool any>
FASTRT_INLINE void traverse(TileTraversal<any>& tile) {
  TileEntry stack[max_tree_stack];
  stack[0] = {tile.scene.root, (1U << batch_groups) - 1U, -__builtin_inff()};
  TileEntry* top = stack + 1;
  ChildRectangles children;
  while (top != stack) {
    const TileEntry entry = *--top;
    const std::uint32_t groups = entry.groups & far_groups(tile.view.groups, entry.near);
    if (groups == 0) continue;
    if (is_leaf(entry.child)) {
      meet_leaf(tile, entry.child, groups);
      tile.view.far = most_of(tile.view.groups.far);
      continue;
    }
    const WideNode& node = tile.scene.nodes[entry.child];
    project_children(tile.view, node, children);
    top = push_children(tile, node, children, groups, top);
  }
}

// Traces the batch as one; false (and nothing done) if its rays don't allow that. hits: cleared by the
// caller.
template <bool any>
static bool trace_tile(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  const LiveRays live = find_live_rays(rays);
  if (live.first < 0) return true;
  if (live.backwards) return false;
  TileTraversal<any> tile(scene, rays, hits, live);
  tile.view.frame = make_tile_frame(rays, live);
  if (!project_batch(scene, rays, live, tile.view.frame, tile.points, tile.view.groups)) return false;
  for (int g = 0; g < batch_groups; ++g)
    tile.view.groups.far[g] =
        live.bits[g] == 0 ? -__builtin_inff() : group_far(hits, tile.view.groups, live.bits[g], g);
  aim_view(tile.view);
  traverse(tile);
  return true;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
