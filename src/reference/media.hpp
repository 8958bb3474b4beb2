// SPDX-License-Identifier: Apache-2.0
// Which materials' insides a ray is in, and what that does to its light.
#pragma once

#include "src/reference/hit_finder.hpp"

#include <fastrt/camera.hpp>
#include <fastrt/material.hpp>
#include <fastrt/scene.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace fastrt::reference {

// The materials whose insides a ray is in, the innermost last.
class Media {
public:
  static constexpr int capacity = 4;

  bool empty() const noexcept { return count_ == 0; }
  std::uint32_t innermost() const noexcept { return materials_[static_cast<std::size_t>(count_) - 1]; }
  // As it is after a surface of this material has been crossed: without its most recent entry if the ray was
  // inside, otherwise with it as the innermost. A fifth pushes the outermost one out.
  Media crossed(std::uint32_t material) const noexcept;
  friend bool operator==(const Media& a, const Media& b) noexcept;

private:
  void erase(int index) noexcept;
  std::array<std::uint32_t, capacity> materials_{};
  int count_ = 0;
};

// The index of refraction around a ray; 1 outside of everything.
float ior_of(const std::vector<Material>& materials, const Media& media);

// What is left of light that went through the innermost of `media`. distance: in units of length.
Vec3 faded(const Vec3& light, const std::vector<Material>& materials, const Media& media, float distance);

// The media that contain a point.
Media media_around(const Scene& scene, const HitFinder& finder, const Vec3& point);

// The media that rays start in.
struct Surroundings {
  Media camera;
  std::vector<Media> lights; // as Scene::lights(); of lights with a size, what their middle is in
};
Surroundings surroundings_of(const Scene& scene, const HitFinder& finder, const CameraFrame& camera,
                             int width, int height);

} // namespace fastrt::reference
