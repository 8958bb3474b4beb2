// SPDX-License-Identifier: Apache-2.0
// A packet of as many rays as a register has lanes through the wide tree: one child's box against all rays,
// one primitive against all rays. Where a packet has fallen apart, its rays go on alone, after all packets.
#pragma once

#include "src/kernels/ray_traversal.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// With this many rays left in a subtree or fewer, each is to follow it alone, after the packets.
inline constexpr int lone_ray_limit = widest / 4;

// How the rays meet the planes across one axis of space; the numbers are those of lone rays (LoneFields).
struct PacketAxis {
  PacketF inverse, near_start, far_start;
  PacketM backwards;
};

struct Packet {
  V3<PacketF> origin, dir;
  PacketAxis x, y, z;
  PacketF t_min, t;
  PacketI exclude, primitive;
};

// What waits: a subtree, and the rays that met its box. Where, matters to each of those that look for the
// closest hit; to others it is a matter of order alone.
struct PacketEntry {
  std::uint32_t child;
  std::uint32_t bits;
  alignas(64) float near[widest];
};
struct alignas(16) AnyPacketEntry {
  std::uint32_t child;
  std::uint32_t bits;
  float near; // of the first of them
};

FASTRT_INLINE PacketAxis load_axis(const LoneColumns& columns, int axis, int first) {
  const PacketF inverse = PacketF::load_aligned(columns.inverse[axis] + first);
  return {inverse, PacketF::load_aligned(columns.near_start[axis] + first),
          PacketF::load_aligned(columns.far_start[axis] + first), inverse < PacketF(0.0F)};
}

FASTRT_INLINE Packet load_packet(const GeometryView& scene, const RayBatch& rays, const HitBatch& hits,
                                 LoneColumns& columns, int first) {
  if ((columns.ready >> first / group_size & 1U) == 0)
    prepare_group(columns, rays, scene.largest_coordinate, first / group_size);
  Packet p;
  p.origin = load3<PacketF>(rays.origin_x + first, rays.origin_y + first, rays.origin_z + first);
  p.dir = load3<PacketF>(rays.dir_x + first, rays.dir_y + first, rays.dir_z + first);
  p.x = load_axis(columns, 0, first);
  p.y = load_axis(columns, 1, first);
  p.z = load_axis(columns, 2, first);
  p.t_min = load<PacketF>(rays.t_min + first);
  p.t = load<PacketF>(hits.t + first);
  p.exclude = load<PacketI>(rays.exclude + first);
  p.primitive = load<PacketI>(hits.primitive + first);
  return p;
}

// Takes hits at `t` of one primitive for the lanes in `hit`: smallest t first, then smallest id. Returns the
// lanes that took it.
FASTRT_INLINE std::uint32_t keep_closest(PacketF& best_t, PacketI& best_primitive, const PacketI& exclude,
                                         const PacketM& hit, const PacketF& t, std::int32_t primitive) {
  const PacketI id(primitive);
  const PacketM earlier = simd::bool_cast(id < best_primitive);
  const PacketM other = simd::bool_cast(id != exclude);
  const PacketM closer = hit & ((t < best_t) | ((t == best_t) & earlier)) & other;
  const std::uint32_t bits = to_bits(closer);
  if (bits == 0) return 0;
  best_t = select(closer, t, best_t);
  best_primitive = select_ints<PacketF>(closer, id, best_primitive);
  return bits;
}

FASTRT_INLINE V3<PacketF> vertex(const TriangleBlock& block, int v, int i) {
  return broadcast3<PacketF>(block.x[v][i], block.y[v][i], block.z[v][i]);
}

// Where the rays are between two planes. Rays of one packet may point either way, so each lane picks its own
// near plane.
FASTRT_INLINE SlabLanes<PacketF> meet_slab(const PacketAxis& a, const PacketF& low, const PacketF& high) {
  return {cull_mul_sub(select(a.backwards, high, low), a.inverse, a.near_start),
          cull_mul_sub(select(a.backwards, low, high), a.inverse, a.far_start)};
}

// The packet's slab test against a box, as lone rays do it. bound: depth_bound(p.t).
FASTRT_INLINE SlabLanes<PacketF> meet_box(const Packet& p, const PacketF& bound, float low_x, float high_x,
                                          float low_y, float high_y, float low_z, float high_z) {
  const SlabLanes<PacketF> x = meet_slab(p.x, PacketF(low_x), PacketF(high_x)),
                           y = meet_slab(p.y, PacketF(low_y), PacketF(high_y)),
                           z = meet_slab(p.z, PacketF(low_z), PacketF(high_z));
  return {max(x.near, max(y.near, max(z.near, p.t_min))), min(x.far, min(y.far, min(z.far, bound)))};
}

// The batch that a packet is part of: rays first .. first + widest - 1. What it puts off is traced later.
struct PacketBatch {
  const RayBatch& rays;
  HitBatch& hits;
  LoneColumns& columns;
  LoneLater& later;
  int first;
};

template <bool any>
FASTRT_INLINE void meet_instance(const GeometryView& scene, const PacketBatch& batch, Packet& p,
                                 std::uint32_t active, std::int32_t id) {
  p.t.store_unaligned(batch.hits.t + batch.first);
  p.primitive.store_unaligned(batch.hits.primitive + batch.first);
  InstanceVisit visit;
  visit.unit = 1;
  visit.count = 0;
  add_rays(visit, batch.first, active);
  std::uint32_t changed[batch_groups] = {};
  meet_instance<any>(scene, batch.rays, batch.hits, id, visit, changed);
  p.t = load<PacketF>(batch.hits.t + batch.first);
  p.primitive = load<PacketI>(batch.hits.primitive + batch.first);
}

// The packet against the shapes of a leaf, each met by those rays that meet its box.
template <bool any>
[[gnu::noinline]] static void meet_shapes(const GeometryView& scene, const PacketBatch& batch, Packet& p,
                                          std::uint32_t active, std::uint32_t leaf) noexcept {
  const ShapeBlock* block = scene.shape_blocks + leaf_first_block(leaf);
  for (const ShapeBlock* const end = block + leaf_blocks(leaf); block != end; ++block)
    for (int i = 0; i < block_size && block->primitive[i] >= 0; ++i) {
      const SlabLanes<PacketF> slab =
          meet_box(p, depth_bound(p.t), block->low_x[i], block->high_x[i], block->low_y[i], block->high_y[i],
                   block->low_z[i], block->high_z[i]);
      const std::uint32_t met_box = to_bits(slab.near <= slab.far) & active;
      if (met_box == 0) continue;
      if (is_no_shape(scene, block->primitive[i])) {
        meet_instance<any>(scene, batch, p, active, block->primitive[i]);
        continue;
      }
      const PacketM self = simd::bool_cast(p.exclude == PacketI(block->primitive[i]));
      const std::uint32_t asked = met_box & ~to_bits(self);
      if (asked == 0) continue;
      const ShapeLanes<PacketF> met =
          intersect_shape(scene.shapes, block->primitive[i], p.origin, p.dir, {p.t_min, p.t, asked});
      const PacketM hit = met.hit & from_bits<widest>(asked);
      if (to_bits(hit) != 0) keep_closest(p.t, p.primitive, p.exclude, hit, met.t, block->primitive[i]);
    }
}

template <bool any>
FASTRT_INLINE void meet_leaf(const GeometryView& scene, const PacketBatch& batch, Packet& p,
                             const PacketM& active, std::uint32_t leaf) {
  if (leaf_group(leaf) == shape_group) {
    Packet met = p; // a copy, so that the packet itself need not have an address
    meet_shapes<any>(scene, batch, met, to_bits(active), leaf);
    p.t = met.t;
    p.primitive = met.primitive;
    return;
  }
  const std::uint32_t active_bits = to_bits(active), first = leaf_first_block(leaf);
  const std::uint32_t end = first + leaf_blocks(leaf);
  for (std::uint32_t b = first; b != end; ++b)
    for (int i = 0; i < block_size; ++i) {
      if (leaf_group(leaf) == triangle_group) {
        const TriangleBlock& block = scene.triangles[b];
        if (block.primitive[i] < 0) break;
        const V3<PacketF> v0 = vertex(block, 0, i) - p.origin, v1 = vertex(block, 1, i) - p.origin,
                          v2 = vertex(block, 2, i) - p.origin;
        const TriangleLanes<PacketF> lanes =
            intersect_triangle(v0, v1, v2, p.dir, largest(p.origin), active_bits);
        const PacketM hit = lanes.inside & active & (lanes.t > p.t_min);
        if (to_bits(hit) != 0) keep_closest(p.t, p.primitive, p.exclude, hit, lanes.t, block.primitive[i]);
      } else {
        const SphereBlock& block = scene.spheres[b];
        if (block.primitive[i] < 0) break;
        const SphereLanes<PacketF> lanes =
            intersect_sphere(broadcast3<PacketF>(block.x[i], block.y[i], block.z[i]),
                             PacketF(block.radius[i]), p.origin, p.dir, p.t_min, active_bits);
        const PacketM hit = lanes.hit & active;
        if (to_bits(hit) != 0) keep_closest(p.t, p.primitive, p.exclude, hit, lanes.t, block.primitive[i]);
      }
    }
}

// The packet's slab test against child i of a node.
FASTRT_INLINE SlabLanes<PacketF> meet_child(const Packet& p, const PacketF& bound, const WideNode& node,
                                            int i) {
  return meet_box(p, bound, node.lower_x[i], node.upper_x[i], node.lower_y[i], node.upper_y[i],
                  node.lower_z[i], node.upper_z[i]);
}

// A node's children as the packet meets them; met: those that some ray meets. (All of them first, without
// branches: which it will be can hardly be foreseen.)
struct MetChildren {
  alignas(64) float near[wide_children][widest];
  std::uint32_t bits[wide_children];
  std::uint32_t met;
};

FASTRT_INLINE void meet_children(const Packet& p, const WideNode& node, std::uint32_t active,
                                 MetChildren& out) {
  const PacketF bound = depth_bound(p.t);
  out.met = 0;
  for (int i = 0; i < wide_children; ++i) {
    const SlabLanes<PacketF> slab = meet_child(p, bound, node, i);
    out.bits[i] = to_bits(slab.near <= slab.far) & active;
    out.met |= static_cast<std::uint32_t>(out.bits[i] != 0) << i;
    slab.near.store_aligned(out.near[i]);
  }
}

// Child i onto the stack, the nearest on top.
FASTRT_INLINE PacketEntry* push_ordered(PacketEntry* top, PacketEntry* bottom, const WideNode& node,
                                        const MetChildren& c, int i) {
  const int lane = __builtin_ctz(c.bits[i]);
  PacketEntry* place = top;
  for (; place != bottom && place[-1].near[lane] < c.near[i][lane]; --place) *place = place[-1];
  place->child = node.child[i];
  place->bits = c.bits[i];
  PacketF::load_aligned(c.near[i]).store_aligned(place->near);
  return top + 1;
}

// The same for rays that any hit will do for.
FASTRT_INLINE AnyPacketEntry* push_ordered(AnyPacketEntry* top, AnyPacketEntry* bottom, const WideNode& node,
                                           const MetChildren& c, int i) {
  const float near = c.near[i][__builtin_ctz(c.bits[i])];
  AnyPacketEntry* place = top;
  for (; place != bottom && place[-1].near < near; --place) *place = place[-1];
  store_together(node.child[i], c.bits[i], __builtin_bit_cast(std::uint32_t, near), 0, place);
  return top + 1;
}

// The rays of an entry that it still matters to.
FASTRT_INLINE std::uint32_t still_active(const Packet& p, const PacketEntry& entry) {
  return entry.bits & to_bits(PacketF::load_aligned(entry.near) <= depth_bound(p.t));
}
FASTRT_INLINE std::uint32_t still_active(const Packet& p, const AnyPacketEntry& entry) {
  return entry.bits & to_bits(simd::bool_cast(p.primitive < PacketI(0)));
}

// Where the ray in a lane meets the entry's box, as far as is known.
FASTRT_INLINE float near_of(const PacketEntry& entry, int lane) { return entry.near[lane]; }
FASTRT_INLINE float near_of(const AnyPacketEntry&, int) { return 0.0F; }

// The rays in `bits` are to follow the entry's subtree alone. (Leaves are met at once: what lies behind their
// hits need not be looked at.)
template <bool any, class Entry>
FASTRT_INLINE void go_on_alone(const GeometryView& scene, const PacketBatch& batch, const Entry& entry,
                               std::uint32_t bits, Packet& p) {
  bool room = true;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    room &= put_off(batch.later, batch.first + lane, entry.child, near_of(entry, lane));
  }
  if (room) return;
  p.t.store_unaligned(batch.hits.t + batch.first);
  p.primitive.store_unaligned(batch.hits.primitive + batch.first);
  trace_later<any>(scene, batch.rays, batch.hits, batch.columns, batch.later);
  p.t = load<PacketF>(batch.hits.t + batch.first);
  p.primitive = load<PacketI>(batch.hits.primitive + batch.first);
}

// A packet of the batch. What it puts off is still to be traced.
template <bool any>
static void trace_packet(const GeometryView& scene, const PacketBatch& batch) noexcept {
  using Entry = std::conditional_t<any, AnyPacketEntry, PacketEntry>;
  const auto& [rays, hits, columns, later, first] = batch;
  Packet p = load_packet(scene, rays, hits, columns, first);
  const std::uint32_t live = to_bits(traceable_lanes(p.origin, p.dir, rays.count - first) & (p.t_min < p.t));
  if (live == 0) return;
  Entry stack[max_tree_stack];
  stack[0].child = scene.root;
  stack[0].bits = live;
  if constexpr (!any) p.t_min.store_aligned(stack[0].near);
  std::uint32_t nodes = 0, tests = 0;
  Entry* top = stack + 1;
  MetChildren children;
  while (top != stack) {
    --top;
    const std::uint32_t child = top->child;
    const std::uint32_t active_bits = still_active(p, *top);
    if (active_bits == 0) continue;
    if (is_leaf(child)) {
      meet_leaf<any>(scene, batch, p, from_bits<widest>(active_bits), child);
      tests += static_cast<std::uint32_t>(__builtin_popcount(active_bits)) * leaf_blocks(child);
      continue;
    }
    if (__builtin_popcount(active_bits) <= lone_ray_limit) {
      go_on_alone<any>(scene, batch, *top, active_bits, p);
      continue;
    }
    const WideNode& node = scene.nodes[child];
    ++nodes;
    meet_children(p, node, active_bits, children);
    Entry* const bottom = top;
    for (std::uint32_t met = children.met; met != 0; met &= met - 1)
      top = push_ordered(top, bottom, node, children, __builtin_ctz(met));
  }
  p.t.store_unaligned(hits.t + first);
  p.primitive.store_unaligned(hits.primitive + first);
  count_tests(hits, nodes, std::uint64_t{tests} * block_size);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
