// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/reference/media.hpp"
#include "src/reference/surface.hpp"

#include <fastrt/scene.hpp>

namespace fastrt::reference {

// The two rays that leave a surface: their directions and the share of the light that each brings. A weight
// of 0 means that there is none.
struct Secondary {
  Vec3 mirror{0.0F}, mirror_weight{0.0F};
  Vec3 transmitted{0.0F}, transmitted_weight{0.0F};
  Media transmitted_media;
};
Secondary secondary_rays(const Scene& scene, const Surface& surface, const Media& media);

} // namespace fastrt::reference
