// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/reference/surface.hpp"

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
  bool holds(std::uint32_t material) const noexcept;
  // As it is after a surface of this material has been crossed: without its most recent entry if the ray was
  // inside, otherwise with it as the innermost. A fifth pushes the outermost one out.
  Media crossed(std::uint32_t material) const noexcept;

private:
  void erase(int index) noexcept;
  std::array<std::uint32_t, capacity> materials_{};
  int count_ = 0;
};

// The index of refraction around a ray; 1 outside of everything.
float ior_of(const std::vector<Material>& materials, const Media& media);

// The two rays that leave a surface: their directions and the share of the light that each brings. A weight
// of 0 means that there is none.
struct Secondary {
  Vec3 mirror{0.0F}, mirror_weight{0.0F};
  Vec3 transmitted{0.0F}, transmitted_weight{0.0F};
  Media transmitted_media;
};
Secondary secondary_rays(const Scene& scene, const Surface& surface, const Media& media);

} // namespace fastrt::reference
