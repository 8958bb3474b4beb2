// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/camera.hpp>
#include <fastrt/diagnostics.hpp>
#include <fastrt/scene.hpp>

#include <filesystem>
#include <functional>
#include <vector>

namespace fastrt {

// How scene files are read.
struct LoadOptions {
  int threads = 0;                   // as RenderSettings::threads
  bool strict = false;               // warnings become InputError
  bool allow_external_files = false; // files that a scene names, outside its folder
  bool tr_is_opacity = false;        // MTL: Tr 1 means opaque
  bool sidecar = true;               // load_scene: what find_sidecar finds is read too
  // Called by the thread that loads, with each file that the scene names, links resolved, before it is
  // opened; with some of them several times.
  std::function<void(const std::filesystem::path&)> on_file;
};

// Reads a Wavefront OBJ file and its MTL files. Lights, ambient and background are left at their defaults.
// Throws InputError (with file:line:column) for what can't be read and LimitError for what is too large; what
// can be tolerated goes to `diagnostics`.
SceneDesc load_obj(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics);

// Reads a PLY file, ascii or binary: triangles, polygons and triangle strips, with normals, texture
// coordinates, vertex colours and the texture that its header names. Throws as load_obj does; places in
// binary data are given in bytes.
SceneDesc load_ply(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics);

// Reads a file of the Neutral File Format: primitives, materials, lights, background, and the camera and size
// of the picture (SceneDesc::camera, width, height). Errors and warnings as load_obj's.
SceneDesc load_nff(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics);

// Reads a scene.toml, fastrt's own format (docs/scene-toml.md): all that a SceneDesc holds, the meshes,
// scenes and textures that it names included. Errors and warnings as load_obj's.
SceneDesc load_toml(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics);

// The file beside an OBJ file that completes it with camera, lights, materials and more: `house.toml` beside
// `house.obj`, else `scene.toml`. Empty if there is none, and for files of other formats.
std::filesystem::path find_sidecar(const std::filesystem::path& path);

// Reads by the name's extension (.obj, .nff, .ply, .toml), an OBJ file with its side-car. Throws UsageError
// for an extension that is not known.
SceneDesc load_scene(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics);

// The box around all primitives of a scene that is still being made; empty if it has none.
Aabb bounds_of(const SceneDesc& desc);

// A view of the scene that shows all of it: from a three-quarter angle above, turned so that `up` is up.
// aspect: width over height. An empty box gives the default camera. Throws InputError for a field of view
// outside (0, 180), an aspect that is not greater than 0, and an `up` of 0.
Camera frame_scene(const Aabb& bounds, float fov_degrees, float aspect, const Vec3& up = {0.0F, 1.0F, 0.0F});

// The view height with which an orthographic camera shows the whole box. Throws as camera_axes does, and for
// an aspect that is not greater than 0.
float orthographic_height(const Aabb& bounds, const Camera& camera, float aspect);

// Light for a scene that has none: a key light with shadows, a soft fill from the camera's side without, and
// where the scene does not say, ambient light and a dark grey background. Throws InputError for a degenerate
// camera.
void add_default_lights(SceneDesc& desc, const Aabb& bounds, const Camera& camera);

// The lights that a scene's own surfaces are: one of LightKind::mesh for each material of some triangle that
// emits more than `brighter_than` in some channel. Materials whose emission is a texture are left out, and
// triangles whose vertices the description does not hold.
std::vector<Light> emissive_lights(const SceneDesc& desc, float brighter_than = 0);

} // namespace fastrt
