// SPDX-License-Identifier: Apache-2.0
#include "src/accel/tree.hpp"

#include <algorithm>
#include <bit>

namespace fastrt {
namespace {

constexpr int bin_count = 16;
constexpr std::size_t max_leaf_size = std::size_t{block_size} * max_leaf_blocks;
constexpr float node_cost = 0.5F; // of visiting a binary node, in block tests

struct Bin {
  Aabb bounds;
  std::size_t count = 0;
};

struct Split {
  float cost = infinity;
  int axis = -1;
  int position = 0; // bins left of the plane
};

struct Task {
  std::size_t begin, end;
  std::uint32_t node;
  int level;
};

Vec3 lower(const PrimitiveBox& box) { return {box.lower[0], box.lower[1], box.lower[2]}; }
Vec3 upper(const PrimitiveBox& box) { return {box.upper[0], box.upper[1], box.upper[2]}; }
Vec3 centroid(const PrimitiveBox& box) { return 0.5F * lower(box) + 0.5F * upper(box); }

float half_area(const Aabb& box) {
  const Vec3 d = box.extent();
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

float blocks(std::size_t count) { return static_cast<float>((count + block_size - 1) / block_size); }

int bin_of(float centroid, float first, float scale) {
  const float bin = (centroid - first) * scale;
  return bin >= 0 && bin < bin_count ? static_cast<int>(bin) : bin >= bin_count ? bin_count - 1 : 0;
}

class Builder {
public:
  explicit Builder(Column<PrimitiveBox>& boxes) : boxes_(boxes) {}

  BinaryTree build() {
    if (boxes_.empty()) return {};
    add_node();
    Column<Task> tasks{Task{0, boxes_.size(), 0, 1}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.resize(tasks.size() - 1);
      expand(task, tasks);
    }
    tree_.order.resize(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i) tree_.order[i] = boxes_[i].id;
    return std::move(tree_);
  }

private:
  void add_node() {
    tree_.nodes.push_back({});
    tree_.group_of_leaf.push_back(0);
  }

  void expand(const Task& task, Column<Task>& tasks) {
    Aabb bounds, centroids;
    bool one_group = true;
    for (std::size_t i = task.begin; i < task.end; ++i) {
      bounds.extend(lower(boxes_[i]));
      bounds.extend(upper(boxes_[i]));
      centroids.extend(centroid(boxes_[i]));
      one_group &= boxes_[i].group == boxes_[task.begin].group;
    }
    const std::size_t count = task.end - task.begin;
    BinaryNode node{{bounds.lower.x, bounds.lower.y, bounds.lower.z},
                    static_cast<std::uint32_t>(task.begin),
                    {bounds.upper.x, bounds.upper.y, bounds.upper.z},
                    static_cast<std::uint32_t>(count)};
    std::size_t middle = task.begin;
    // Halving from here on just fits into the levels that are left.
    const bool must_halve = task.level + 1 + static_cast<int>(std::bit_width(count - 1)) > max_tree_depth;
    const bool may_be_leaf = one_group && count <= max_leaf_size;
    if (!(may_be_leaf && count <= block_size)) {
      const Split split = must_halve ? Split{} : best_split(task, centroids);
      const float area = half_area(bounds);
      const float split_cost = node_cost * area + split.cost;
      if (!may_be_leaf || split_cost < blocks(count) * area)
        middle = partition(task, split, centroids, !must_halve && count <= max_leaf_size && !one_group);
    }
    if (middle != task.begin) {
      node.first = static_cast<std::uint32_t>(tree_.nodes.size());
      node.count = 0;
      add_node();
      add_node();
      tasks.push_back({middle, task.end, node.first + 1, task.level + 1});
      tasks.push_back({task.begin, middle, node.first, task.level + 1});
    } else {
      tree_.group_of_leaf[task.node] = static_cast<std::uint8_t>(boxes_[task.begin].group);
    }
    tree_.nodes[task.node] = node;
  }

  Split best_split(const Task& task, const Aabb& centroids) const {
    Split best;
    const std::size_t count = task.end - task.begin;
    for (int axis = 0; axis < 3; ++axis) {
      const float scale = bin_count / (centroids.upper[axis] - centroids.lower[axis]);
      Bin bins[bin_count];
      for (std::size_t i = task.begin; i < task.end; ++i) {
        Bin& bin = bins[bin_of(centroid(boxes_[i])[axis], centroids.lower[axis], scale)];
        bin.bounds.extend(lower(boxes_[i]));
        bin.bounds.extend(upper(boxes_[i]));
        ++bin.count;
      }
      float right_area[bin_count];
      Aabb right;
      for (int i = bin_count - 1; i > 0; --i) {
        right.extend(bins[i].bounds);
        right_area[i] = right.empty() ? 0 : half_area(right);
      }
      Aabb left;
      std::size_t left_count = 0;
      for (int i = 1; i < bin_count; ++i) {
        left.extend(bins[i - 1].bounds);
        left_count += bins[i - 1].count;
        if (left_count == 0 || left_count == count) continue;
        const float cost = half_area(left) * blocks(left_count) + right_area[i] * blocks(count - left_count);
        if (cost < best.cost) best = {cost, axis, i};
      }
    }
    return best;
  }

  std::size_t partition(const Task& task, const Split& split, const Aabb& centroids, bool by_group) {
    PrimitiveBox* begin = boxes_.data() + task.begin;
    PrimitiveBox* end = boxes_.data() + task.end;
    PrimitiveBox* middle = begin + (end - begin) / 2;
    const int axis = split.axis;
    if (axis >= 0) {
      const float first = centroids.lower[axis];
      const float scale = bin_count / (centroids.upper[axis] - first);
      middle = std::partition(begin, end, [&](const PrimitiveBox& box) {
        return bin_of(centroid(box)[axis], first, scale) < split.position;
      });
    } else if (by_group) {
      const std::uint32_t group = begin->group;
      middle = std::partition(begin, end, [&](const PrimitiveBox& box) { return box.group == group; });
    }
    return static_cast<std::size_t>(middle - boxes_.data());
  }

  Column<PrimitiveBox>& boxes_;
  BinaryTree tree_;
};

} // namespace

BinaryTree build_binary_tree(Column<PrimitiveBox>& boxes, const BuildSettings&) {
  return Builder(boxes).build();
}

} // namespace fastrt
