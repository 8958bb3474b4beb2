// SPDX-License-Identifier: Apache-2.0
#include "src/load/material_files.hpp"
#include "src/load/nff_reader.hpp"
#include "src/load/obj_reader.hpp"
#include "src/load/ply_reader.hpp"
#include "src/load/scene_folder.hpp"
#include "src/load/text.hpp"
#include "src/load/texture_file.hpp"
#include "src/load/toml_reader.hpp"
#include "src/scene/threads.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>

#include <system_error>

namespace fastrt {

SceneDesc load_obj(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics) {
  const Source source = Source::open(path);
  MaterialFiles files(path, options);
  ObjReaderSettings settings;
  settings.threads = thread_count(options.threads);
  place_threads(settings.threads);
  settings.strict = options.strict;
  settings.object_name = path.stem().string();
  settings.read_library = [&files](const std::string& names, std::uint64_t offset, MaterialSet& materials,
                                   EventLog& log) { files.read(names, offset, materials, log); };
  return read_obj(source, settings, diagnostics);
}

SceneDesc load_nff(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics) {
  return read_nff(Source::open(path), options.strict, diagnostics);
}

SceneDesc load_ply(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics) {
  const Source source = Source::open(path);
  PlyReaderSettings settings;
  settings.strict = options.strict;
  settings.object_name = path.stem().string();
  const SceneFolder folder(path, options);
  settings.read_texture = [&folder](const std::string& name) {
    const SceneFolder::Answer answer = folder.find(name, folder.root());
    const bool found = answer.finding == SceneFolder::Finding::regular;
    return found ? read_texture(answer.path, TextureCode::color)
                 : TextureFile{nullptr, texture_fault(answer.finding)};
  };
  SceneDesc desc = read_ply(source, settings, diagnostics);
  source.check_unchanged();
  return desc;
}

SceneDesc load_toml(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics) {
  SceneDesc desc;
  read_toml(path, options, diagnostics, desc);
  return desc;
}

std::filesystem::path find_sidecar(const std::filesystem::path& path) {
  if (lower_case(path.extension().string()) != ".obj") return {};
  std::error_code error;
  for (const std::filesystem::path& candidate :
       {std::filesystem::path(path).replace_extension(".toml"), path.parent_path() / "scene.toml"})
    if (std::filesystem::is_regular_file(candidate, error)) return candidate;
  return {};
}

SceneDesc load_scene(const std::filesystem::path& path, const LoadOptions& options,
                     Diagnostics& diagnostics) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".obj") {
    SceneDesc desc = load_obj(path, options, diagnostics);
    const std::filesystem::path sidecar = options.sidecar ? find_sidecar(path) : std::filesystem::path();
    if (!sidecar.empty()) read_toml(sidecar, options, diagnostics, desc, path);
    return desc;
  }
  if (extension == ".toml") return load_toml(path, options, diagnostics);
  if (extension == ".ply") return load_ply(path, options, diagnostics);
  if (extension == ".nff") return load_nff(path, options, diagnostics);
  throw UsageError("cannot tell the format of " + in_quotes(path.string()) +
                   " by its name; known: .obj .nff .ply .toml");
}

} // namespace fastrt
