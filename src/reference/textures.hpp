// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/reference/surface.hpp"

#include <fastrt/scene.hpp>

namespace fastrt::reference {

// Whether a material's terms vary over its surface.
bool has_textures(const Material& material);

// Fills in the surface's finish and turns its shading normal as its material's textures say.
void apply_textures(const Scene& scene, const Hit& hit, Surface& surface);

// The opacity where a shadow ray meets something: looked up in full detail.
float opacity_at(const Scene& scene, const Ray& ray, const Hit& hit);

} // namespace fastrt::reference
