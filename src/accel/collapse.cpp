// SPDX-License-Identifier: Apache-2.0
#include "src/accel/collapse_plan.hpp"
#include "src/accel/parallel.hpp"
#include "src/accel/tree.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <deque>
#include <string>
#include <utility>

namespace fastrt {
namespace {

// So many parts are collapsed at the same time, at most. The number of threads has no say in it.
constexpr std::size_t enough_parts = 128;

void set_box(WideNode& wide, int i, const BinaryNode& box) {
  wide.lower_x[i] = box.lower[0];
  wide.upper_x[i] = box.upper[0];
  wide.lower_y[i] = box.lower[1];
  wide.upper_y[i] = box.upper[1];
  wide.lower_z[i] = box.lower[2];
  wide.upper_z[i] = box.upper[2];
  wide.size[i] = size_exponent(std::max(box.upper[0] - box.lower[0],
                                        std::max(box.upper[1] - box.lower[1], box.upper[2] - box.lower[2])));
}

// Nodes and blocks in depth-first order: a node, the blocks of its leaves, then child by child what lies
// below.
class WideList {
public:
  Column<WideNode> nodes;
  std::array<Column<std::int32_t>, max_groups> slots;

  std::uint32_t add_leaf(const BinaryTree& tree, std::uint32_t binary) {
    // All that lies below the node is neighbours in the order.
    std::uint32_t first = binary, last = binary;
    while (tree.nodes[first].count == 0) first = tree.nodes[first].first;
    while (tree.nodes[last].count == 0) last = tree.nodes[last].first + 1;
    const std::uint32_t* ids = tree.order.data() + tree.nodes[first].first;
    const std::size_t count = tree.nodes[last].first + tree.nodes[last].count - tree.nodes[first].first;
    const std::uint32_t group = tree.group_of_leaf[first];
    Column<std::int32_t>& blocks = slots[group];
    const std::size_t first_block = blocks.size() / block_size;
    const std::size_t block_count = (count + block_size - 1) / block_size;
    for (std::size_t i = 0; i < block_count * block_size; ++i)
      blocks.push_back(i < count ? static_cast<std::int32_t>(ids[i]) : -1);
    return make_leaf(group, static_cast<std::uint32_t>(first_block), static_cast<std::uint32_t>(block_count));
  }

  // A node with its boxes and leaves; its inner children are still to come.
  std::uint32_t add_node(const BinaryTree& tree, const CollapsePlan& plan, const std::uint32_t* children,
                         int count) {
    const std::size_t index = nodes.size();
    if (index == reserved_) nodes.reserve(reserved_ = index + index / 2 + 16);
    nodes.resize(index + 1);
    WideNode& wide = nodes[index];
    for (int i = 0; i < wide_children; ++i) {
      wide.size[i] = 0;
      wide.child[i] = no_child;
      if (i < count) {
        set_box(wide, i, tree.nodes[children[i]]);
        if (plan.is_leaf(children[i])) wide.child[i] = add_leaf(tree, children[i]);
      } else {
        wide.lower_x[i] = wide.lower_y[i] = wide.lower_z[i] = infinity;
        wide.upper_x[i] = wide.upper_y[i] = wide.upper_z[i] = -infinity;
      }
    }
    return static_cast<std::uint32_t>(index);
  }

  std::uint32_t add_subtree(const BinaryTree& tree, const CollapsePlan& plan, std::uint32_t binary) {
    std::uint32_t children[wide_children];
    const int count = plan.children_of(binary, children);
    const std::uint32_t index = add_node(tree, plan, children, count);
    for (int i = 0; i < count; ++i) {
      if (plan.is_leaf(children[i])) continue;
      const std::uint32_t child = add_subtree(tree, plan, children[i]);
      nodes[index].child[i] = child;
    }
    return index;
  }

private:
  std::size_t reserved_ = 0;
};

// A whole subtree on its own, or one node near the root; and where it goes in the whole.
struct Part {
  std::uint32_t binary = 0;
  bool one_node = false;
  std::size_t below[wide_children] = {}; // of one node: which parts its inner children are
  WideList list;
  std::size_t first_node = 0;
  std::size_t first_block[max_groups] = {};
};

class Collapser {
public:
  Collapser(const BinaryTree& tree, const BuildSettings& settings)
      : tree_(tree), threads_(settings.threads), plan_(tree, settings) {}

  WideTree collapse() {
    const BinaryNode& root = tree_.nodes[0];
    wide_.bounds = {{root.lower[0], root.lower[1], root.lower[2]},
                    {root.upper[0], root.upper[1], root.upper[2]}};
    if (plan_.is_leaf(0)) {
      WideList leaf;
      wide_.root = leaf.add_leaf(tree_, 0);
      wide_.slots = std::move(leaf.slots);
      return std::move(wide_);
    }
    const std::size_t first_whole = cut();
    TaskFailure failure;
    run_tasks(threads_, failure, [&] {
      for (std::size_t i = first_whole; i < parts_.size(); ++i)
        spawn(failure, [this, part = &parts_[i]] { part->list.add_subtree(tree_, plan_, part->binary); });
    });
    wide_.root = place(0);
    make_room();
    run_tasks(threads_, failure, [&] {
      for (const Part& part : parts_) spawn(failure, [this, from = &part] { copy(*from); });
    });
    return std::move(wide_);
  }

private:
  // Expands nodes breadth first from the root until what lies below makes enough parts. Returns the number of
  // the first part that is a whole subtree.
  std::size_t cut() {
    parts_.emplace_back();
    std::size_t next = 0;
    for (; next < parts_.size() && parts_.size() - next < enough_parts; ++next) {
      Part& part = parts_[next];
      std::uint32_t children[wide_children];
      const int count = plan_.children_of(part.binary, children);
      part.one_node = true;
      part.list.add_node(tree_, plan_, children, count);
      for (int i = 0; i < count; ++i) {
        if (plan_.is_leaf(children[i])) continue;
        part.below[i] = parts_.size();
        parts_.emplace_back().binary = children[i];
      }
    }
    return next;
  }

  std::uint32_t place(std::size_t index) {
    Part& part = parts_[index];
    part.first_node = node_count_;
    node_count_ += part.list.nodes.size();
    for (std::size_t group = 0; group < max_groups; ++group) {
      part.first_block[group] = block_counts_[group];
      block_counts_[group] += part.list.slots[group].size() / block_size;
    }
    for (int i = 0; part.one_node && i < wide_children; ++i)
      if (part.below[i] != 0) part.list.nodes[0].child[i] = place(part.below[i]);
    return static_cast<std::uint32_t>(part.first_node);
  }

  void make_room() {
    wide_.nodes.resize(node_count_);
    for (std::size_t group = 0; group < max_groups; ++group) {
      if (block_counts_[group] > max_blocks)
        throw LimitError("too many primitives for one tree: more than " + std::to_string(max_blocks) +
                         " blocks");
      wide_.slots[group].resize(block_counts_[group] * block_size);
    }
  }

  void copy(const Part& part) {
    for (std::size_t n = 0; n < part.list.nodes.size(); ++n) {
      WideNode& node = wide_.nodes[part.first_node + n];
      node = part.list.nodes[n];
      for (std::uint32_t& child : node.child) {
        if (child == no_child) continue;
        if (is_leaf(child))
          child += static_cast<std::uint32_t>(part.first_block[leaf_group(child)]);
        else if (!part.one_node)
          child += static_cast<std::uint32_t>(part.first_node);
      }
    }
    for (std::size_t group = 0; group < max_groups; ++group)
      std::copy(part.list.slots[group].begin(), part.list.slots[group].end(),
                wide_.slots[group].begin() + part.first_block[group] * block_size);
  }

  const BinaryTree& tree_;
  int threads_;
  CollapsePlan plan_;
  std::deque<Part> parts_;
  std::size_t node_count_ = 0;
  std::size_t block_counts_[max_groups] = {};
  WideTree wide_;
};

} // namespace

WideTree collapse(const BinaryTree& tree, const BuildSettings& settings) {
  if (tree.nodes.empty()) return {};
  return Collapser(tree, settings).collapse();
}

} // namespace fastrt
