// SPDX-License-Identifier: Apache-2.0
// Beams of up to 64 neighbouring rays through the wide tree. A node's eight boxes are met at once by each
// group of 16; where a box is small beside the group, its rays are looked at too, and a subtree that few rays
// reach is followed by these alone.
#pragma once

#include "src/kernels/beam_leaves.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// With this many rays left in a subtree or fewer, each follows it alone.
inline constexpr int lone_beam_rays = 3;

template <bool any>
FASTRT_INLINE void go_on_alone(BeamTraversal<any>& t, std::uint32_t child, std::uint64_t rays) {
  std::uint8_t which[beam_size];
  int count = 0;
  for (std::uint64_t bits = rays; bits != 0; bits &= bits - 1)
    which[count++] = static_cast<std::uint8_t>(t.first + __builtin_ctzll(bits));
  trace_lone_rays<any>(t.scene, {t.rays, t.hits, t.columns, child, nullptr, which, which + count});
  std::uint64_t found = 0;
  for (std::uint64_t bits = rays; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctzll(bits);
    found |= std::uint64_t{t.hits.primitive[t.first + i] >= 0} << i;
  }
  shorten(t, found);
}

template <bool any>
static void traverse_beam(BeamTraversal<any>& t) noexcept {
  BeamStack stack;
  // What lies under the top is on its way to the cache while the top is looked at; under the root that is the
  // root again.
  stack.entries[0] = stack.entries[1] = make_waiting(t.scene.root, 0.0F, 0);
  stack.rays[1] = t.open;
  for (int top = 2; top != 1;) {
    const Waiting entry = stack.entries[--top];
    prefetch_child(t.scene, child_of(stack.entries[top - 1]));
    const std::uint64_t rays = stack.rays[top] & t.open & rays_as_far_as(t.beam.rays, near_of(entry));
    if (rays == 0) continue;
    const std::uint32_t child = child_of(entry);
    if (is_leaf(child)) {
      meet_leaf(t, child, rays);
      continue;
    }
    if (__builtin_popcountll(rays) <= lone_beam_rays) {
      go_on_alone(t, child, rays);
      continue;
    }
    ++t.nodes;
    top = push_children(t.beam, t.scene.nodes[child], rays, stack, top);
  }
}

// Traces rays first .. first + count - 1 (count: a multiple of group_size) as one. Returns those with which
// nothing is done.
template <bool any>
static BeamRest trace_beam(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                           LoneColumns& columns, int first, int count) noexcept {
  Beam beam;
  const BeamRest left = make_beam(scene, rays, first, count, beam);
  if (beam.live == 0) return left;
  BeamTraversal<any> t{scene, rays, hits, columns, first, beam, beam.live};
  for (int g = 0; g < count / group_size; ++g) find_far(beam, hits, first, g);
  traverse_beam(t);
  count_tests(hits, t.nodes, t.tests);
  return left;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
