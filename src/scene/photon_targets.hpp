// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/scene.hpp>

#include <vector>

namespace fastrt {

// What photons are sent to: balls around it, or everything because some of it has no bounds.
struct PhotonTargets {
  struct Ball {
    glm::dvec3 center;
    double radius;
  };
  std::vector<Ball> balls;
  bool everywhere = false;
};

// The ball around a box that is not empty, and one around all targets, of which there are some.
PhotonTargets::Ball ball_around(const Aabb& box);
PhotonTargets::Ball ball_around(const PhotonTargets& targets);

PhotonTargets whole_scene(const Scene& scene);

// Where caustics are looked for: the box of what has bounds, and four times its longest side around it.
// Planes go on for ever, and light that leaves it almost level would meet them anywhere.
Aabb caustic_reach(const Scene& scene);

// Whatever reflects light or bends it, object by object and instance by instance.
PhotonTargets specular_objects(const Scene& scene);

} // namespace fastrt
