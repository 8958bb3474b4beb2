// SPDX-License-Identifier: Apache-2.0
// What a beam carries through the tree, and how it takes hits.
#pragma once

#include "src/kernels/beam_children.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

template <bool any>
struct BeamTraversal {
  const GeometryView& scene;
  const RayBatch& rays;
  HitBatch& hits;
  LoneColumns& columns; // of rays that go on alone
  int first;            // ray 0 of the beam in the batch
  Beam& beam;
  std::uint64_t open; // rays that still look for a hit
  std::uint32_t nodes = 0, tests = 0;
};

// After new hits of the rays in `changed`.
template <bool any>
FASTRT_INLINE void shorten(BeamTraversal<any>& t, std::uint64_t changed) {
  if constexpr (any)
    t.open &= ~changed;
  else
    for (std::uint32_t groups = groups_with(changed); groups != 0; groups &= groups - 1)
      find_far(t.beam, t.hits, t.first, __builtin_ctz(groups));
}
template <bool any>
FASTRT_INLINE void shorten_group(BeamTraversal<any>& t, int g, std::uint32_t changed) {
  shorten(t, static_cast<std::uint64_t>(changed) << (g * group_size));
}

// One primitive against the rays of group g in `bits`.
template <bool any, class Meet>
FASTRT_INLINE std::uint32_t meet_beam_group(BeamTraversal<any>& t, int g, std::uint32_t bits,
                                            std::int32_t primitive, const Meet& meet) {
  t.tests += static_cast<std::uint32_t>(__builtin_popcount(bits));
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

} // namespace fastrt::FASTRT_ISA_NAMESPACE
