// SPDX-License-Identifier: Apache-2.0
// A tile and triangles: as many as fill a register are projected and sieved, and what is left is tested with
// one register of rays at a time. Rays of a common origin share a triangle's set-up without changing a bit.
#pragma once

#include "src/kernels/tile_certain.hpp"
#include "src/kernels/tile_pairs.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Set-ups and reaches of a run as columns, so that one can be spread over a register.
struct RunSetup {
  alignas(64) float columns[19][widest];
};

FASTRT_INLINE RunSetup store_setup(const TriangleSetup<PacketF>& s, const TriangleReach<PacketF>& r) {
  RunSetup out;
  store3(s.edge_a, out.columns[0], out.columns[1], out.columns[2]);
  store3(s.edge_b, out.columns[3], out.columns[4], out.columns[5]);
  store3(s.edge_c, out.columns[6], out.columns[7], out.columns[8]);
  store3(s.normal, out.columns[9], out.columns[10], out.columns[11]);
  s.offset.store_aligned(out.columns[12]);
  store3(r.low, out.columns[13], out.columns[14], out.columns[15]);
  store3(r.high, out.columns[16], out.columns[17], out.columns[18]);
  return out;
}

FASTRT_INLINE V3<PacketF> spread(const RunSetup& s, int column, int i) {
  return broadcast3<PacketF>(s.columns[column][i], s.columns[column + 1][i], s.columns[column + 2][i]);
}

// Vertex v of a run's triangles.
FASTRT_INLINE V3<PacketF> load_vertices(const TriangleRun& run, int v) {
  const float *x[TriangleRun::most_blocks], *y[TriangleRun::most_blocks], *z[TriangleRun::most_blocks];
  for (int k = 0; k < TriangleRun::most_blocks; ++k) {
    x[k] = run.block[k]->x[v];
    y[k] = run.block[k]->y[v];
    z[k] = run.block[k]->z[v];
  }
  return {load_quads<PacketF>(x), load_quads<PacketF>(y), load_quads<PacketF>(z)};
}

// What the edges of a run's triangles let through of the listed pairs: act(triangle, group, rays). First all
// pairs against the rays, then what is left: two loops whose branches can be foreseen better than those of
// one.
template <bool any, class View, class Edges, class Act>
FASTRT_INLINE void for_each_pair(const TileTraversal<any, View>& tile, const TriangleRun& run,
                                 const Edges& edges, const PairList& list, const Act& act) {
  alignas(64) std::int32_t ids[widest];
  for (int k = 0; k < TriangleRun::most_blocks; ++k)
    load<Ints<block_size>>(run.block[k]->primitive).store_aligned(ids + k * block_size);
  MetPair met[widest * batch_groups];
  int count = 0;
  for_each_listed(list, [&](MetPair pair) {
    const int i = triangle_of(pair), g = group_of(pair);
    const std::uint32_t rays = rays_inside_edges(tile.points, edges, i, g) & tile.open[g] &
                               ~rays_that_exclude(tile.rays, g * group_size, ids[i]);
    met[count] = pair | rays;
    count += rays != 0 ? 1 : 0;
  });
  for (int k = 0; k < count; ++k) {
    const int group = group_of(met[k]);
    const std::uint32_t all = rays_of(met[k]), rays = any ? all & tile.open[group] : all;
    if (rays != 0) act(triangle_of(met[k]), group, rays);
  }
}

// Whether what is certain of rays that ask for any hit is looked for before a triangle's own test: of more
// than one, where a register holds a group. (Elsewhere it takes longer than it saves.)
template <bool any>
FASTRT_INLINE bool may_be_certain(std::uint32_t rays) {
  return any && widest == group_size && (rays & (rays - 1)) != 0;
}

// Triangle i of a run against the rays of group g in `rays`, all from one origin.
template <bool any, class View>
FASTRT_INLINE void meet_from_origin(TileTraversal<any, View>& tile, const TriangleRun& run,
                                    const RunSetup& stored, int i, int g, std::uint32_t rays) {
  const TriangleSetup<PacketF> setup{spread(stored, 0, i), spread(stored, 3, i), spread(stored, 6, i),
                                     spread(stored, 9, i), PacketF(stored.columns[12][i])};
  const auto reach = [&] { return TriangleReach<PacketF>{spread(stored, 13, i), spread(stored, 16, i)}; };
  meet_group(tile, g, rays, run.primitive(i), [&](int ray) -> MetLanes {
    const TriangleLanes<PacketF> lanes = intersect_triangle(
        setup, load_dir(tile.rays, ray), rays >> (ray % group_size) & register_bits, reach);
    return {lanes.inside & (lanes.t > PacketF::load_aligned(tile.rays.t_min + ray)), lanes.t};
  });
}

// Triangle i of a run against the rays of group g in `rays`, each from its own origin.
template <bool any, class View>
FASTRT_INLINE void meet_own_origins(TileTraversal<any, View>& tile, const TriangleRun& run, int i, int g,
                                    std::uint32_t rays) {
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

// The listed pairs of a run. make_planes(planes): of the triangles; meet(triangle, group, rays): by the
// triangle's own test.
template <bool any, class View, class MakePlanes, class Meet>
FASTRT_INLINE void meet_pairs(TileTraversal<any, View>& tile, const TriangleRun& run, const EdgeLines& lines,
                              const PairList& list, const MakePlanes& make_planes, const Meet& meet) {
  [[maybe_unused]] PlaneLines planes;
  [[maybe_unused]] bool has_planes = false;
  for_each_pair(tile, run, lines, list, [&](int i, int g, std::uint32_t rays) {
    if constexpr (any)
      if (may_be_certain<any>(rays)) {
        if (!has_planes) make_planes(planes);
        has_planes = true;
        rays = keep_certain(tile, run, lines, planes, i, g, rays);
        if (rays == 0) return;
      }
    meet(i, g, rays);
  });
}

template <bool any, class View>
FASTRT_INLINE void meet_run(TileTraversal<any, View>& tile, const TriangleRun& run) {
  const TileFrame& f = tile.view.frame;
  const V3<PacketF> origin = broadcast3<PacketF>(f.origin);
  const V3<PacketF> a = load_vertices(run, 0) - origin, b = load_vertices(run, 1) - origin,
                    c = load_vertices(run, 2) - origin;
  const ProjectedTriangles projected = project_triangles(tile.view, a, b, c);
  TouchedRun touched;
  touch_run(tile.view, run, projected.bounds, touched);
  if (touched.some == 0) return;
  EdgeLines lines;
  PairList list;
  const TriangleReach<PacketF> reach = reach_of(a, b, c, largest(origin));
  if constexpr (View::begins_apart) {
    lines_from_corners(f, projected.corners, reach, lines);
    list_pairs(tile.view, run, projected.bounds, touched, lines, list);
    meet_pairs(
        tile, run, lines, list,
        [&](PlaneLines& p) { planes_from_corners(f, tile.view.groups.depth_scale[0], a, b, c, p); },
        [&](int i, int g, std::uint32_t rays) { meet_own_origins(tile, run, i, g, rays); });
  } else {
    const TriangleSetup<PacketF> setup = set_up_triangle(a, b, c);
    lines_from_setup(f, setup, reach, lines);
    const RunSetup stored = store_setup(setup, reach);
    list_pairs(tile.view, run, projected.bounds, touched, lines, list);
    meet_pairs(
        tile, run, lines, list, [&](PlaneLines& p) { planes_from_setup(f, setup, p); },
        [&](int i, int g, std::uint32_t rays) { meet_from_origin(tile, run, stored, i, g, rays); });
  }
}

// Meets what waits.
template <bool any, class View>
[[gnu::noinline]] static void meet_waiting(TileTraversal<any, View>& tile) noexcept {
  TriangleRun& run = tile.waiting;
  // Places that are left repeat a block, and count for nothing.
  for (int k = run.count; k < TriangleRun::most_blocks; ++k) run.block[k] = run.block[0];
  meet_run(tile, run);
  run.count = 0;
}

// The triangles of a leaf, and the groups that reached it. (Leaves are about as large as narrow registers:
// there nothing waits for the next leaf.)
template <bool any, class View>
FASTRT_INLINE void add_triangles(TileTraversal<any, View>& tile, std::uint32_t leaf, std::uint32_t groups) {
  TriangleRun& run = tile.waiting;
  const TriangleBlock* block = tile.scene.triangles + leaf_first_block(leaf);
  for (const TriangleBlock* const end = block + leaf_blocks(leaf); block != end; ++block) {
    run.block[run.count] = block;
    run.groups[run.count] = groups;
    if (++run.count == TriangleRun::most_blocks) meet_waiting(tile);
  }
  if (TriangleRun::most_blocks <= 2 && run.count != 0) meet_waiting(tile);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
