// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/reference/ray.hpp"

#include <fastrt/scene.hpp>

namespace fastrt::reference {

// Answers "what does this ray hit first?", so that the same shading runs over a plain loop and over a tree.
// Const calls may come from several threads at once.
class HitFinder {
public:
  HitFinder() = default;
  HitFinder(const HitFinder&) = delete;
  HitFinder& operator=(const HitFinder&) = delete;
  virtual ~HitFinder() = default;

  // The hit with the smallest t; at equal t the smallest primitive id, and that of an instance after all
  // others.
  virtual Hit closest(const Ray& ray) const = 0;
  // Whether there is any hit at all.
  virtual bool any(const Ray& ray) const { return closest(ray).found(); }
};

// The lecture's findFirstHit: a loop over all objects in the scene, and over all that an instance shows. The
// scene must outlive it.
class BruteForce final : public HitFinder {
public:
  explicit BruteForce(const Scene& scene) : scene_(&scene) {}
  Hit closest(const Ray& ray) const override;
  bool any(const Ray& ray) const override;

private:
  template <bool any_will_do>
  void meet(const Ray& ray, std::uint32_t begin, std::uint32_t end, Hit& best) const;
  template <bool any_will_do>
  Hit meet_prototype(const Ray& ray, const Prototype& prototype) const;
  template <bool any_will_do>
  Hit meet_all(const Ray& ray) const;

  const Scene* scene_;
};

} // namespace fastrt::reference
