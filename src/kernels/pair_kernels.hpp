// SPDX-License-Identifier: Apache-2.0
// The primitive kernels over columns of pairs: what the equivalence tests compare with the scalar twin lane
// by lane, and what the microbenchmarks time.
#pragma once

#include "src/kernels/batch_queries.hpp"
#include "src/kernels/kernel_table.hpp"
#include "src/simd/shared_math.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

struct PairRay {
  V3<PacketF> origin, dir;
  PacketF t_min;
};

FASTRT_INLINE PairRay load_ray(const PairColumns& p, std::size_t i) {
  return {load3<PacketF>(p.origin[0] + i, p.origin[1] + i, p.origin[2] + i),
          load3<PacketF>(p.dir[0] + i, p.dir[1] + i, p.dir[2] + i), load<PacketF>(p.t_min + i)};
}

FASTRT_INLINE V3<PacketF> load_primitive(const PairColumns& p, int column, std::size_t i) {
  return load3<PacketF>(p.primitive[column] + i, p.primitive[column + 1] + i, p.primitive[column + 2] + i);
}

FASTRT_INLINE void store_hits(const PacketM& hit, const PacketF& t, std::size_t i, std::uint8_t* hits,
                              float* ts) {
  select(hit, t, PacketF(0.0F)).store_unaligned(ts + i);
  const std::uint32_t bits = to_bits(hit);
  for (int lane = 0; lane < widest; ++lane) hits[i + static_cast<std::size_t>(lane)] = bits >> lane & 1U;
}

static void meet_triangles(const PairColumns& p, std::uint8_t* hits, float* ts, float* us,
                           float* vs) noexcept {
  for (std::size_t i = 0; i < p.count; i += widest) {
    const PairRay ray = load_ray(p, i);
    const V3<PacketF> v0 = load_primitive(p, 0, i) - ray.origin, v1 = load_primitive(p, 3, i) - ray.origin,
                      v2 = load_primitive(p, 6, i) - ray.origin;
    const TriangleLanes<PacketF> lanes =
        intersect_triangle(v0, v1, v2, ray.dir, largest(ray.origin), register_bits);
    store_hits(lanes.inside & (lanes.t > ray.t_min) & (lanes.t < PacketF(__builtin_inff())), lanes.t, i, hits,
               ts);
    if (us == nullptr) continue;
    const auto [u, v] = triangle_weights(set_up_triangle(v0, v1, v2), ray.dir);
    u.store_unaligned(us + i);
    v.store_unaligned(vs + i);
  }
}

static void meet_spheres(const PairColumns& p, std::uint8_t* hits, float* ts) noexcept {
  for (std::size_t i = 0; i < p.count; i += widest) {
    const PairRay ray = load_ray(p, i);
    const SphereLanes<PacketF> lanes = intersect_sphere(
        load_primitive(p, 0, i), load<PacketF>(p.primitive[3] + i), ray.origin, ray.dir, ray.t_min);
    store_hits(lanes.hit & (lanes.t < PacketF(__builtin_inff())), lanes.t, i, hits, ts);
  }
}

static void meet_boxes(const PairColumns& p, std::uint8_t* hits) noexcept {
  LoneColumns columns;
  for (std::size_t i = 0; i < p.count; i += widest) {
    const PairRay ray = load_ray(p, i);
    const V3<PacketF> lower = load_primitive(p, 0, i), upper = load_primitive(p, 3, i);
    const PacketF size = max(largest(ray.origin), max(largest(lower), largest(upper)));
    prepare_axes(columns, 0, ray.origin, ray.dir, size);
    const SlabLanes<PacketF> x = meet_slab(load_axis(columns, 0, 0), lower.x, upper.x),
                             y = meet_slab(load_axis(columns, 1, 0), lower.y, upper.y),
                             z = meet_slab(load_axis(columns, 2, 0), lower.z, upper.z);
    const PacketF near = max(x.near, max(y.near, max(z.near, ray.t_min))),
                  far = min(x.far, min(y.far, z.far));
    const std::uint32_t bits = to_bits(near <= far);
    for (int lane = 0; lane < widest; ++lane) hits[i + static_cast<std::size_t>(lane)] = bits >> lane & 1U;
  }
}

static void powers(const float* x, const float* y, float* out, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; i += widest)
    shared_pow<BatchOps<widest>>(load<PacketF>(x + i), load<PacketF>(y + i)).store_unaligned(out + i);
}

static void exponentials(const float* x, float* out, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; i += widest)
    shared_exp<BatchOps<widest>>(load<PacketF>(x + i)).store_unaligned(out + i);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
