// SPDX-License-Identifier: Apache-2.0
#include "src/trace/scalar_bvh.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/intersect.hpp"
#include "src/trace/scene_view.hpp"

#include <array>
#include <utility>

namespace fastrt {
namespace {

using reference::Hit;
using reference::Ray;

PrimitiveBox box_of(const Aabb& bounds, std::uint32_t id, std::uint32_t group) {
  return {{bounds.lower.x, bounds.lower.y, bounds.lower.z},
          id,
          {bounds.upper.x, bounds.upper.y, bounds.upper.z},
          group};
}

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

} // namespace

Column<PrimitiveBox> primitive_boxes(const Scene& scene) {
  Column<PrimitiveBox> boxes(scene.first_of(PrimitiveKind::plane));
  for (std::uint32_t id = 0; id < scene.triangle_count(); ++id) {
    const auto [a, b, c] = reference::triangle_vertices(scene, id);
    Aabb bounds;
    bounds.extend(a);
    bounds.extend(b);
    bounds.extend(c);
    boxes[id] = box_of(bounds, id, triangle_group);
  }
  for (std::uint32_t i = 0; i < scene.sphere_count(); ++i) {
    const auto [center, radius] = reference::sphere_shape(scene, i);
    // Two ulps more than the radius, so that no rounding leaves the rim outside.
    const Vec3 reach{radius + 0x1p-22F * (radius + reference::largest_magnitude(center))};
    const std::uint32_t id = scene.triangle_count() + i;
    boxes[id] = box_of({center - reach, center + reach}, id, sphere_group);
  }
  std::uint32_t id = scene.first_of(PrimitiveKind::cone);
  const auto add_boxes = [&](const auto& shapes) {
    for (const auto& shape : shapes) {
      boxes[id] = box_of(shape.box, id, shape_group);
      ++id;
    }
  };
  add_boxes(scene.shapes().cones);
  add_boxes(scene.shapes().disks);
  add_boxes(scene.shapes().polygons);
  return boxes;
}

ScalarBvh::ScalarBvh(const Scene& scene, int threads) : scene_(&scene) {
  Column<PrimitiveBox> boxes = primitive_boxes(scene);
  tree_ = build_binary_tree(boxes, {threads});
  if (!tree_.nodes.empty()) {
    for (int axis = 0; axis < 3; ++axis) {
      const BinaryNode& root = tree_.nodes[0];
      largest_coordinate_ = reference::max(std::fabs(root.lower[axis]),
                                           reference::max(std::fabs(root.upper[axis]), largest_coordinate_));
    }
  }
}

template <bool any_will_do>
bool ScalarBvh::test_leaf(const BinaryNode& leaf, const Ray& ray, Hit& best) const {
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const std::uint32_t id = tree_.order[i];
    if (static_cast<std::int32_t>(id) == ray.excluded) continue;
    reference::keep_closest(best, reference::intersect(ray, *scene_, id), id);
    if (any_will_do && best.found()) return true;
  }
  return false;
}

template <bool any_will_do>
void ScalarBvh::traverse(const Ray& ray, Hit& best) const {
  if (tree_.nodes.empty()) return;
  const SlabRay slabs(ray, largest_coordinate_);
  std::array<Pending, max_tree_depth + 2> stack;
  std::size_t pending = 0;
  stack[pending++] = {0, slabs.entry(tree_.nodes[0], best.t)};
  while (pending != 0) {
    Pending next = stack[--pending];
    // Not at >=: a primitive at the same t may have a smaller id.
    while (!(next.entry > best.t)) {
      const BinaryNode& node = tree_.nodes[next.node];
      if (node.count != 0) {
        if (test_leaf<any_will_do>(node, ray, best)) return;
        break;
      }
      Pending farther{node.first, slabs.entry(tree_.nodes[node.first], best.t)};
      next = {node.first + 1, slabs.entry(tree_.nodes[node.first + 1], best.t)};
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
  traverse<any_will_do>(ray, best);
  for (std::uint32_t id = scene_->first_of(PrimitiveKind::plane); id < scene_->primitive_count(); ++id) {
    if (any_will_do && best.found()) break;
    if (static_cast<std::int32_t>(id) == ray.excluded) continue;
    reference::keep_closest(best, reference::intersect(ray, *scene_, id), id);
  }
  return best;
}

Hit ScalarBvh::closest(const Ray& ray) const { return trace<false>(ray); }
bool ScalarBvh::any(const Ray& ray) const { return trace<true>(ray).found(); }

} // namespace fastrt
