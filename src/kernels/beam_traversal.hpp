// SPDX-License-Identifier: Apache-2.0
// Beams of up to 64 neighbouring rays through the wide tree. A node's eight boxes are met at once by each
// group of 16; where a box is small beside the group, its rays are looked at too, and a subtree that few rays
// reach is followed by these alone.
#pragma once

#include "src/kernels/beam_leaves.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// With this many rays left in a subtree or fewer, each follows it alone.
inline constexpr int lone_beam_rays = 6;

struct BeamEntry {
  std::uint32_t child;
  float near;
  std::uint64_t rays; // that may reach it
};

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

template <bool any>
FASTRT_INLINE void go_on_alone(BeamTraversal<any>& t, std::uint32_t child, std::uint64_t rays) {
  std::uint8_t which[beam_size];
  int count = 0;
  for (std::uint64_t bits = rays; bits != 0; bits &= bits - 1)
    which[count++] = static_cast<std::uint8_t>(t.first + __builtin_ctzll(bits));
  trace_lone_rays<any>(t.scene, {t.rays, t.hits, t.columns, child, which, which + count});
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
    if (__builtin_popcountll(rays) <= lone_beam_rays && !is_leaf(entry.child)) {
      go_on_alone(t, entry.child, rays);
      continue;
    }
    if (is_leaf(entry.child)) {
      meet_leaf(t, entry.child, rays);
      continue;
    }
    const WideNode& node = t.scene.nodes[entry.child];
    ++t.nodes;
    touch_children(t.beam, node, rays, children);
    top = push_children(t.scene, node, children, top);
  }
}

// Traces rays first .. first + count - 1 (count: a multiple of group_size) as one; false (and nothing done)
// if they point too widely apart.
template <bool any>
static bool trace_beam(const GeometryView& scene, const RayBatch& rays, HitBatch& hits, LoneColumns& columns,
                       int first, int count) noexcept {
  Beam beam;
  if (!make_beam(scene, rays, first, count, beam)) return false;
  BeamTraversal<any> t{scene, rays, hits, columns, first, beam, beam.live};
  for (int g = 0; g < count / group_size; ++g)
    beam.groups[g].far = beam_far(beam, hits, first, g, rays_of_group(beam.live, g));
  traverse_beam(t);
  count_tests(hits, t.nodes, t.tests);
  return true;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
