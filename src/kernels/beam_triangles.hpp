// SPDX-License-Identifier: Apache-2.0
// A beam and triangles: they are sieved, ray by ray; what is left is tested with a register full of rays or
// of triangles, whichever takes fewer tests.
#pragma once

#include "src/kernels/beam_hits.hpp"
#include "src/kernels/beam_sieve.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// What the sieve leaves of a run.
struct SievedRun {
  alignas(16) std::uint8_t triangles[beam_size]; // of each ray: bits
  std::uint64_t rays;                            // that have any
  std::uint32_t places;                          // pairs of a group and a triangle: see pair_lanes

  // The rays of group g that may hit triangle i.
  [[gnu::always_inline]] inline std::uint32_t rays_of(int g, int i) const {
    const __m128i group = _mm_load_si128(reinterpret_cast<const __m128i*>(triangles + g * group_size));
    const __m128i bit_to_sign = _mm_cvtsi32_si128(7 - i);
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_sll_epi16(group, bit_to_sign)));
  }
};

template <bool any>
FASTRT_INLINE void sieve_run(const BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run,
                             std::uint64_t rays, SievedRun& sieved) {
  __builtin_memset(sieved.triangles, 0, sizeof(sieved.triangles));
  sieved.rays = 0;
  sieved.places = 0;
  const std::uint32_t lanes = (1U << run.lanes) - 1U;
  const FrameTriangles<PacketF> triangles = for_rays(place_triangles(t.beam, run));
  const PacketI primitives = as_ints(for_rays(as_floats<LeafF>(primitives_of(run))));
  const auto keep = [&](int i, std::uint32_t around) {
    sieved.triangles[i] = static_cast<std::uint8_t>(around);
    sieved.rays |= std::uint64_t{around != 0} << i;
    sieved.places |= around << (i / group_size * pair_lanes);
  };
  while (rays != 0) {
    const int i = __builtin_ctzll(rays);
    rays &= rays - 1;
    const int j = rays_at_once == 2 && rays != 0 ? __builtin_ctzll(rays) : i;
    if (rays_at_once == 2) rays &= rays - 1;
    const PacketM excluded = simd::bool_cast(primitives == of_rays(t.rays.exclude + t.first, i, j));
    const std::uint32_t around = triangles_around(t.beam.rays, triangles, i, j) & ~to_bits(excluded);
    keep(i, around & lanes);
    if (rays_at_once == 2) keep(j, around >> (widest - leaf_lanes) & lanes);
  }
}

// A function of its own where registers hold sixteen lanes: gcc's code of the loop in the midst of a
// traversal takes twice as long after some changes to what is around it. (With fewer lanes the call costs
// more.)
template <bool any>
[[gnu::noinline]] static void sieve_run_apart(const BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run,
                                              std::uint64_t rays, SievedRun& sieved) noexcept {
  sieve_run(t, run, rays, sieved);
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

// Returns the rays that have a new hit.
template <bool any>
FASTRT_INLINE std::uint64_t meet_run_alone(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run,
                                           const SievedRun& found) {
  t.tests += static_cast<std::uint32_t>(__builtin_popcountll(found.rays) * run.lanes);
  std::uint64_t changed = 0;
  for (std::uint64_t rays = found.rays; rays != 0; rays &= rays - 1) {
    const int at = __builtin_ctzll(rays), i = t.first + at;
    LoneRay ray = lone_ray(t.rays, t.hits, i);
    meet_triangles(ray, run, found.triangles[at]);
    if (ray.primitive == t.hits.primitive[i]) continue;
    t.hits.t[i] = ray.t;
    t.hits.primitive[i] = ray.primitive;
    changed |= std::uint64_t{1} << at;
  }
  return changed;
}

template <bool any>
FASTRT_INLINE std::uint64_t meet_run_together(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run,
                                              const SievedRun& found) {
  std::uint64_t changed = 0;
  for (std::uint32_t places = found.places; places != 0; places &= places - 1) {
    const int place = __builtin_ctz(places), g = place / pair_lanes, lane = place % pair_lanes;
    changed |= static_cast<std::uint64_t>(meet_triangle(t, run, lane, g, found.rays_of(g, lane)))
               << (g * group_size);
  }
  return changed;
}

// (A test of a run's triangles against one ray costs as much as one of a triangle against a register of
// rays.)
template <bool any>
FASTRT_INLINE void meet_run(BeamTraversal<any>& t, const BlockRun<TriangleBlock>& run, std::uint64_t rays) {
  SievedRun found;
  if constexpr (rays_at_once == 2)
    sieve_run_apart(t, run, rays, found);
  else
    sieve_run(t, run, rays, found);
  if (found.rays == 0) return;
  const bool alone =
      __builtin_popcountll(found.rays) * widest <= __builtin_popcount(found.places) * group_size;
  shorten(t, alone ? meet_run_alone(t, run, found) : meet_run_together(t, run, found));
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
