// SPDX-License-Identifier: Apache-2.0
#include "src/trace/scalar_bvh.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/instances.hpp"
#include "src/trace/primitive_boxes.hpp"
#include "src/trace/scene_trees.hpp"

#include <array>
#include <utility>

namespace fastrt {
namespace {

using reference::Hit;
using reference::Ray;

// A ray as the boxes see it. Every plane is met a little early or late: by a margin for the rounding of the
// coordinates, which grows with the largest number in play, and by Ize's factor for that of the distances
// (JCGT 2(2), 2013). So a box never culls a hit that the primitive in it reports.
class SlabRay {
public:
  SlabRay(const Ray& ray, float largest_coordinate) : t_min_(ray.t_min) {
    const float margin =
        0x1p-19F * reference::max(reference::largest_magnitude(ray.origin), largest_coordinate);
    for (int axis = 0; axis < 3; ++axis) {
      Axis& slab = axes_[static_cast<std::size_t>(axis)];
      // By the sign bit: -0 has the inverse -infinity.
      slab.backwards = std::signbit(ray.direction[axis]);
      slab.inverse = 1.0F / ray.direction[axis];
      const float ahead = slab.backwards ? -margin : margin;
      slab.origin_near = ray.origin[axis] + ahead;
      slab.origin_far = ray.origin[axis] - ahead;
    }
  }

  // Where the ray enters the box, or infinity if it does not before t_max.
  float entry(const BinaryNode& node, float t_max) const {
    float near = t_min_;
    float far = t_max;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Axis& slab = axes_[axis];
      const float near_plane = slab.backwards ? node.upper[axis] : node.lower[axis];
      const float far_plane = slab.backwards ? node.lower[axis] : node.upper[axis];
      // The running bound goes second: it stays where the slab gives NaN (0 * infinity).
      near = reference::max((near_plane - slab.origin_near) * slab.inverse, near);
      far = reference::min(((far_plane - slab.origin_far) * slab.inverse) * 1.00000036F, far);
    }
    return near > far ? infinity : near;
  }

private:
  struct Axis {
    float inverse, origin_near, origin_far;
    bool backwards;
  };
  std::array<Axis, 3> axes_;
  float t_min_;
};

struct Pending {
  std::uint32_t node;
  float entry;
};

Aabb bounds_of(const BinaryTree& tree) {
  if (tree.nodes.empty()) return {};
  const BinaryNode& root = tree.nodes[0];
  return {{root.lower[0], root.lower[1], root.lower[2]}, {root.upper[0], root.upper[1], root.upper[2]}};
}

TreeStats stats_of(const BinaryTree& tree) {
  return {sah_cost(tree), tree.nodes.size(), leaf_count(tree), tree_depth(tree)};
}

std::size_t bytes_of(const BinaryTree& tree) {
  return tree.nodes.bytes() + tree.order.bytes() + tree.group_of_leaf.bytes();
}

} // namespace

ScalarBvh::Tree ScalarBvh::make_tree(Column<PrimitiveBox> boxes, BuildSettings settings) {
  if (boxes.size() < parallel_build_from) settings.threads = 1;
  Tree tree{build_binary_tree(boxes, settings), 0};
  tree.largest_coordinate = largest_magnitude(bounds_of(tree.binary));
  return tree;
}

ScalarBvh::ScalarBvh(const Scene& scene, const BuildSettings& settings)
    : scene_(&scene), world_(make_tree(world_boxes(scene), settings)) {
  for (const Prototype& prototype : scene.desc().prototypes)
    prototypes_.push_back(make_tree(prototype_boxes(scene, prototype), settings));
}

BvhStats ScalarBvh::stats() const {
  std::vector<TreeStats> prototypes;
  std::size_t bytes = bytes_of(world_.binary);
  for (const Tree& tree : prototypes_) {
    prototypes.push_back(stats_of(tree.binary));
    bytes += bytes_of(tree.binary);
  }
  BvhStats stats = stats_of(*scene_, stats_of(world_.binary), prototypes, bounds_of(world_.binary));
  stats.bytes = bytes;
  return stats;
}

template <bool any_will_do>
void ScalarBvh::meet(std::uint32_t id, const Ray& ray, Hit& best) const {
  if (id >= scene_->primitive_count()) {
    const std::uint32_t instance = id - scene_->primitive_count();
    const Tree& tree = prototypes_[scene_->desc().instances.prototype[instance]];
    reference::meet_instance(*scene_, ray, instance, best, [&](const Ray& inner) {
      Hit hit{inner.t_max, 0, 0, no_primitive};
      traverse<any_will_do>(tree, inner, hit);
      return hit;
    });
    return;
  }
  if (static_cast<std::int32_t>(id) == ray.excluded && ray.excluded_instance == no_instance) return;
  reference::keep_closest(best, reference::intersect(ray, *scene_, id), id);
}

template <bool any_will_do>
void ScalarBvh::traverse(const Tree& tree, const Ray& ray, Hit& best) const {
  const Column<BinaryNode>& nodes = tree.binary.nodes;
  if (nodes.empty()) return;
  const SlabRay slabs(ray, tree.largest_coordinate);
  std::array<Pending, max_tree_depth + 2> stack;
  std::size_t pending = 0;
  stack[pending++] = {0, slabs.entry(nodes[0], best.t)};
  while (pending != 0) {
    Pending next = stack[--pending];
    // Not at >=: a primitive at the same t may have a smaller id.
    while (!(next.entry > best.t)) {
      const BinaryNode& node = nodes[next.node];
      if (node.count != 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          meet<any_will_do>(tree.binary.order[i], ray, best);
          if (any_will_do && best.found()) return;
        }
        break;
      }
      Pending farther{node.first, slabs.entry(nodes[node.first], best.t)};
      next = {node.first + 1, slabs.entry(nodes[node.first + 1], best.t)};
      if (farther.entry < next.entry) std::swap(next, farther);
      if (farther.entry < infinity) stack[pending++] = farther;
      if (!(next.entry < infinity)) break;
    }
  }
}

// Planes have no box: every ray meets them all.
template <bool any_will_do>
Hit ScalarBvh::trace(const Ray& ray) const {
  Hit best{ray.t_max, 0, 0, no_primitive};
  traverse<any_will_do>(world_, ray, best);
  for (std::uint32_t id = scene_->first_of(PrimitiveKind::plane); id < scene_->primitive_count(); ++id) {
    if (any_will_do && best.found()) break;
    meet<any_will_do>(id, ray, best);
  }
  return best;
}

Hit ScalarBvh::closest(const Ray& ray) const { return trace<false>(ray); }
bool ScalarBvh::any(const Ray& ray) const { return trace<true>(ray).found(); }

} // namespace fastrt
