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
  const int left = rays.count - i;
  return to_bits(PacketF::load_aligned(rays.t_min + i) < PacketF::load_aligned(rays.t_max + i)) &
         (left >= widest ? register_bits : (1U << left) - 1U);
}

// Whether the rays that may hit something would fill fewer groups than they lie in.
FASTRT_INLINE bool has_gaps(const RayBatch& rays) {
  int looking = 0, groups = 0;
  for (int first = 0; first < rays.count; first += group_size) {
    int of_group = 0;
    for (int i = first; i < first + group_size && i < rays.count; i += widest)
      of_group += __builtin_popcount(looking_bits(rays, i));
    looking += of_group;
    groups += of_group != 0;
  }
  return looking <= (groups - 1) * group_size;
}

FASTRT_INLINE void pack_column(const Compressor& pick, const float* from, float* to) {
  pick.store(PacketF::load_aligned(from), to);
}
FASTRT_INLINE void pack_column(const Compressor& pick, const std::int32_t* from, std::int32_t* to) {
  pick.store(PacketI::load_aligned(from), to);
}

// Fills `to` with those rays, in their order. Whole registers are written, and fit: no ray comes after its
// row.
FASTRT_INLINE void pack_rays(const RayBatch& from, PackedBatch& to) {
  RayBatch& out = to.rays;
  out.shape = from.shape;
  int n = 0;
  alignas(64) std::int32_t lane_numbers[widest];
  for (int k = 0; k < widest; ++k) lane_numbers[k] = k;
  const PacketI lanes = PacketI::load_aligned(lane_numbers);
  for (int i = 0; i < from.count; i += widest) {
    const std::uint32_t bits = looking_bits(from, i);
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
