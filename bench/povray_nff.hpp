// SPDX-License-Identifier: Apache-2.0
// NFF scenes (Haines' Standard Procedural Databases) in POV-Ray's words, which reads no NFF.
#pragma once

#include <filesystem>

namespace fastrt::bench {

// Spheres, cones and cylinders stay what they are; polygons become meshes of triangles, patches smooth ones.
// `depth` levels of rays. Throws InputError for what is not NFF, OutputError.
void write_povray_of_nff(const std::filesystem::path& nff, const std::filesystem::path& pov, int depth);

} // namespace fastrt::bench
