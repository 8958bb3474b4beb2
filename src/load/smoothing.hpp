// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/scene.hpp>

namespace fastrt {

// Gives normals to the triangles that have none and whose smoothing group is not 0: at each position the mean
// of the faces of one group that meet there, weighted by their angles. groups: one per triangle.
void smooth_normals(SceneDesc& desc, const Column<std::uint32_t>& groups, int threads);

} // namespace fastrt
