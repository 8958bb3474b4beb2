// SPDX-License-Identifier: Apache-2.0
// Where one subtree would best be moved to.
#pragma once

#include "src/accel/linked_tree.hpp"

#include <utility>

namespace fastrt {

// A node, and the sibling that would make the tree cheapest; LinkedTree::none if any would make it dearer.
struct Reinsertion {
  std::uint32_t node = 0, target = LinkedTree::none;
  float gain = 0; // in scaled half area
};

// The search for the best place of one node, from its parent upwards: at every node on the way the other
// child's subtree is searched, as far as it can hold something better than the best so far.
class Search {
public:
  Search(const LinkedTree& tree, __m128 scale, std::uint32_t node)
      : tree_(tree), scale_(scale), box_(tree.box(node)), area_(half_area(box_, scale)), best_{node} {}

  Reinsertion run() {
    const std::uint32_t parent = tree_.parent(best_.node);
    // What goes away with the node: its parent's box, and all that boxes above shrink by.
    float gone = half_area(tree_.box(parent), scale_);
    std::uint32_t above = parent, other = tree_.sibling(best_.node);
    LaneBox rest; // of `above`, without the node
    for (;;) {
      const LaneBox other_box = tree_.box(other);
      offer_subtree(other, other_box, gone);
      rest.extend(other_box);
      if (above == LinkedTree::root) return best_;
      if (above != parent) {
        const float rest_area = half_area(rest, scale_);
        offer(above, gone - rest_area);
        gone += half_area(tree_.box(above), scale_) - rest_area;
      }
      other = tree_.sibling(above);
      above = tree_.parent(above);
    }
  }

private:
  // A subtree without its root's own place; what putting the node anywhere below gains before its new
  // parent's box.
  struct Open {
    std::uint32_t node;
    float gain;
  };

  void offer(std::uint32_t target, float gain) {
    if (!(gain > best_.gain)) return;
    best_.gain = gain;
    best_.target = target;
  }

  // No new parent is smaller than the node.
  bool promising(float gain) const { return gain - area_ > best_.gain; }

  void offer_subtree(std::uint32_t top, const LaneBox& box, float gain) {
    if (!promising(gain)) return;
    LaneBox both = box;
    both.extend(box_);
    gain -= half_area(both, scale_);
    offer(top, gain);
    Open stack[max_tree_depth + 1];
    int count = 0;
    push({top, gain + half_area(box, scale_)}, stack, count);
    while (count > 0) {
      const Open open = stack[--count];
      if (promising(open.gain)) offer_children(open, stack, count);
    }
  }

  void push(const Open& open, Open* stack, int& count) const {
    if (promising(open.gain) && !tree_.is_leaf(open.node)) stack[count++] = open;
  }

  void offer_children(const Open& open, Open* stack, int& count) {
    const std::uint32_t left = tree_.left(open.node), right = tree_.right(open.node);
    const LaneBox left_box = tree_.box(left), right_box = tree_.box(right);
    LaneBox left_both = left_box, right_both = right_box;
    left_both.extend(box_);
    right_both.extend(box_);
    alignas(16) float areas[4];
    _mm_store_ps(areas, sum_terms(area_terms(left_both, scale_), area_terms(right_both, scale_),
                                  area_terms(left_box, scale_), area_terms(right_box, scale_)));
    const float left_gain = open.gain - areas[0], right_gain = open.gain - areas[1];
    offer(left, left_gain);
    offer(right, right_gain);
    Open first{left, left_gain + areas[2]}, second{right, right_gain + areas[3]};
    if (first.gain < second.gain) std::swap(first, second);
    push(second, stack, count);
    push(first, stack, count);
  }

  const LinkedTree& tree_;
  __m128 scale_;
  LaneBox box_;
  float area_;
  Reinsertion best_;
};

} // namespace fastrt
