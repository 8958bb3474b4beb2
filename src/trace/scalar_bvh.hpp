// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/accel/tree.hpp"
#include "src/reference/hit_finder.hpp"

#include <fastrt/scene.hpp>

namespace fastrt {

// The reference's primitive tests over a binary tree, one ray at a time: the same hits as its brute force,
// bit for bit, in less time. Serves `--isa scalar`. The scene must outlive it.
class ScalarBvh final : public reference::HitFinder {
public:
  // threads: for the build; 0 takes every core.
  explicit ScalarBvh(const Scene& scene, int threads = 0);

  reference::Hit closest(const reference::Ray& ray) const override;
  bool any(const reference::Ray& ray) const override;

  const BinaryTree& tree() const noexcept { return tree_; }

private:
  template <bool any_will_do>
  reference::Hit trace(const reference::Ray& ray) const;
  template <bool any_will_do>
  void traverse(const reference::Ray& ray, reference::Hit& best) const;
  template <bool any_will_do>
  bool test_leaf(const BinaryNode& leaf, const reference::Ray& ray, reference::Hit& best) const;

  const Scene* scene_;
  BinaryTree tree_;
  float largest_coordinate_ = 0; // of the scene's bounds, as a magnitude
};

// The box of every primitive that has one, planes not, as the tree's builder wants them, with the groups of
// scene_view.hpp.
Column<PrimitiveBox> primitive_boxes(const Scene& scene);

} // namespace fastrt
