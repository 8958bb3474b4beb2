// SPDX-License-Identifier: Apache-2.0
// Rays that meet an instance go on in the prototype's own tree, as a batch of their own: docs/numerics.md,
// "Instances". t is the same in both spaces, and rays with one origin or one direction keep that.
#pragma once

#include "src/kernels/slab.hpp"
#include "src/kernels/triangle.hpp"
#include "src/trace/ray_batch.hpp"
#include "src/trace/scene_view.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Nothing hit yet. Fills up to the next full group, so that kernels may read whole ones.
FASTRT_INLINE void clear_hits(const RayBatch& rays, HitBatch& hits) {
  for (int i = 0; i < (rays.count + group_size - 1) / group_size * group_size; i += widest) {
    load<Floats<widest>>(rays.t_max + i).store_aligned(hits.t + i);
    Ints<widest>(-1).store_aligned(hits.primitive + i);
  }
}

// All rays of a batch through the tree at scene.root.
template <bool any>
static void trace_tree(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept;

template <class F>
FASTRT_INLINE V3<F> map_vector(const float (&map)[4][3], const V3<F>& v) {
  return (broadcast3<F>(map[0]) * v.x + broadcast3<F>(map[1]) * v.y) + broadcast3<F>(map[2]) * v.z;
}
template <class F>
FASTRT_INLINE V3<F> map_point(const float (&map)[4][3], const V3<F>& p) {
  return map_vector(map, p) + broadcast3<F>(map[3]);
}

// Rays of the world, one per lane, before an instance.
template <class F>
struct WorldRays {
  V3<F> origin, dir;
  F t_min, t_max, best; // best: of the closest hit so far
};

// From where to where the rays are in the box, a little larger for the rounding, and in their own interval.
template <class F>
struct Passage {
  F from, to;
};

template <class F>
FASTRT_INLINE Passage<F> inside_box(const InstanceRow& row, const WorldRays<F>& rays) {
  V3<F> low = broadcast3<F>(row.low) - rays.origin, high = broadcast3<F>(row.high) - rays.origin;
  const F share(reach_margin), zero(0.0F), one(1.0F);
  const F margin = max(largest(low), largest(high)) * share + largest(rays.origin) * share;
  low = {low.x - margin, low.y - margin, low.z - margin};
  high = {high.x + margin, high.y + margin, high.z + margin};
  const F ix = one / rays.dir.x, iy = one / rays.dir.y, iz = one / rays.dir.z;
  const MaskOf<F> bx = ix < zero, by = iy < zero, bz = iz < zero;
  return {max(select(bx, high.x, low.x) * ix,
              max(select(by, high.y, low.y) * iy, max(select(bz, high.z, low.z) * iz, rays.t_min))),
          min(select(bx, low.x, high.x) * ix,
              min(select(by, low.y, high.y) * iy, min(select(bz, low.z, high.z) * iz, rays.t_max)))};
}

// Rays in object space, and where each comes from.
struct alignas(64) InstanceRays {
  RayBatch rays;
  HitBatch hits;
  float from[batch_size], to[batch_size];
  std::uint8_t index[batch_size]; // in the batch of the world
};

// Puts the lanes in `bits` into rows `at` .., those that don't meet the instance as rays that hit nothing.
// Returns the ones that do.
template <class F>
FASTRT_INLINE std::uint32_t enter_instance(const InstanceRow& row, const WorldRays<F>& rays,
                                           std::uint32_t bits, int at, InstanceRays& to) {
  const V3<F> origin = map_point(row.to_object, rays.origin), dir = map_vector(row.to_object, rays.dir);
  const Passage<F> inside = inside_box(row, rays);
  // A map may send rays to infinity.
  const MaskOf<F> met = (inside.from < inside.to) & are_traceable(origin, dir) & from_bits<width_of<F>>(bits);
  store3(origin, to.rays.origin_x + at, to.rays.origin_y + at, to.rays.origin_z + at);
  store3(dir, to.rays.dir_x + at, to.rays.dir_y + at, to.rays.dir_z + at);
  rays.t_min.store_unaligned(to.rays.t_min + at);
  // What is farther than the best hit is of no use, but for a hit that is to be moved back to the box's end.
  // At equal t ids decide, so that one must get through.
  const F limit = min(depth_bound(rays.best) + F(1e-37F), rays.t_max);
  const F far = select(inside.to <= rays.best, rays.t_max, limit);
  select(met, far, rays.t_min).store_unaligned(to.rays.t_max + at);
  inside.from.store_unaligned(to.from + at);
  inside.to.store_unaligned(to.to + at);
  return to_bits(met);
}

// The rays of `to` through the prototype's tree, and what that finds back to the world. Rays that have a new
// hit are added to `changed`: bit l of word g is ray 16 g + l.
template <bool any>
FASTRT_INLINE void trace_instance(const GeometryView& scene, std::int32_t id, InstanceRays& to,
                                  HitBatch& hits, std::uint32_t* changed) {
  const InstanceRow& row = scene.shapes.instances[id - scene.shapes.first_instance];
  GeometryView inside = scene;
  inside.root = row.root;
  inside.largest_coordinate = row.largest_coordinate;
  clear_hits(to.rays, to.hits);
  to.hits.boxes = to.hits.primitives = to.hits.lone = 0;
  trace_tree<any>(inside, to.rays, to.hits);
  hits.boxes += to.hits.boxes;
  hits.primitives += to.hits.primitives;
  hits.lone += to.hits.lone;
  for (int k = 0; k < to.rays.count; ++k) {
    if (to.hits.primitive[k] < 0) continue;
    // Rounding may have moved the hit out of the box.
    float t = to.hits.t[k];
    t = t < to.from[k] ? to.from[k] : t;
    t = t > to.to[k] ? to.to[k] : t;
    const int i = to.index[k];
    if (!(t < hits.t[i] || (t == hits.t[i] && id < hits.primitive[i]))) continue;
    hits.t[i] = t;
    hits.primitive[i] = id;
    hits.inner[i] = to.hits.primitive[k];
    changed[i / group_size] |= 1U << (i % group_size);
  }
}

// Which rays of a batch go to see an instance: registers of rays, `unit` of them together.
struct InstanceVisit {
  int unit, count;
  std::uint8_t first[batch_size / widest];
  std::uint16_t bits[batch_size / widest];
};

FASTRT_INLINE void add_rays(InstanceVisit& visit, int first, std::uint32_t bits) {
  visit.first[visit.count] = static_cast<std::uint8_t>(first);
  visit.bits[visit.count++] = static_cast<std::uint16_t>(bits);
}

// Rays first .. first + 15, whole even where few of them are meant: neighbours stay neighbours.
FASTRT_INLINE void add_group(InstanceVisit& visit, int first, std::uint32_t bits) {
  for (int k = 0; k < group_size; k += widest) add_rays(visit, first + k, bits >> k & register_bits);
}

// Returns whether some ray of the register meets the instance.
FASTRT_INLINE bool enter_register(const InstanceRow& row, std::int32_t id, const RayBatch& rays,
                                  const HitBatch& hits, int first, std::uint32_t bits, int at,
                                  InstanceRays& to) {
  using F = Floats<widest>;
  using I = Ints<widest>;
  const WorldRays<F> world{load3<F>(rays.origin_x + first, rays.origin_y + first, rays.origin_z + first),
                           load3<F>(rays.dir_x + first, rays.dir_y + first, rays.dir_z + first),
                           load<F>(rays.t_min + first), load<F>(rays.t_max + first), load<F>(hits.t + first)};
  const MaskOf<F> same = simd::bool_cast(load<I>(rays.exclude + first) == I(id));
  select_ints<F>(same, load<I>(rays.exclude_inner + first), I(-1)).store_aligned(to.rays.exclude + at);
  for (int lane = 0; lane < widest; ++lane) to.index[at + lane] = static_cast<std::uint8_t>(first + lane);
  return enter_instance(row, world, bits, at, to) != 0;
}

// Rays of a batch against the instance `id`; changed: as trace_instance.
template <bool any>
[[gnu::noinline]] static void meet_instance(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                                            std::int32_t id, const InstanceVisit& visit,
                                            std::uint32_t* changed) noexcept {
  const InstanceRow& row = scene.shapes.instances[id - scene.shapes.first_instance];
  InstanceRays to;
  int count = 0;
  for (int first = 0; first < visit.count; first += visit.unit) {
    bool met = false;
    for (int k = 0; k < visit.unit; ++k)
      met |= enter_register(row, id, rays, hits, visit.first[first + k], visit.bits[first + k],
                            count + k * widest, to);
    if (met) count += visit.unit * widest;
  }
  if (count == 0) return;
  to.rays.count = count;
  // As a beam, not as a tile, even if all rays are left: an instance is mostly small in the picture and its
  // triangles smaller still, and few rays in a subtree then go on alone.
  to.rays.shape = BatchShape::coherent;
  trace_instance<any>(scene, id, to, hits, changed);
}

// The instances of a leaf that rays are to see, the nearest first: behind it many need not be seen any more.
struct WaitingInstances {
  int count = 0;
  std::int32_t id[max_leaf_blocks * block_size];
  float near[max_leaf_blocks * block_size];
  std::uint64_t rays[max_leaf_blocks * block_size]; // or groups of them

  [[gnu::always_inline]] inline void add(std::int32_t instance, float at, std::uint64_t which) {
    id[count] = instance;
    near[count] = at;
    rays[count++] = which;
  }
  // Moves the nearest to the end and takes it from there.
  [[gnu::always_inline]] inline int take() {
    int nearest = 0;
    for (int i = 1; i < count; ++i)
      if (near[i] < near[nearest]) nearest = i;
    --count;
    const std::int32_t instance = id[nearest];
    const float at = near[nearest];
    const std::uint64_t which = rays[nearest];
    id[nearest] = id[count];
    near[nearest] = near[count];
    rays[nearest] = rays[count];
    id[count] = instance;
    near[count] = at;
    rays[count] = which;
    return count;
  }
};

// The same for ray i alone.
template <bool any>
[[gnu::noinline]] static void meet_instance_alone(const GeometryView& scene, const RayBatch& rays,
                                                  HitBatch& hits, std::int32_t id, int i) noexcept {
  using F = Floats<4>;
  const InstanceRow& row = scene.shapes.instances[id - scene.shapes.first_instance];
  const WorldRays<F> world{broadcast3<F>(rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]),
                           broadcast3<F>(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]), F(rays.t_min[i]),
                           F(rays.t_max[i]), F(hits.t[i])};
  InstanceRays to;
  if (enter_instance(row, world, 1U, 0, to) == 0) return;
  to.rays.exclude[0] = rays.exclude[i] == id ? rays.exclude_inner[i] : -1;
  to.index[0] = static_cast<std::uint8_t>(i);
  to.rays.count = 1;
  to.rays.shape = BatchShape::any;
  std::uint32_t changed[batch_groups] = {};
  trace_instance<any>(scene, id, to, hits, changed);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
