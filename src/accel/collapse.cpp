// SPDX-License-Identifier: Apache-2.0
#include "src/accel/tree.hpp"

#include <fastrt/error.hpp>

#include <string>

namespace fastrt {
namespace {

float half_area(const BinaryNode& node) {
  const float x = node.upper[0] - node.lower[0];
  const float y = node.upper[1] - node.lower[1];
  const float z = node.upper[2] - node.lower[2];
  return x * y + y * z + z * x;
}

void make_empty(WideNode& node) {
  for (int i = 0; i < wide_children; ++i) {
    node.lower_x[i] = node.lower_y[i] = node.lower_z[i] = infinity;
    node.upper_x[i] = node.upper_y[i] = node.upper_z[i] = -infinity;
    node.child[i] = no_child;
    node.unused[i] = 0;
  }
}

void set_box(WideNode& wide, int i, const BinaryNode& box) {
  wide.lower_x[i] = box.lower[0];
  wide.upper_x[i] = box.upper[0];
  wide.lower_y[i] = box.lower[1];
  wide.upper_y[i] = box.upper[1];
  wide.lower_z[i] = box.lower[2];
  wide.upper_z[i] = box.upper[2];
}

class Collapser {
public:
  explicit Collapser(const BinaryTree& tree) : tree_(tree) {}

  WideTree collapse() {
    if (tree_.nodes.empty()) return {};
    const BinaryNode& root = tree_.nodes[0];
    wide_.bounds = {{root.lower[0], root.lower[1], root.lower[2]},
                    {root.upper[0], root.upper[1], root.upper[2]}};
    wide_.root = root.count != 0 ? add_leaf(0) : add_node(0);
    return std::move(wide_);
  }

private:
  std::uint32_t add_leaf(std::uint32_t binary) {
    const BinaryNode& node = tree_.nodes[binary];
    const std::uint32_t group = tree_.group_of_leaf[binary];
    Column<std::int32_t>& slots = wide_.slots[group];
    const std::size_t first_block = slots.size() / block_size;
    const std::size_t blocks = (node.count + block_size - 1U) / block_size;
    if (first_block + blocks > max_blocks)
      throw LimitError("more than " + std::to_string(max_blocks) + " blocks of primitives");
    for (std::size_t i = 0; i < blocks * block_size; ++i)
      slots.push_back(i < node.count ? static_cast<std::int32_t>(tree_.order[node.first + i]) : -1);
    return make_leaf(group, static_cast<std::uint32_t>(first_block), static_cast<std::uint32_t>(blocks));
  }

  std::uint32_t add_node(std::uint32_t binary) {
    std::uint32_t adopted[wide_children] = {binary};
    int count = 1;
    for (int open = 0; open >= 0 && count < wide_children;) {
      const std::uint32_t first = tree_.nodes[adopted[open]].first;
      for (int i = count++; i > open + 1; --i) adopted[i] = adopted[i - 1];
      adopted[open] = first;
      adopted[open + 1] = first + 1;
      open = largest_inner(adopted, count);
    }
    const auto index = static_cast<std::uint32_t>(wide_.nodes.size());
    if (index % 1024 == 0) wide_.nodes.reserve(index + index / 2 + 1024);
    wide_.nodes.resize(index + 1);
    make_empty(wide_.nodes[index]);
    for (int i = 0; i < count; ++i) {
      set_box(wide_.nodes[index], i, tree_.nodes[adopted[i]]);
      if (tree_.nodes[adopted[i]].count != 0) wide_.nodes[index].child[i] = add_leaf(adopted[i]);
    }
    for (int i = 0; i < count; ++i) {
      if (tree_.nodes[adopted[i]].count != 0) continue;
      const std::uint32_t child = add_node(adopted[i]);
      wide_.nodes[index].child[i] = child;
    }
    return index;
  }

  int largest_inner(const std::uint32_t* adopted, int count) const {
    int largest = -1;
    float largest_area = -1;
    for (int i = 0; i < count; ++i) {
      const BinaryNode& node = tree_.nodes[adopted[i]];
      if (node.count != 0 || !(half_area(node) > largest_area)) continue;
      largest = i;
      largest_area = half_area(node);
    }
    return largest;
  }

  const BinaryTree& tree_;
  WideTree wide_;
};

} // namespace

WideTree collapse(const BinaryTree& tree, const BuildSettings&) { return Collapser(tree).collapse(); }

} // namespace fastrt
