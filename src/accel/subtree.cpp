// SPDX-License-Identifier: Apache-2.0
#include "src/accel/subtree.hpp"

#include "src/accel/item_loops.hpp"

namespace fastrt {
namespace {

LaneBox intersection(const LaneBox& a, const LaneBox& b) {
  return {_mm_max_ps(a.lower, b.lower), _mm_min_ps(a.upper, b.upper)};
}

__m128 with_lane(__m128 values, int lane, float value) {
  alignas(16) float lanes[4];
  _mm_store_ps(lanes, values);
  lanes[lane] = value;
  return _mm_load_ps(lanes);
}

// Boxes that travel themselves.
struct Moved {
  const PrimitiveBox* from;
  PrimitiveBox* to;

  const PrimitiveBox& box(std::size_t i) const { return from[i]; }
  void store(std::size_t, const LaneBox& box, PrimitiveBox& place) const {
    _mm_store_ps(place.lower, box.lower);
    _mm_store_ps(place.upper, box.upper);
  }
};

Moved items_of(const BuildContext& context, const BuildRange& range) {
  return {context.buffers[range.buffer], context.buffers[1 - range.buffer]};
}

template <bool into_bins>
void move(const BuildContext& context, const BuildRange& range, const BinSplit& split,
          const SplitSides& sides, Bins* const bins[2]) {
  move_items<into_bins>(items_of(context, range), range.centroids, range.begin, range.end, split, sides,
                        bins);
}

void measure(const BuildContext& context, BuildRange& range) {
  measure_items(items_of(context, range), range);
}

void fill_bins(const BuildContext& context, const BuildRange& range, Bins& bins) {
  add_items(items_of(context, range), range, BinMapping(range.centroids), bins);
}

GroupedNode build_halves(const BuildContext& context, const BuildRange& range, NodeList& list) {
  const std::uint32_t first = list.add_pair();
  for (std::uint32_t side = 0; side < 2; ++side) {
    BuildRange child = half_of(range, side);
    measure(context, child);
    Bins bins;
    fill_bins(context, child, bins);
    put_node(list, first + side, build_range(context, child, bins, list));
  }
  return make_node(range.bounds, first, 0, 0);
}

// Small ranges need no bins.
GroupedNode build_small_sides(const BuildContext& context, const BuildRange& range, const BinSplit& split,
                              const SplitSides& sides, NodeList& list) {
  move<false>(context, range, split, sides, nullptr);
  const std::uint32_t first = list.add_pair();
  for (std::uint32_t side = 0; side < 2; ++side)
    put_node(list, first + side, build_small_range(context, sides.ranges[side], list));
  return make_node(range.bounds, first, 0, 0);
}

} // namespace

BuildRange half_of(const BuildRange& range, std::uint32_t side) {
  BuildRange half = range;
  const std::size_t middle = range.begin + range.size() / 2;
  (side == 0 ? half.end : half.begin) = middle;
  ++half.level;
  return half;
}

SplitSides split_sides(const BuildRange& range, const Bins& bins, const BinSplit& split) {
  const BinMapping mapping(range.centroids);
  const float plane = lane_of(mapping.base, split.axis) +
                      static_cast<float>(split.position) / lane_of(mapping.scale, split.axis);
  const std::size_t middle = range.begin + left_count(bins, split);
  SplitSides sides;
  for (int side = 0; side < 2; ++side) {
    BuildRange& child = sides.ranges[side];
    child.begin = side == 0 ? range.begin : middle;
    child.end = side == 0 ? middle : range.end;
    child.bounds = side == 0 ? left_bounds(bins, split) : right_bounds(bins, split);
    const LaneBox doubled{_mm_add_ps(child.bounds.lower, child.bounds.lower),
                          _mm_add_ps(child.bounds.upper, child.bounds.upper)};
    child.centroids = range.centroids;
    __m128& cut = side == 0 ? child.centroids.upper : child.centroids.lower;
    cut = with_lane(cut, split.axis, plane);
    child.centroids = intersection(child.centroids, doubled);
    child.buffer = 1 - range.buffer;
    child.level = range.level + 1;
    sides.mappings[side] = BinMapping(child.centroids);
    sides.next[side] = child.begin;
  }
  return sides;
}

GroupedNode build_range(const BuildContext& context, const BuildRange& range, const Bins& bins,
                        NodeList& list) {
  if (range.size() <= small_range) return build_small_range(context, range, list);
  if (must_halve(range.level, range.size())) return build_halves(context, range, list);
  const BinSplit split = best_split(bins, context.scale, context.run_log2);
  if (split.occupied < few_bins && !range.tight) {
    BuildRange tight = range;
    measure(context, tight);
    Bins again;
    fill_bins(context, tight, again);
    return build_range(context, tight, again, list);
  }
  if (split.axis < 0) return build_halves(context, range, list);
  SplitSides sides = split_sides(range, bins, split);
  if (sides.ranges[0].size() <= small_range && sides.ranges[1].size() <= small_range)
    return build_small_sides(context, range, split, sides, list);
  Bins left, right;
  Bins* const both[2] = {&left, &right};
  move<true>(context, range, split, sides, both);
  const std::uint32_t first = list.add_pair();
  put_node(list, first, build_range(context, sides.ranges[0], left, list));
  put_node(list, first + 1, build_range(context, sides.ranges[1], right, list));
  return make_node(range.bounds, first, 0, 0);
}

} // namespace fastrt
