// SPDX-License-Identifier: Apache-2.0
// Beams of up to 64 neighbouring rays through the wide tree. A node's eight boxes are met at once by each
// group of 16; where a box is small beside the group, its rays are looked at too, and a subtree that few rays
// reach is followed by these alone.
#pragma once

#include "src/kernels/beam_setup.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// With this many rays left in a subtree or fewer, each follows it alone.
inline constexpr int lone_beam_rays = 6;

struct BeamEntry {
  std::uint32_t child;
  float near;
  std::uint64_t rays; // that may reach it
};

// Boxes (or triangles), one per lane, by their extents across the beam and in depth.
template <class F>
struct Extents {
  Extent<F> u, v, w;
};

// Lower and upper planes of a node's boxes along an axis, padded.
template <class F>
FASTRT_INLINE Extent<F> axis_extent(const float* columns, int axis, const F& padding) {
  const float* const lower = columns + 2 * axis * wide_children;
  return {load<F>(lower) - padding, load<F>(lower + wide_children) + padding};
}

template <class F>
FASTRT_INLINE Extent<F> in_depth(const Beam& beam, const Extent<F>& along) {
  const F depth(beam.depth);
  if (beam.backwards) return {negate(along.high) - depth, negate(along.low) - depth};
  return {along.low - depth, along.high - depth};
}

template <bool any>
struct BeamTraversal {
  const GeometryView& scene;
  const RayBatch& rays;
  HitBatch& hits;
  int first; // ray 0 of the beam in the batch
  Beam& beam;
  std::uint64_t open; // rays that still look for a hit
};

// Whether a group can touch the boxes, and whether the boxes are small beside it: bits, a lane each.
struct TouchedLanes {
  std::uint32_t touched, small;
};

template <class F>
FASTRT_INLINE TouchedLanes touch_beam(const BeamGroup& g, const Extents<F>& e) {
  const F zero(0.0F);
  const F begin = max(e.w.low, zero), end = e.w.high;
  const auto low = [&](float x, float slope) {
    return cull_mul_add(F(slope), slope < 0.0F ? end : begin, F(x));
  };
  const auto high = [&](float x, float slope) {
    return cull_mul_add(F(slope), slope < 0.0F ? begin : end, F(x));
  };
  const F x0 = low(g.x0, g.slope_x0), x1 = high(g.x1, g.slope_x1), y0 = low(g.y0, g.slope_y0),
          y1 = high(g.y1, g.slope_y1);
  const MaskOf<F> met = (x0 <= e.u.high) & (x1 >= e.u.low) & (y0 <= e.v.high) & (y1 >= e.v.low) &
                        (end >= zero) & (e.w.low <= F(g.far));
  const MaskOf<F> small = ((x1 - x0) * (y1 - y0)) > F(2.0F) * ((e.u.high - e.u.low) * (e.v.high - e.v.low));
  const std::uint32_t touched = to_bits(met);
  return {touched, to_bits(small) & touched};
}

// One box's extents, for looking at single rays.
struct LoneExtents {
  float u0, u1, v0, v1, w0, w1;
};

// The rays of group g that can touch a box.
FASTRT_INLINE std::uint32_t touch_rays(const BeamRays& rays, const LoneExtents& e, int g) {
  const PacketF begin(e.w0 > 0.0F ? e.w0 : 0.0F), end(e.w1);
  std::uint32_t bits = 0;
  for (int k = 0; k < group_size; k += widest) {
    const int i = g * group_size + k;
    const PacketF x = PacketF::load_aligned(rays.x + i), y = PacketF::load_aligned(rays.y + i);
    const PacketF sx = PacketF::load_aligned(rays.slope_x + i), sy = PacketF::load_aligned(rays.slope_y + i);
    const PacketF xb = cull_mul_add(sx, begin, x), xe = cull_mul_add(sx, end, x);
    const PacketF yb = cull_mul_add(sy, begin, y), ye = cull_mul_add(sy, end, y);
    const PacketM met = (min(xb, xe) <= PacketF(e.u1)) & (max(xb, xe) >= PacketF(e.u0)) &
                        (min(yb, ye) <= PacketF(e.v1)) & (max(yb, ye) >= PacketF(e.v0));
    bits |= to_bits(met) << k;
  }
  return bits;
}

// Children of a node that some ray may reach, and which rays.
struct BeamChildren {
  alignas(32) float extent[6][wide_children]; // u low, u high, v low ..
  std::uint64_t rays[wide_children];
  std::uint32_t bits;
};

FASTRT_INLINE LoneExtents extents_of(const float (&e)[6][wide_children], int i) {
  return {e[0][i], e[1][i], e[2][i], e[3][i], e[4][i], e[5][i]};
}

template <class F>
FASTRT_INLINE void store_extents(const Extents<F>& e, float (&out)[6][wide_children], int at) {
  e.u.low.store_aligned(out[0] + at);
  e.u.high.store_aligned(out[1] + at);
  e.v.low.store_aligned(out[2] + at);
  e.v.high.store_aligned(out[3] + at);
  e.w.low.store_aligned(out[4] + at);
  e.w.high.store_aligned(out[5] + at);
}

FASTRT_INLINE void touch_children(const Beam& beam, const WideNode& node, std::uint64_t rays,
                                  BeamChildren& out) {
  using N = Floats<node_lanes>;
  const N padding(beam.padding);
  std::uint32_t touched[beam_groups] = {}, small[beam_groups] = {};
  out.bits = 0;
  for (int half = 0; half < wide_children; half += node_lanes) {
    const float* const columns = node.lower_x + half;
    const Extents<N> e{axis_extent(columns, beam.x, padding), axis_extent(columns, beam.y, padding),
                       in_depth(beam, axis_extent(columns, beam.z, padding))};
    store_extents(e, out.extent, half);
    for (int g = 0; g < beam_groups; ++g) {
      if (rays_of_group(rays, g) == 0) continue;
      const TouchedLanes lanes = touch_beam(beam.groups[g], e);
      touched[g] |= lanes.touched << half;
      small[g] |= lanes.small << half;
      out.bits |= lanes.touched << half;
    }
  }
  for (std::uint32_t bits = out.bits; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctz(bits);
    std::uint64_t reached = 0;
    for (int g = 0; g < beam_groups; ++g) {
      if ((touched[g] >> i & 1U) == 0) continue;
      const std::uint32_t candidates = ((small[g] >> i & 1U) != 0 || is_leaf(node.child[i]))
                                           ? touch_rays(beam.rays, extents_of(out.extent, i), g)
                                           : 0xFFFFU;
      reached |= static_cast<std::uint64_t>(candidates) << (g * group_size);
    }
    out.rays[i] = reached & rays;
    if (out.rays[i] == 0) out.bits &= ~(1U << i);
  }
}

FASTRT_INLINE BeamEntry* push_children(const GeometryView& scene, const WideNode& node, const BeamChildren& c,
                                       BeamEntry* top) {
  BeamEntry* const bottom = top;
  for (std::uint32_t bits = c.bits; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctz(bits);
    prefetch_child(scene, node.child[i]);
    const BeamEntry entry{node.child[i], c.extent[4][i], c.rays[i]};
    BeamEntry* place = top++;
    for (; place != bottom && place[-1].near < entry.near; --place) *place = place[-1];
    *place = entry;
  }
  return top;
}

// After new hits of the rays in `bits` of group g.
template <bool any>
FASTRT_INLINE void shorten_group(BeamTraversal<any>& t, int g, std::uint32_t bits) {
  if constexpr (any) t.open &= ~(static_cast<std::uint64_t>(bits) << (g * group_size));
  const std::uint32_t open = rays_of_group(t.open, g);
  t.beam.groups[g].far = beam_far(t.beam, t.hits, t.first, g, open);
}

// One primitive against the rays of group g in `bits`.
template <bool any, class Meet>
FASTRT_INLINE std::uint32_t meet_beam_group(BeamTraversal<any>& t, int g, std::uint32_t bits,
                                            std::int32_t primitive, const Meet& meet) {
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

// Triangles of a run in the frame, as columns.
struct FrameTriangles {
  alignas(32) float u[3][leaf_lanes], v[3][leaf_lanes], w[3][leaf_lanes], margin[leaf_lanes];
};

// Coordinates of a run's corners along an axis, where `sign` is set negated and less `offset`; and their
// extent.
FASTRT_INLINE Extent<LeafF> place_corners(const BlockRun<TriangleBlock>& run, int axis, const LeafF& sign,
                                          const LeafF& offset, float (&out)[3][leaf_lanes]) {
  constexpr int column = 3 * block_size;
  LeafF corner[3];
  for (int v = 0; v < 3; ++v) {
    const int at = axis * column + v * block_size;
    corner[v] = flip(load_two<LeafF>(run.low->x[0] + at, run.high->x[0] + at), sign) - offset;
    corner[v].store_aligned(out[v]);
  }
  return {min(corner[0], min(corner[1], corner[2])), max(corner[0], max(corner[1], corner[2]))};
}

FASTRT_INLINE Extent<LeafF> padded(const Extent<LeafF>& e, const LeafF& padding) {
  return {e.low - padding, e.high + padding};
}

// The rays of group g that triangle i lies around: seen along each ray, its corners turn one way.
FASTRT_INLINE std::uint32_t rays_inside(const BeamRays& rays, const FrameTriangles& f, int i, int g) {
  std::uint32_t bits = 0;
  const PacketF margin(f.margin[i]);
  for (int k = 0; k < group_size; k += widest) {
    const int r = g * group_size + k;
    const PacketF rx = PacketF::load_aligned(rays.x + r), ry = PacketF::load_aligned(rays.y + r);
    const PacketF sx = PacketF::load_aligned(rays.slope_x + r), sy = PacketF::load_aligned(rays.slope_y + r);
    PacketF x[3], y[3];
    for (int c = 0; c < 3; ++c) {
      const PacketF w(f.w[c][i]);
      x[c] = cull_less(sx, w, PacketF(f.u[c][i]) - rx);
      y[c] = cull_less(sy, w, PacketF(f.v[c][i]) - ry);
    }
    const PacketF p = cull_mul_sub(x[1], y[2], y[1] * x[2]), q = cull_mul_sub(x[2], y[0], y[2] * x[0]),
                  s = cull_mul_sub(x[0], y[1], y[0] * x[1]);
    bits |= to_bits((min(p, min(q, s)) >= negate(margin)) | (max(p, max(q, s)) <= margin)) << k;
  }
  return bits;
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
        set_up_triangle(a, b, c), load_dir(t.rays, i), [&] { return reach_of(a, b, c, largest(origin)); });
    return {lanes.inside & (lanes.t > PacketF::load_aligned(t.rays.t_min + i)), lanes.t};
  });
}

// What a group's rays have to be tested against.
struct Candidates {
  std::uint32_t rays; // of all triangles
  int triangles;
  std::uint32_t rays_of[leaf_lanes];
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
                                           std::uint32_t rays) {
  std::uint32_t changed = 0;
  for (; rays != 0; rays &= rays - 1) {
    const int lane = __builtin_ctz(rays), i = t.first + g * group_size + lane;
    LoneRay ray;
    ray.origin = {t.rays.origin_x[i], t.rays.origin_y[i], t.rays.origin_z[i]};
    ray.dir = {t.rays.dir_x[i], t.rays.dir_y[i], t.rays.dir_z[i]};
    ray.t_min = t.rays.t_min[i];
    ray.exclude = t.rays.exclude[i];
    shorten(ray, t.hits.t[i], t.hits.primitive[i]);
    meet_run(ray, run);
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
  const LeafF side = max(e.u.high - e.u.low, max(e.v.high - e.v.low, e.w.high - e.w.low));
  (side * LeafF(4.0F * beam.padding)).store_aligned(f.margin);
  for (int g = 0; g < beam_groups; ++g) {
    const std::uint32_t group = rays_of_group(rays, g);
    if (group == 0) continue;
    const Candidates found = find_candidates(beam, f, touch_beam(beam.groups[g], e).touched, g, group);
    if (found.rays == 0) continue;
    const std::uint32_t changed = __builtin_popcount(found.rays) * widest <= found.triangles * lone_test_share
                                      ? meet_run_alone(t, run, g, found.rays)
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

template <bool any>
[[gnu::noinline]] static void meet_shapes(BeamTraversal<any>& t, const BlockRun<ShapeBlock>& run,
                                          std::uint64_t rays) noexcept {
  const Extents<LeafF> e = extents_of_shapes(t.beam, run);
  for (int g = 0; g < beam_groups; ++g) {
    const std::uint32_t group = rays_of_group(rays, g);
    if (group == 0) continue;
    std::uint32_t changed = 0;
    for (std::uint32_t lanes = touch_beam(t.beam.groups[g], e).touched; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      const std::int32_t id = run.primitive(lane);
      if (id < 0 || lane >= run.lanes) continue;
      changed |= meet_beam_group(t, g, group, id, [&](int i) -> MetLanes {
        const ShapeLanes<PacketF> met =
            intersect_shape(t.scene.shapes, id, load_origin(t.rays, i), load_dir(t.rays, i),
                            PacketF::load_aligned(t.rays.t_min + i));
        return {met.hit, met.t};
      });
    }
    if (changed != 0) shorten_group(t, g, changed);
  }
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

template <bool any>
FASTRT_INLINE void go_on_alone(BeamTraversal<any>& t, std::uint32_t child, std::uint64_t rays) {
  std::uint8_t which[beam_size];
  int count = 0;
  for (std::uint64_t bits = rays; bits != 0; bits &= bits - 1)
    which[count++] = static_cast<std::uint8_t>(t.first + __builtin_ctzll(bits));
  trace_lone_rays<any>(t.scene, {t.rays, t.hits, child, which, which + count});
  for (int g = 0; g < beam_groups; ++g) {
    std::uint32_t found = 0;
    for (std::uint32_t bits = rays_of_group(rays, g); bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      if (t.hits.primitive[t.first + g * group_size + i] >= 0) found |= 1U << i;
    }
    if (found != 0) shorten_group(t, g, found);
  }
}

// The rays of an entry to which it still matters.
template <bool any>
FASTRT_INLINE std::uint64_t still_looking(const BeamTraversal<any>& t, const BeamEntry& entry) {
  std::uint64_t rays = entry.rays & t.open;
  for (int g = 0; g < beam_groups; ++g)
    if (!(t.beam.groups[g].far >= entry.near)) rays &= ~(0xFFFFULL << (g * group_size));
  return rays;
}

template <bool any>
static void traverse_beam(BeamTraversal<any>& t) noexcept {
  BeamEntry stack[max_tree_stack];
  stack[0] = {t.scene.root, -__builtin_inff(), t.open};
  BeamEntry* top = stack + 1;
  BeamChildren children;
  while (top != stack) {
    const BeamEntry entry = *--top;
    const std::uint64_t rays = still_looking(t, entry);
    if (rays == 0) continue;
    if (__builtin_popcountll(rays) <= lone_beam_rays) {
      go_on_alone(t, entry.child, rays);
      continue;
    }
    if (is_leaf(entry.child)) {
      meet_leaf(t, entry.child, rays);
      continue;
    }
    const WideNode& node = t.scene.nodes[entry.child];
    touch_children(t.beam, node, rays, children);
    top = push_children(t.scene, node, children, top);
  }
}

// Traces rays first .. first + count - 1 (count: a multiple of group_size) as one; false (and nothing done)
// if they point too widely apart.
template <bool any>
static bool trace_beam(const GeometryView& scene, const RayBatch& rays, HitBatch& hits, int first,
                       int count) noexcept {
  Beam beam;
  if (!make_beam(scene, rays, first, count, beam)) return false;
  BeamTraversal<any> t{scene, rays, hits, first, beam, beam.live};
  for (int g = 0; g < count / group_size; ++g)
    beam.groups[g].far = beam_far(beam, hits, first, g, rays_of_group(beam.live, g));
  traverse_beam(t);
  return true;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
