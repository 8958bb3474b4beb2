// SPDX-License-Identifier: Apache-2.0
#include "src/accel/subtree.hpp"

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

float lane_of(__m128 values, int lane) {
  alignas(16) float lanes[4];
  _mm_store_ps(lanes, values);
  return lanes[lane];
}

GroupedNode build_halves(const BuildContext& context, const BuildRange& range, NodeList& list) {
  const std::uint32_t first = list.add_pair();
  for (std::uint32_t side = 0; side < 2; ++side) {
    const BuildRange child = half_of(context, range, side);
    Bins bins;
    fill_bins(context.buffers[child.buffer] + child.begin, child.size(), BinMapping(child.centroids), bins);
    put_node(list, first + side, build_range(context, child, bins, list));
  }
  return make_node(range.bounds, first, 0, 0);
}

// Moves primitives to their sides, and into bins only if these are asked for. What a primitive's bins wait
// for is kept short, or they are late for the next primitives': the axis is looked at by itself, in all
// lanes, and both sides' mappings are at hand before it is known which counts.
template <bool into_bins>
void move(const BuildContext& context, const BuildRange& range, std::size_t begin, std::size_t end,
          const BinSplit& split, const SplitSides& sides, Bins* const bins[2]) {
  const PrimitiveBox* from = context.buffers[range.buffer];
  PrimitiveBox* to = context.buffers[1 - range.buffer];
  const BinMapping mapping(range.centroids);
  const int axis = split.axis;
  const __m128 base = _mm_set1_ps(lane_of(mapping.base, axis));
  const __m128 scale = _mm_set1_ps(lane_of(mapping.scale, axis));
  const __m128 plane = _mm_set1_ps(static_cast<float>(split.position));
  const BinMapping left_mapping = sides.mappings[0], right_mapping = sides.mappings[1];
  PrimitiveBox *next_left = to + sides.next[0], *next_right = to + sides.next[1];
  for (std::size_t i = begin; i < end; ++i) {
    const __m128 lower_and_id = _mm_load_ps(from[i].lower), upper_and_group = _mm_load_ps(from[i].upper);
    const __m128 place =
        _mm_mul_ps(_mm_sub_ps(_mm_set1_ps(from[i].lower[axis] + from[i].upper[axis]), base), scale);
    const __m128 is_right = _mm_cmpge_ps(place, plane);
    const std::size_t side = static_cast<std::size_t>(_mm_movemask_ps(is_right)) & 1U;
    PrimitiveBox& moved = *(side != 0 ? next_right : next_left);
    next_left += 1 - side;
    next_right += side;
    _mm_store_ps(moved.lower, lower_and_id);
    _mm_store_ps(moved.upper, upper_and_group);
    if constexpr (into_bins) {
      const LaneBox box = clear_fourth({lower_and_id, upper_and_group});
      const __m128 centroid = doubled_centroid(box);
      const __m128i bin = select(_mm_castps_si128(is_right), right_mapping.unclamped(centroid),
                                 left_mapping.unclamped(centroid));
      (side != 0 ? bins[1] : bins[0])->add(box, clamp_bins(bin));
    }
  }
}

// Small ranges need no bins.
GroupedNode build_small_sides(const BuildContext& context, const BuildRange& range, const BinSplit& split,
                              const SplitSides& sides, NodeList& list) {
  move<false>(context, range, range.begin, range.end, split, sides, nullptr);
  const std::uint32_t first = list.add_pair();
  for (std::uint32_t side = 0; side < 2; ++side)
    put_node(list, first + side, build_small_range(context, sides.ranges[side], list));
  return make_node(range.bounds, first, 0, 0);
}

} // namespace

void measure(const BuildContext& context, BuildRange& range) {
  range.bounds = range.centroids = LaneBox{};
  const PrimitiveBox* boxes = context.buffers[range.buffer];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const LaneBox box = load(boxes[i]);
    range.bounds.extend(box);
    range.centroids.extend(doubled_centroid(box));
  }
  range.tight = true;
}

void fill_bins(const PrimitiveBox* boxes, std::size_t count, const BinMapping& mapping, Bins& bins) {
  for (std::size_t i = 0; i < count; ++i) {
    const LaneBox box = load(boxes[i]);
    bins.add(box, mapping(doubled_centroid(box)));
  }
}

BuildRange half_of(const BuildContext& context, const BuildRange& range, std::uint32_t side) {
  BuildRange half = range;
  const std::size_t middle = range.begin + range.size() / 2;
  (side == 0 ? half.end : half.begin) = middle;
  ++half.level;
  measure(context, half);
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

void move_to_sides(const BuildContext& context, const BuildRange& range, std::size_t begin, std::size_t end,
                   const BinSplit& split, SplitSides& sides, Bins* const bins[2]) {
  move<true>(context, range, begin, end, split, sides, bins);
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
    fill_bins(context.buffers[range.buffer] + range.begin, range.size(), BinMapping(tight.centroids), again);
    return build_range(context, tight, again, list);
  }
  if (split.axis < 0) return build_halves(context, range, list);
  SplitSides sides = split_sides(range, bins, split);
  if (sides.ranges[0].size() <= small_range && sides.ranges[1].size() <= small_range)
    return build_small_sides(context, range, split, sides, list);
  Bins left, right;
  Bins* const both[2] = {&left, &right};
  move_to_sides(context, range, range.begin, range.end, split, sides, both);
  const std::uint32_t first = list.add_pair();
  put_node(list, first, build_range(context, sides.ranges[0], left, list));
  put_node(list, first + 1, build_range(context, sides.ranges[1], right, list));
  return make_node(range.bounds, first, 0, 0);
}

} // namespace fastrt
