// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/accel/tree.hpp"
#include "src/reference/hit_finder.hpp"

#include <fastrt/scene.hpp>
#include <fastrt/tracer.hpp>

#include <vector>

namespace fastrt {

// The reference's primitive tests over a binary tree, and over one more for each prototype, one ray at a
// time: the same hits as its brute force, bit for bit, in less time. Serves `--isa scalar`. The scene must
// outlive it.
class ScalarBvh final : public reference::HitFinder {
public:
  explicit ScalarBvh(const Scene& scene, const BuildSettings& settings = {});

  reference::Hit closest(const reference::Ray& ray) const override;
  bool any(const reference::Ray& ray) const override;

  const BinaryTree& tree() const noexcept { return world_.binary; } // not a prototype's
  BvhStats stats() const;                                           // of all trees; build_seconds is 0

private:
  struct Tree {
    BinaryTree binary;
    float largest_coordinate; // of its bounds, as a magnitude
  };
  static Tree make_tree(Column<PrimitiveBox> boxes, BuildSettings settings);

  template <bool any_will_do>
  reference::Hit trace(const reference::Ray& ray) const;
  template <bool any_will_do>
  void traverse(const Tree& tree, const reference::Ray& ray, reference::Hit& best) const;
  // A primitive, or an instance by its number after all primitives.
  template <bool any_will_do>
  void meet(std::uint32_t id, const reference::Ray& ray, reference::Hit& best) const;

  const Scene* scene_;
  Tree world_;
  std::vector<Tree> prototypes_;
};

} // namespace fastrt
