// SPDX-License-Identifier: Apache-2.0
#include "src/accel/subtree.hpp"

#include <algorithm>
#include <limits>

namespace fastrt {
namespace {

constexpr std::size_t max_leaf_size = std::size_t{block_size} * max_leaf_blocks;
// Of visiting a binary node, in runs: longer ones have more room for what small nodes would tell apart.
float node_cost(int run_log2) { return run_log2 > 2 ? 0.1F : 0.25F; }
constexpr int index_bits = 5;
static_assert(small_range <= 1U << index_bits && small_range % 4 == 0);

struct SortedSplit {
  float cost = infinity;
  int axis = -1;
  std::size_t left_count = 0;
};

// A few primitives, sorted along the three axes once; every split keeps the three lists sorted.
class SmallRange {
public:
  SmallRange(const BuildContext& context, const BuildRange& range, NodeList& list)
      : context_(context), list_(list), begin_(range.begin) {
    const PrimitiveBox* boxes = context.buffers[range.buffer] + range.begin;
    for (std::size_t i = 0; i < range.size(); ++i) {
      boxes_[i] = load(boxes[i]);
      ids_[i] = boxes[i].id;
      groups_[i] = static_cast<std::uint8_t>(boxes[i].group);
    }
    sort(range.size(), range.centroids);
  }

  GroupedNode build(std::size_t begin, std::size_t end, const LaneBox& bounds, int level) {
    const std::size_t count = end - begin;
    const bool homogeneous = context_.one_group || is_homogeneous(begin, end);
    if (homogeneous && count <= block_size) return make_leaf_node(begin, end, bounds);
    SortedSplit split;
    if (!must_halve(level, count)) {
      if (homogeneous || count > block_size) split = best_split(begin, end);
      const float area = half_area(bounds, context_.scale);
      const bool pays = count > max_leaf_size || node_cost(context_.run_log2) * area + split.cost <
                                                     runs_of(count, context_.run_log2) * area;
      if (!pays && homogeneous) return make_leaf_node(begin, end, bounds);
      if (!homogeneous && (!pays || split.axis < 0))
        return make_inner_node(begin, divide_by_group(begin, end), end, bounds, level);
    }
    if (split.axis < 0) split = {0, 0, count / 2};
    const std::size_t middle = divide(begin, end, split);
    return make_inner_node(begin, middle, end, bounds, level);
  }

private:
  // Sorts by counting how many come before: no branches. The centroid's place in the range and the index
  // share one integer, so that no two are equal.
  void sort(std::size_t count, const LaneBox& centroids) {
    alignas(16) std::int32_t keys[3][small_range];
    const __m128 extent = _mm_sub_ps(centroids.upper, centroids.lower);
    const __m128 wide = _mm_cmpge_ps(extent, _mm_set1_ps(std::numeric_limits<float>::min()));
    const __m128 steps = _mm_and_ps(wide, _mm_div_ps(_mm_set1_ps(0x1p24F), extent));
    for (std::size_t i = 0; i < small_range; ++i) {
      __m128i key = _mm_set1_epi32(std::numeric_limits<std::int32_t>::max());
      if (i < count) {
        const __m128 place = _mm_mul_ps(_mm_sub_ps(doubled_centroid(boxes_[i]), centroids.lower), steps);
        key = _mm_add_epi32(_mm_slli_epi32(_mm_cvttps_epi32(place), index_bits),
                            _mm_set1_epi32(static_cast<int>(i)));
      }
      alignas(16) std::int32_t xyz[4];
      _mm_store_si128(reinterpret_cast<__m128i*>(xyz), key);
      for (int axis = 0; axis < 3; ++axis) keys[axis][i] = xyz[axis];
    }
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < count; ++i)
        sorted_[axis][rank(keys[axis], count, i)] = static_cast<std::uint8_t>(i);
  }

  static std::size_t rank(const std::int32_t* keys, std::size_t count, std::size_t i) {
    const __m128i key = _mm_set1_epi32(keys[i]);
    __m128i before = _mm_setzero_si128();
    for (std::size_t j = 0; j < count; j += 4)
      before = _mm_sub_epi32(
          before, _mm_cmpgt_epi32(key, _mm_load_si128(reinterpret_cast<const __m128i*>(keys + j))));
    before = _mm_add_epi32(before, _mm_shuffle_epi32(before, _MM_SHUFFLE(1, 0, 3, 2)));
    before = _mm_add_epi32(before, _mm_shuffle_epi32(before, _MM_SHUFFLE(2, 3, 0, 1)));
    return static_cast<std::size_t>(_mm_cvtsi128_si32(before));
  }

  bool is_homogeneous(std::size_t begin, std::size_t end) const {
    const std::uint8_t* list = sorted_[0];
    return std::all_of(list + begin, list + end,
                       [&](std::uint8_t i) { return groups_[i] == groups_[list[begin]]; });
  }

  SortedSplit best_split(std::size_t begin, std::size_t end) const {
    SortedSplit best;
    for (int axis = 0; axis < 3; ++axis) find_split(axis, begin, end - begin, best);
    return best;
  }

  // Tries every plane between two primitives of the axis' list, four at a time.
  void find_split(int axis, std::size_t begin, std::size_t count, SortedSplit& best) const {
    const int run_log2 = context_.run_log2;
    const std::uint8_t* list = sorted_[axis] + begin;
    __m128 left_terms[small_range + 4], right_terms[small_range + 4];
    LaneBox left, right;
    for (std::size_t i = 1; i < count; ++i) {
      left.extend(boxes_[list[i - 1]]);
      left_terms[i] = area_terms(left, context_.scale);
      right.extend(boxes_[list[count - i]]);
      right_terms[count - i] = area_terms(right, context_.scale);
    }
    for (std::size_t i = count; i < count + 4; ++i) left_terms[i] = right_terms[i] = _mm_set1_ps(infinity);
    const __m128i counts = _mm_set1_epi32(static_cast<int>(count));
    __m128i left_counts = _mm_set_epi32(4, 3, 2, 1);
    __m128 best_costs = _mm_set1_ps(infinity);
    __m128i best_counts = _mm_setzero_si128();
    for (std::size_t i = 1; i < count; i += 4) {
      const __m128 left_areas =
          sum_terms(left_terms[i], left_terms[i + 1], left_terms[i + 2], left_terms[i + 3]);
      const __m128 right_areas =
          sum_terms(right_terms[i], right_terms[i + 1], right_terms[i + 2], right_terms[i + 3]);
      const __m128 costs =
          _mm_add_ps(_mm_mul_ps(left_areas, runs_of(left_counts, run_log2)),
                     _mm_mul_ps(right_areas, runs_of(_mm_sub_epi32(counts, left_counts), run_log2)));
      const __m128 better = _mm_cmplt_ps(costs, best_costs);
      best_costs = select(better, costs, best_costs);
      best_counts = select(_mm_castps_si128(better), left_counts, best_counts);
      left_counts = _mm_add_epi32(left_counts, _mm_set1_epi32(4));
    }
    alignas(16) float cost[4];
    alignas(16) std::int32_t left_count[4];
    _mm_store_ps(cost, best_costs);
    _mm_store_si128(reinterpret_cast<__m128i*>(left_count), best_counts);
    for (int i = 0; i < 4; ++i)
      if (cost[i] < best.cost) best = {cost[i], axis, static_cast<std::size_t>(left_count[i])};
  }

  std::size_t divide(std::size_t begin, std::size_t end, const SortedSplit& split) {
    const std::uint8_t* list = sorted_[split.axis] + begin;
    for (std::size_t i = 0; i < end - begin; ++i) is_right_[list[i]] = i >= split.left_count;
    for (int axis = 0; axis < 3; ++axis)
      if (axis != split.axis) divide_list(axis, begin, end);
    return begin + split.left_count;
  }

  std::size_t divide_by_group(std::size_t begin, std::size_t end) {
    const std::uint8_t group = groups_[sorted_[0][begin]];
    for (std::size_t i = begin; i < end; ++i) is_right_[sorted_[0][i]] = groups_[sorted_[0][i]] != group;
    std::size_t middle = begin;
    for (int axis = 0; axis < 3; ++axis) middle = divide_list(axis, begin, end);
    return middle;
  }

  std::size_t divide_list(int axis, std::size_t begin, std::size_t end) {
    std::uint8_t right[small_range];
    std::uint8_t* list = sorted_[axis];
    std::size_t middle = begin, right_count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint8_t index = list[i];
      list[middle] = index;
      right[right_count] = index;
      middle += !is_right_[index];
      right_count += is_right_[index];
    }
    std::copy(right, right + right_count, list + middle);
    return middle;
  }

  GroupedNode make_leaf_node(std::size_t begin, std::size_t end, const LaneBox& bounds) const {
    for (std::size_t i = begin; i < end; ++i) context_.order[begin_ + i] = ids_[sorted_[0][i]];
    return make_node(bounds, begin_ + begin, end - begin, groups_[sorted_[0][begin]]);
  }

  GroupedNode make_inner_node(std::size_t begin, std::size_t middle, std::size_t end, const LaneBox& bounds,
                              int level) {
    const std::uint32_t first = list_.add_pair();
    put_node(list_, first, build(begin, middle, bounds_of(begin, middle), level + 1));
    put_node(list_, first + 1, build(middle, end, bounds_of(middle, end), level + 1));
    return make_node(bounds, first, 0, 0);
  }

  LaneBox bounds_of(std::size_t begin, std::size_t end) const {
    LaneBox bounds;
    for (std::size_t i = begin; i < end; ++i) bounds.extend(boxes_[sorted_[0][i]]);
    return bounds;
  }

  const BuildContext& context_;
  NodeList& list_;
  std::size_t begin_;
  LaneBox boxes_[small_range];
  std::uint32_t ids_[small_range];
  std::uint8_t groups_[small_range];
  std::uint8_t is_right_[small_range];
  std::uint8_t sorted_[3][small_range];
};

} // namespace

GroupedNode build_small_range(const BuildContext& context, const BuildRange& range, NodeList& list) {
  return SmallRange(context, range, list).build(0, range.size(), range.bounds, range.level);
}

} // namespace fastrt
