// SPDX-License-Identifier: Apache-2.0
// The two questions about a batch of rays, and the choice of how to trace it.
#pragma once

#include "src/kernels/apart_rays.hpp"
#include "src/kernels/pencil_traversal.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The planes, which no tree holds: after it, so that it culls by its own hits alone.
[[gnu::noinline]] static void meet_planes(const ShapeView& shapes, const RayBatch& rays,
                                          HitBatch& hits) noexcept {
  for (int i = 0; i < rays.count; i += widest) {
    const V3<PacketF> origin = load3<PacketF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
    const V3<PacketF> dir = load3<PacketF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
    const PacketF t_min = load<PacketF>(rays.t_min + i);
    const PacketI exclude = load<PacketI>(rays.exclude + i);
    PacketF t = PacketF::load_aligned(hits.t + i);
    PacketI primitive = PacketI::load_aligned(hits.primitive + i);
    const PacketM live = traceable_lanes(origin, dir, rays.count - i);
    for (std::uint32_t p = 0; p < shapes.plane_count; ++p) {
      const ShapeLanes<PacketF> met = intersect_plane(shapes.planes[p], origin, dir, t_min);
      keep_closest(t, primitive, exclude, met.hit & live, met.t,
                   shapes.first_plane + static_cast<std::int32_t>(p));
    }
    t.store_aligned(hits.t + i);
    primitive.store_aligned(hits.primitive + i);
  }
  hits.primitives += static_cast<std::uint64_t>(rays.count) * shapes.plane_count;
}

template <bool any>
FASTRT_INLINE void trace_packets(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                                 LoneColumns& columns, LoneLater& later, int first, int count) {
  for (int i = first; i < first + count && i < rays.count; i += widest)
    trace_packet<any>(scene, {rays, hits, columns, later, i});
}

// Neighbouring rays: as beams, and where they point apart, after them in other ways if leaves hold triangles
// alone, else in packets. What beams and lone rays are best at is telling which rays triangles lie around; on
// the way to lights that are shadowed by other primitives packets are faster.
template <bool any>
static void trace_alike(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                        LoneColumns& columns) noexcept {
  const bool beams = !any || scene.has_triangles != 0;
  LoneLater later;
  clear(later);
  RayBits apart{};
  std::uint64_t some = 0;
  std::uint8_t alone[batch_size];
  int alone_count = 0;
  const int end = (rays.count + group_size - 1) / group_size * group_size;
  for (int first = 0; first < end; first += beam_size) {
    const int count = end - first < beam_size ? end - first : beam_size;
    const BeamRest rest =
        beams ? trace_beam<any>(scene, rays, hits, columns, first, count) : BeamRest{~std::uint64_t{0}, 0};
    if (scene.only_triangles == 0) {
      if (rest.apart != 0) trace_packets<any>(scene, rays, hits, columns, later, first, count);
      continue;
    }
    some |= rest.apart | rest.alone;
    alone_count = list_rays(rest.alone, first, alone, alone_count);
    for (int g = 0; g < count / group_size; ++g)
      apart.of_group[first / group_size + g] = rays_of_group(rest.apart, g);
  }
  trace_later<any>(scene, rays, hits, columns, later);
  if (some != 0) trace_apart<any>(scene, rays, apart, hits, columns, alone, alone_count);
}

template <bool any>
[[gnu::noinline]] static void trace_all_packets(const GeometryView& scene, const RayBatch& rays,
                                                HitBatch& hits, LoneColumns& columns) noexcept {
  LoneLater later;
  clear(later);
  trace_packets<any>(scene, rays, hits, columns, later, 0, rays.count);
  trace_later<any>(scene, rays, hits, columns, later);
}

template <bool any>
static void trace_tree(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  if (scene.root == no_child) return;
  const bool alike = rays.shape == BatchShape::common_origin || rays.shape == BatchShape::parallel;
  const TileEnd end = alike && scene.culls != 0 ? trace_tile<any>(scene, rays, hits) : TileEnd::beams;
  if (end == TileEnd::traced) return;
  LoneColumns columns;
  columns.ready = 0;
  if (scene.culls == 0)
    trace_all_packets<any>(scene, rays, hits, columns);
  else if (rays.shape == BatchShape::any || end == TileEnd::alone)
    trace_rays_alone<any>(scene, rays, hits, columns);
  else
    trace_alike<any>(scene, rays, hits, columns);
}

// Rays with gaps between them. (Not for tiles: their groups would become wider.)
template <bool any>
[[gnu::noinline]] static void trace_packed(const GeometryView& scene, const RayBatch& rays,
                                           const RayBits& looking, HitBatch& hits) noexcept {
  PackedBatch packed;
  pack_rays(rays, looking, packed);
  if (packed.rays.count == 0) return;
  clear_hits(packed.rays, packed.hits);
  packed.hits.boxes = packed.hits.primitives = packed.hits.lone = 0;
  trace_tree<any>(scene, packed.rays, packed.hits);
  unpack_hits(packed, hits);
}

// With fewer rays than this of one origin or direction, whether they are scattered is not worth finding out.
inline constexpr int least_dense_tile = 96;
// With fewer than this that look for the closest hit, each goes alone where they may be scattered.
inline constexpr int least_together = 64;

[[gnu::noinline]] static void find_closest_alone(const GeometryView& scene, const RayBatch& rays,
                                                 HitBatch& hits) noexcept {
  LoneColumns columns;
  columns.ready = 0;
  trace_rays_alone<false>(scene, rays, hits, columns);
}

// Rays that may be scattered: as a tile if there are many and they are not, alone if they are few. Returns
// whether they have been traced.
template <bool any>
FASTRT_INLINE bool trace_scattered(const GeometryView& scene, const RayBatch& rays, int count,
                                   HitBatch& hits) {
  if (count >= least_dense_tile) return trace_dense_tile<any>(scene, rays, hits);
  if (any || count >= least_together || scene.few_shapes == 0) return false;
  find_closest_alone(scene, rays, hits);
  return true;
}

// Rays that are neighbours: what lies in pencils as these, all others in beams and packets.
template <bool any>
static void trace_coherent(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  const bool culls = scene.culls != 0 && scene.root != no_child;
  RayBits looking = looking_rays(rays);
  if (rays.shape != BatchShape::coherent && culls &&
      trace_scattered<any>(scene, rays, count_rays(looking), hits))
    return;
  const bool pencils = !any && culls;
  if ((pencils && trace_pencils(scene, rays, looking, hits)) || has_gaps(looking))
    trace_packed<any>(scene, rays, looking, hits);
  else
    trace_tree<any>(scene, rays, hits);
}

template <bool any>
static void trace_batch(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  clear_hits(rays, hits);
  hits.lone = 0;
  if (rays.shape == BatchShape::coherent || rays.shape == BatchShape::scattered_origin ||
      rays.shape == BatchShape::scattered_parallel)
    trace_coherent<any>(scene, rays, hits);
  else
    trace_tree<any>(scene, rays, hits);
  count_tests(hits, hits.lone >> 32U, (hits.lone & 0xFFFFFFFFU) * leaf_lanes);
  if (scene.shapes.plane_count != 0) meet_planes(scene.shapes, rays, hits);
}

// The closest hit of every ray: t = t_max and primitive = -1 on a miss.
static void find_closest_hits(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  trace_batch<false>(scene, rays, hits);
}

// Some hit of every ray that has one: only whether primitive >= 0 means anything.
static void find_any_hits(const GeometryView& scene, const RayBatch& rays, HitBatch& hits) noexcept {
  trace_batch<true>(scene, rays, hits);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
