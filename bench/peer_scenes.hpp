// SPDX-License-Identifier: Apache-2.0
// The same triangles, camera and one light in the words of other renderers. Plain grey surfaces, one sample
// per pixel, shadows.
#pragma once

#include <fastrt/camera.hpp>
#include <fastrt/scene.hpp>

#include <filesystem>

namespace fastrt::bench {

struct Picture {
  const SceneDesc& scene;
  Camera camera;     // its field of view is the same both ways: pictures are square
  Vec3 light_travel; // of the directional light
  int size;          // pixels a side
};

// Throw OutputError.
void write_povray(const Picture& picture, const std::filesystem::path& path);
void write_tachyon(const Picture& picture, const std::filesystem::path& path);
// For those who read OBJ files: no materials, normals or groups, of which some readers lose triangles.
void write_plain_obj(const SceneDesc& scene, const std::filesystem::path& path);

} // namespace fastrt::bench
