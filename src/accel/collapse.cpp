// SPDX-License-Identifier: Apache-2.0
#include "src/accel/collapse_plan.hpp"
#include "src/accel/parallel.hpp"
#include "src/accel/tree.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace fastrt {
namespace {

std::uint32_t size_of(const BinaryNode& box) {
  return size_exponent(std::max(box.upper[0] - box.lower[0],
                                std::max(box.upper[1] - box.lower[1], box.upper[2] - box.lower[2])));
}

void set_box(WideNode& wide, int i, const BinaryNode& box) {
  wide.lower_x[i] = box.lower[0];
  wide.upper_x[i] = box.upper[0];
  wide.lower_y[i] = box.lower[1];
  wide.upper_y[i] = box.upper[1];
  wide.lower_z[i] = box.lower[2];
  wide.upper_z[i] = box.upper[2];
  wide.size[i] = size_of(box);
}

// How many nodes, and blocks of each group; or the first ones that are free.
struct Extent {
  std::size_t nodes = 0;
  std::array<std::size_t, max_groups> blocks{};
};

// All primitives below a binary node, which are neighbours in the order.
struct LeafPart {
  std::uint32_t first, count, group;
  std::uint32_t block_count() const { return (count + block_size - 1) / block_size; }
};

LeafPart leaf_part(const BinaryTree& tree, std::uint32_t node) {
  std::uint32_t first = node, last = node;
  while (tree.nodes[first].count == 0) first = tree.nodes[first].first;
  while (tree.nodes[last].count == 0) last = tree.nodes[last].first + 1;
  const std::uint32_t begin = tree.nodes[first].first;
  return {begin, tree.nodes[last].first + tree.nodes[last].count - begin, tree.group_of_leaf[first]};
}

// A whole subtree on its own, or one node near the root; and where it goes in the whole.
struct Part {
  std::uint32_t binary = 0;
  bool one_node = false;
  std::array<std::size_t, wide_children> below{}; // of one node: the parts of its inner children
  Extent size, first;
};

// Nodes and blocks come to lie in depth-first order: a node, the blocks of its leaves, then child by child
// what is below. Parts are counted first, so that each can be written to its place at once.
class Collapser {
public:
  Collapser(const BinaryTree& tree, const BuildSettings& settings)
      : tree_(tree), threads_(settings.threads), plan_(tree, settings) {}

  WideTree collapse() {
    const BinaryNode& root = tree_.nodes[0];
    wide_.bounds = {{root.lower[0], root.lower[1], root.lower[2]},
                    {root.upper[0], root.upper[1], root.upper[2]}};
    Extent next;
    if (plan_.is_leaf(0)) {
      count_leaf(0, next);
      make_room(next);
      next = {};
      wide_.root = put_leaf(0, next);
      return std::move(wide_);
    }
    cut();
    for_each_part([this](Part& part) { count(part); });
    place(0, next);
    make_room(next);
    wide_.root = 0;
    for_each_part([this](Part& part) { put(part); });
    return std::move(wide_);
  }

private:
  // A node's children, the smallest first: those who look for any hit take the last first.
  int children_of(std::uint32_t binary, std::uint32_t* children) const {
    const int count = plan_.children_of(binary, children);
    std::uint32_t sizes[wide_children];
    for (int i = 0; i < count; ++i) {
      const std::uint32_t child = children[i], size = size_of(tree_.nodes[child]);
      int place = i;
      for (; place > 0 && sizes[place - 1] > size; --place) {
        sizes[place] = sizes[place - 1];
        children[place] = children[place - 1];
      }
      sizes[place] = size;
      children[place] = child;
    }
    return count;
  }

  template <class F>
  void for_each_part(const F& body) {
    TaskFailure failure;
    run_tasks(threads_, failure,
              [&] { for_each_index(parts_.size(), [&](std::size_t i) { body(parts_[i]); }); });
  }

  // Expands nodes breadth first from the root until what lies below makes enough parts.
  void cut() {
    const std::size_t enough = tasks_for(tree_.nodes.size(), threads_);
    parts_.emplace_back();
    for (std::size_t next = 0; next < parts_.size() && parts_.size() - next < enough; ++next) {
      std::uint32_t children[wide_children];
      const int count = children_of(parts_[next].binary, children);
      parts_[next].one_node = true;
      for (int i = 0; i < count; ++i) {
        if (plan_.is_leaf(children[i])) continue;
        parts_[next].below[static_cast<std::size_t>(i)] = parts_.size();
        parts_.emplace_back().binary = children[i];
      }
    }
  }

  void count(Part& part) const { count_node(part.binary, !part.one_node, part.size); }

  void count_node(std::uint32_t binary, bool below, Extent& size) const {
    std::uint32_t children[wide_children];
    const int count = children_of(binary, children);
    ++size.nodes;
    for (int i = 0; i < count; ++i) {
      if (plan_.is_leaf(children[i]))
        count_leaf(children[i], size);
      else if (below)
        count_node(children[i], below, size);
    }
  }

  void count_leaf(std::uint32_t binary, Extent& size) const {
    const LeafPart leaf = leaf_part(tree_, binary);
    size.blocks[leaf.group] += leaf.block_count();
  }

  void place(std::size_t index, Extent& next) {
    Part& part = parts_[index];
    part.first = next;
    next.nodes += part.size.nodes;
    for (std::size_t group = 0; group < max_groups; ++group) next.blocks[group] += part.size.blocks[group];
    for (const std::size_t below : part.below)
      if (below != 0) place(below, next);
  }

  void make_room(const Extent& size) {
    wide_.nodes.resize(size.nodes);
    for (std::size_t group = 0; group < max_groups; ++group) {
      if (size.blocks[group] > max_blocks)
        throw LimitError("too many primitives for one tree: more than " + std::to_string(max_blocks) +
                         " blocks");
      wide_.slots[group].resize(size.blocks[group] * block_size);
    }
  }

  void put(const Part& part) {
    Extent next = part.first;
    if (!part.one_node) {
      put_subtree(part.binary, next);
      return;
    }
    std::uint32_t children[wide_children];
    const int count = children_of(part.binary, children);
    WideNode& node = put_node(children, count, next);
    for (std::size_t i = 0; i < part.below.size(); ++i)
      if (part.below[i] != 0) node.child[i] = static_cast<std::uint32_t>(parts_[part.below[i]].first.nodes);
  }

  std::uint32_t put_subtree(std::uint32_t binary, Extent& next) {
    std::uint32_t children[wide_children];
    const int count = children_of(binary, children);
    const auto index = static_cast<std::uint32_t>(next.nodes);
    WideNode& node = put_node(children, count, next);
    for (int i = 0; i < count; ++i)
      if (!plan_.is_leaf(children[i])) node.child[i] = put_subtree(children[i], next);
    return index;
  }

  // A node with its boxes and leaves; its inner children are still to come.
  WideNode& put_node(const std::uint32_t* children, int count, Extent& next) {
    WideNode& wide = wide_.nodes[next.nodes++];
    for (int i = 0; i < wide_children; ++i) {
      wide.size[i] = 0;
      wide.child[i] = no_child;
      if (i < count) {
        set_box(wide, i, tree_.nodes[children[i]]);
        if (plan_.is_leaf(children[i])) wide.child[i] = put_leaf(children[i], next);
      } else {
        wide.lower_x[i] = wide.lower_y[i] = wide.lower_z[i] = infinity;
        wide.upper_x[i] = wide.upper_y[i] = wide.upper_z[i] = -infinity;
      }
    }
    return wide;
  }

  std::uint32_t put_leaf(std::uint32_t binary, Extent& next) {
    const LeafPart leaf = leaf_part(tree_, binary);
    const std::size_t block = next.blocks[leaf.group];
    std::int32_t* slots = wide_.slots[leaf.group].data() + block * block_size;
    next.blocks[leaf.group] += leaf.block_count();
    for (std::uint32_t i = 0; i < leaf.block_count() * block_size; ++i)
      slots[i] = i < leaf.count ? static_cast<std::int32_t>(tree_.order[leaf.first + i]) : -1;
    return make_leaf(leaf.group, static_cast<std::uint32_t>(block), leaf.block_count());
  }

  const BinaryTree& tree_;
  int threads_;
  CollapsePlan plan_;
  std::vector<Part> parts_;
  WideTree wide_;
};

} // namespace

WideTree collapse(const BinaryTree& tree, const BuildSettings& settings) {
  if (tree.nodes.empty()) return {};
  return Collapser(tree, settings).collapse();
}

} // namespace fastrt
