// SPDX-License-Identifier: Apache-2.0
// The rays of a batch that look for something at all, side by side. Shadow rays leave gaps where surfaces
// turn away from the light or nothing was hit; without them fewer groups and packets are met, and full ones.
#pragma once

#include "src/kernels/lone_columns.hpp"
#include "src/simd/compress.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

struct PackedBatch {
  RayBatch rays;
  HitBatch hits;
  alignas(64) std::int32_t row[batch_size]; // in the batch that they come from
};

// The rays i .. i + widest - 1 of a batch that may hit something.
FASTRT_INLINE std::uint32_t looking_bits(const RayBatch& rays, int i) {
  return to_bits(PacketF::load_aligned(rays.t_min + i) < PacketF::load_aligned(rays.t_max + i)) &
         lanes_in(rays.count - i);
}

// The rays of a batch that take part: bit l of word g is ray 16 g + l.
struct RayBits {
  std::uint32_t of_group[batch_groups];
};

// The rays that may hit something.
FASTRT_INLINE RayBits looking_rays(const RayBatch& rays) {
  RayBits looking{};
  for (int i = 0; i < rays.count; i += widest)
    looking.of_group[i / group_size] |= looking_bits(rays, i) << (i % group_size);
  return looking;
}

// Whether the rays that take part would fill fewer groups than they lie in.
FASTRT_INLINE bool has_gaps(const RayBits& looking) {
  int rays = 0, groups = 0;
  for (const std::uint32_t bits : looking.of_group) {
    rays += __builtin_popcount(bits);
    groups += bits != 0;
  }
  return rays <= (groups - 1) * group_size;
}

FASTRT_INLINE void pack_column(const Compressor& pick, const float* from, float* to) {
  pick.store(PacketF::load_aligned(from), to);
}
FASTRT_INLINE void pack_column(const Compressor& pick, const std::int32_t* from, std::int32_t* to) {
  pick.store(PacketI::load_aligned(from), to);
}

// Fills `to` with the rays that take part, in their order. Whole registers are written, and fit: no ray comes
// after its row.
FASTRT_INLINE void pack_rays(const RayBatch& from, const RayBits& looking, PackedBatch& to) {
  RayBatch& out = to.rays;
  out.shape = from.shape;
  int n = 0;
  alignas(64) std::int32_t lane_numbers[widest];
  for (int k = 0; k < widest; ++k) lane_numbers[k] = k;
  const PacketI lanes = PacketI::load_aligned(lane_numbers);
  for (int i = 0; i < from.count; i += widest) {
    const std::uint32_t bits = looking.of_group[i / group_size] >> (i % group_size) & register_bits;
    if (bits == 0) continue;
    const Compressor pick(bits);
    pack_column(pick, from.origin_x + i, out.origin_x + n);
    pack_column(pick, from.origin_y + i, out.origin_y + n);
    pack_column(pick, from.origin_z + i, out.origin_z + n);
    pack_column(pick, from.dir_x + i, out.dir_x + n);
    pack_column(pick, from.dir_y + i, out.dir_y + n);
    pack_column(pick, from.dir_z + i, out.dir_z + n);
    pack_column(pick, from.t_min + i, out.t_min + n);
    pack_column(pick, from.t_max + i, out.t_max + n);
    pack_column(pick, from.exclude + i, out.exclude + n);
    pack_column(pick, from.exclude_inner + i, out.exclude_inner + n);
    pick.store(lanes + PacketI(i), to.row + n);
    n += __builtin_popcount(bits);
  }
  out.count = n;
}

// What the packed rays hit, to where they come from; all others hit nothing (`hits` is cleared).
FASTRT_INLINE void unpack_hits(const PackedBatch& from, HitBatch& hits) {
  for (int k = 0; k < from.rays.count; ++k) {
    const int i = from.row[k];
    hits.t[i] = from.hits.t[k];
    hits.primitive[i] = from.hits.primitive[k];
    hits.inner[i] = from.hits.inner[k];
  }
  hits.boxes += from.hits.boxes;
  hits.primitives += from.hits.primitives;
  hits.lone += from.hits.lone;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
