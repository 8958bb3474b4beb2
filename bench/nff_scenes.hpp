// SPDX-License-Identifier: Apache-2.0
// NFF scenes in the words of other renderers, so that all show the same view of the same things: POV-Ray
// reads no NFF, and what Tachyon makes of it is a wider view without polygons of many corners.
#pragma once

#include <filesystem>

namespace fastrt::bench {

// Spheres, cones and cylinders stay what they are; polygons become meshes of triangles, patches smooth ones.
// `depth` levels of rays. Throws InputError for what is not NFF, OutputError.
void write_povray_of_nff(const std::filesystem::path& nff, const std::filesystem::path& pov, int depth);

// The same, as a picture of size x size pixels. Cones become cylinders of their middle radius, and nothing
// bends rays: Tachyon knows neither. Its pictures are mirrored, which costs it nothing.
void write_tachyon_of_nff(const std::filesystem::path& nff, const std::filesystem::path& scene, int size,
                          int depth);

} // namespace fastrt::bench
