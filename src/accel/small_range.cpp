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
static_assert(small_range <= 1U << index_bits && small_range % 8 == 0);

struct SortedSplit {
  float cost = infinity;
  int axis = -1;
  std::size_t left_count = 0;
};

// Their indices along each axis, in order.
struct Lists {
  std::uint8_t sorted[3][small_range];
};

// A few primitives, sorted along the three axes once; every split keeps the three lists sorted. Loops are few
// and without branches: so short ones end where no processor expects it.
class SmallRange {
public:
  SmallRange(const BuildContext& context, const BuildRange& range, NodeList& list)
      : context_(context), list_(list), begin_(range.begin) {
    const PrimitiveBox* boxes = context.buffers[range.buffer] + range.begin;
    for (std::size_t i = 0; i < range.size(); ++i) {
      const LaneBox box = load(boxes[i]);
      lower_[i] = box.lower;
      upper_[i] = box.upper;
      ids_[i] = boxes[i].id;
      groups_[i] = static_cast<std::uint8_t>(boxes[i].group);
    }
    sort(range.size(), range.centroids);
  }

  // Of the primitives begin .. end - 1 of one of the two sets of lists.
  GroupedNode build(std::size_t begin, std::size_t end, const LaneBox& bounds, int level, Lists& lists) {
    const std::size_t count = end - begin;
    const bool homogeneous = context_.one_group || is_homogeneous(begin, end, lists);
    if (homogeneous && count <= block_size) return make_leaf_node(begin, end, bounds, lists.sorted[0]);
    SortedSplit split;
    if (!must_halve(level, count)) {
      if (homogeneous || count > block_size) split = best_split(begin, end, lists);
      const float area = half_area(bounds, context_.scale);
      const bool pays = count > max_leaf_size || node_cost(context_.run_log2) * area + split.cost <
                                                     runs_of(count, context_.run_log2) * area;
      if (!pays && homogeneous) return make_leaf_node(begin, end, bounds, lists.sorted[0]);
      if (!homogeneous && (!pays || split.axis < 0))
        return make_inner_node(begin, end, divide_by_group(begin, end, lists), bounds, level, lists);
    }
    if (split.axis < 0) split = {0, 0, count / 2};
    if (homogeneous && std::max(split.left_count, count - split.left_count) <= block_size)
      return make_two_leaves(begin, end, begin + split.left_count, bounds, lists.sorted[split.axis]);
    std::uint32_t right = 0;
    for (std::size_t i = begin + split.left_count; i < end; ++i) right |= 1U << lists.sorted[split.axis][i];
    return make_inner_node(begin, end, {right, split.left_count}, bounds, level, lists);
  }

  GroupedNode build(const BuildRange& range) {
    return build(0, range.size(), range.bounds, range.level, lists_[0]);
  }

private:
  using Keys = std::int16_t[3][small_range];

  // Where each primitive belongs is how many come before it, found for eight at a time.
  void sort(std::size_t count, const LaneBox& centroids) {
    alignas(16) Keys keys;
    make_keys(count, centroids, keys);
    for (int axis = 0; axis < 3; ++axis) {
      __m128i others[small_range];
      for (std::size_t i = 0; i < count; ++i) others[i] = _mm_set1_epi16(keys[axis][i]);
      for (std::size_t i = 0; i < count; i += 8) {
        const __m128i eight = _mm_load_si128(reinterpret_cast<const __m128i*>(keys[axis] + i));
        __m128i smaller = _mm_setzero_si128();
        for (std::size_t j = 0; j < count; ++j)
          smaller = _mm_sub_epi16(smaller, _mm_cmpgt_epi16(eight, others[j]));
        alignas(16) std::uint16_t before[8];
        _mm_store_si128(reinterpret_cast<__m128i*>(before), smaller);
        // What only fills the eight up comes after all others, where nothing is read.
        for (std::size_t j = 0; j < 8; ++j)
          lists_[0].sorted[axis][before[j]] = static_cast<std::uint8_t>(i + j);
      }
    }
  }

  // The centroid's place in the range and the index share one integer, so that no two are equal. There is a
  // multiple of eight; those too many are the largest.
  void make_keys(std::size_t count, const LaneBox& centroids, Keys& keys) const {
    constexpr int places = 1 << (16 - index_bits), smallest = std::numeric_limits<std::int16_t>::min();
    const __m128 extent = _mm_sub_ps(centroids.upper, centroids.lower);
    const __m128 wide = _mm_cmpge_ps(extent, _mm_set1_ps(std::numeric_limits<float>::min()));
    const __m128 last = _mm_set1_ps(places - 1);
    const __m128 steps = _mm_and_ps(wide, _mm_div_ps(last, extent));
    for (std::size_t i = 0; i < count; i += 8)
      for (auto& column : keys)
        _mm_store_si128(reinterpret_cast<__m128i*>(column + i),
                        _mm_set1_epi16(std::numeric_limits<std::int16_t>::max()));
    for (std::size_t i = 0; i < count; ++i) {
      const __m128 centroid = doubled_centroid({lower_[i], upper_[i]});
      const __m128 place = _mm_mul_ps(_mm_sub_ps(centroid, centroids.lower), steps);
      const __m128i whole = _mm_cvttps_epi32(_mm_min_ps(_mm_max_ps(place, _mm_setzero_ps()), last));
      const __m128i key =
          _mm_add_epi32(_mm_slli_epi32(whole, index_bits), _mm_set1_epi32(static_cast<int>(i) + smallest));
      keys[0][i] = static_cast<std::int16_t>(_mm_extract_epi16(key, 0));
      keys[1][i] = static_cast<std::int16_t>(_mm_extract_epi16(key, 2));
      keys[2][i] = static_cast<std::int16_t>(_mm_extract_epi16(key, 4));
    }
  }

  bool is_homogeneous(std::size_t begin, std::size_t end, const Lists& lists) const {
    const std::uint8_t* list = lists.sorted[0];
    return std::all_of(list + begin, list + end,
                       [&](std::uint8_t i) { return groups_[i] == groups_[list[begin]]; });
  }

  // Tries every plane between two primitives of each axis' list, all axes side by side.
  SortedSplit best_split(std::size_t begin, std::size_t end, const Lists& lists) const {
    const std::size_t count = end - begin;
    const std::uint8_t* const sorted[3] = {lists.sorted[0] + begin, lists.sorted[1] + begin,
                                           lists.sorted[2] + begin};
    __m128 right_costs[small_range];
    LaneBox right[3], left[3];
    __m128i right_count = _mm_setzero_si128(), left_count = right_count;
    for (std::size_t i = count - 1; i > 0; --i) {
      for (int axis = 0; axis < 3; ++axis) right[axis].extend(box(sorted[axis][i]));
      right_count = _mm_add_epi32(right_count, _mm_set1_epi32(1));
      right_costs[i] = _mm_mul_ps(half_areas(right, context_.scale), runs_of(right_count, context_.run_log2));
    }
    LeastCosts least;
    for (std::size_t i = 1; i < count; ++i) {
      for (int axis = 0; axis < 3; ++axis) left[axis].extend(box(sorted[axis][i - 1]));
      left_count = _mm_add_epi32(left_count, _mm_set1_epi32(1));
      const __m128 left_costs =
          _mm_mul_ps(half_areas(left, context_.scale), runs_of(left_count, context_.run_log2));
      least.offer(_mm_add_ps(left_costs, right_costs[i]), static_cast<int>(i));
    }
    const int axis = least.axis();
    if (axis < 0) return {};
    return {least.cost(axis), axis, static_cast<std::size_t>(least.place(axis))};
  }

  // Which primitives go to the right, a bit for each, and how many go to the left.
  struct Sides {
    std::uint32_t right;
    std::size_t left_count;
  };

  Sides divide_by_group(std::size_t begin, std::size_t end, const Lists& lists) const {
    const std::uint8_t* list = lists.sorted[0];
    Sides sides{0, 0};
    for (std::size_t i = begin; i < end; ++i) {
      const bool differs = groups_[list[i]] != groups_[list[begin]];
      sides.right |= static_cast<std::uint32_t>(differs) << list[i];
      sides.left_count += differs ? 0 : 1;
    }
    return sides;
  }

  static void divide(std::size_t begin, std::size_t end, const Sides& sides, const Lists& from, Lists& to) {
    std::size_t left[3] = {begin, begin, begin};
    const std::size_t to_right = sides.left_count + begin;
    for (std::size_t i = begin; i < end; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const std::uint8_t index = from.sorted[axis][i];
        const std::size_t is_right = sides.right >> index & 1U;
        const std::size_t right = to_right + (i - left[axis]);
        to.sorted[axis][is_right != 0 ? right : left[axis]] = index;
        left[axis] += is_right ^ 1U;
      }
  }

  GroupedNode make_leaf_node(std::size_t begin, std::size_t end, const LaneBox& bounds,
                             const std::uint8_t* list) const {
    for (std::size_t i = begin; i < end; ++i) context_.order[begin_ + i] = ids_[list[i]];
    return make_node(bounds, begin_ + begin, end - begin, groups_[list[begin]]);
  }

  // Leaves need no sorted lists.
  GroupedNode make_two_leaves(std::size_t begin, std::size_t end, std::size_t middle, const LaneBox& bounds,
                              const std::uint8_t* list) {
    const std::uint32_t first = list_.add_pair();
    put_node(list_, first, make_leaf_node(begin, middle, bounds_of(begin, middle, list), list));
    put_node(list_, first + 1, make_leaf_node(middle, end, bounds_of(middle, end, list), list));
    return make_node(bounds, first, 0, 0);
  }

  GroupedNode make_inner_node(std::size_t begin, std::size_t end, const Sides& sides, const LaneBox& bounds,
                              int level, Lists& lists) {
    Lists& below = &lists == lists_ ? lists_[1] : lists_[0];
    divide(begin, end, sides, lists, below);
    const std::size_t middle = begin + sides.left_count;
    const std::uint32_t first = list_.add_pair();
    const std::uint8_t* list = below.sorted[0];
    put_node(list_, first, build(begin, middle, bounds_of(begin, middle, list), level + 1, below));
    put_node(list_, first + 1, build(middle, end, bounds_of(middle, end, list), level + 1, below));
    return make_node(bounds, first, 0, 0);
  }

  LaneBox box(std::size_t i) const { return {lower_[i], upper_[i]}; }

  LaneBox bounds_of(std::size_t begin, std::size_t end, const std::uint8_t* list) const {
    LaneBox bounds;
    for (std::size_t i = begin; i < end; ++i) bounds.extend(box(list[i]));
    return bounds;
  }

  const BuildContext& context_;
  NodeList& list_;
  std::size_t begin_;
  __m128 lower_[small_range], upper_[small_range];
  std::uint32_t ids_[small_range];
  std::uint8_t groups_[small_range];
  Lists lists_[2]; // of even and of odd levels
};

} // namespace

GroupedNode build_small_range(const BuildContext& context, const BuildRange& range, NodeList& list) {
  return SmallRange(context, range, list).build(range);
}

} // namespace fastrt
