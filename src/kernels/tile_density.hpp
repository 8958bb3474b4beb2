// SPDX-License-Identifier: Apache-2.0
// Whether a batch is worth a tile or a pencil: groups that look at much of the scene are each shown what all
// their rays need, which takes longer than to follow few rays at a time.
#pragma once

#include "src/kernels/tile_culling.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// A group may look at so many primitives, if these lay evenly about the part of the plane that the scene
// covers. (What does not go as a tile would be a beam or packets, which are good at few rays; and of mirrored
// rays more is lost before they are that.)
inline constexpr float most_in_tile = 3.0F, most_in_pencil = 16.0F;

// The same of rays that lie as those of a camera or light do, and how many before each ray is better off
// alone. (For those that look for the closest hit tiles are better than beams until there are too many for
// either.)
template <bool any>
inline constexpr float most_before_tile = any ? 16.0F : 70.0F;
template <bool any>
inline constexpr float most_before_beams = any ? 300.0F : 70.0F;
// Scenes of fewer primitives crowd camera rays in no picture worth the trouble of finding out.
inline constexpr std::uint32_t least_crowd = 1U << 17U;

// The area of all directions together, as far as a plane may stand for them.
inline constexpr float all_directions = 12.6F;
template <class View>
inline constexpr float area_limit = View::begins_apart ? __builtin_inff() : all_directions;

// The area of the part of the plane that the scene covers. (Unused children of the root have inverted boxes.)
template <class View>
FASTRT_INLINE float scene_area(const GeometryView& scene, const View& view) {
  using N = Floats<node_lanes>;
  const N padding(view.frame.padding), nowhere(__builtin_inff());
  const float* const root = scene.nodes[scene.root].lower_x;
  N x0 = nowhere, minus_x1 = nowhere, y0 = nowhere, minus_y1 = nowhere;
  for (int half = 0; half < wide_children; half += node_lanes) {
    const float* const columns = root + half;
    const Extent<N> u = box_extent(view.u, columns, padding), v = box_extent(view.v, columns, padding),
                    w = box_extent(view.w, columns, padding);
    const Rectangles<N> r = project_extent(view.frame, u.low, u.high, v.low, v.high, w.low, w.high);
    const MaskOf<N> used = load<N>(columns) <= load<N>(columns + wide_children);
    x0 = min(x0, select(used, r.x0, nowhere));
    minus_x1 = min(minus_x1, select(used, negate(r.x1), nowhere));
    y0 = min(y0, select(used, r.y0, nowhere));
    minus_y1 = min(minus_y1, select(used, negate(r.y1), nowhere));
  }
  return (reduce_min(x0) + reduce_min(minus_x1)) * (reduce_min(y0) + reduce_min(minus_y1));
}

// How many primitives a view's groups look at, on average, if these lie evenly about the scene. most_area:
// what the scene cannot be larger than.
template <class View>
FASTRT_INLINE float primitives_seen(const GeometryView& scene, const View& view, float most_area) {
  if (is_leaf(scene.root)) return 0.0F;
  const PacketF zero(0.0F);
  PacketF sum = zero;
  std::uint32_t used = 0;
  for (int g = 0; g < batch_groups; g += widest) {
    const PacketF width =
                      PacketF::load_aligned(view.groups.x1 + g) - PacketF::load_aligned(view.groups.x0 + g),
                  height =
                      PacketF::load_aligned(view.groups.y1 + g) - PacketF::load_aligned(view.groups.y0 + g);
    const PacketM rays = width >= zero;
    sum = sum + select(rays, width * height, zero);
    used |= to_bits(rays) << g;
  }
  const float whole = scene_area(scene, view), area = whole < most_area ? whole : most_area;
  return simd::hadd(sum) * static_cast<float>(scene.primitive_count) /
         (static_cast<float>(__builtin_popcount(used)) * area);
}

// How many primitives lie before a view's groups; 0 where that is not worth finding out.
template <bool any, class View>
FASTRT_INLINE float crowd_before(const GeometryView& scene, const View& view) {
  if (!any && scene.primitive_count < least_crowd) return 0.0F;
  return primitives_seen(scene, view, area_limit<View>);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
