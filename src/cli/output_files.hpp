// SPDX-License-Identifier: Apache-2.0
// The files that a run writes: the picture, and beside it AOVs and the scene signature.
#pragma once

#include "src/cli/options.hpp"

#include <fastrt/aov.hpp>

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fastrt::cli {

struct OutputFiles {
  std::filesystem::path picture;  // empty: none
  bool layers_in_picture = false; // the picture is an EXR and holds the AOVs
  std::vector<std::pair<Aov, std::filesystem::path>> aovs;
  std::filesystem::path signature; // empty: none
};

// Where they go, checked before the work is done. Throws as check_image_path and check_output_sizes do, and
// UsageError where the picture has no name for others to go beside, and where a file would go over the scene
// or over another one.
OutputFiles choose_output_files(const Options& options);

// Throws OutputError for a frame that a file's format can't hold. To be asked again when the picture's size
// is settled, which may be the scene's.
void check_output_sizes(const OutputFiles& files, const Options& options);

// Throws UsageError where a file would go over one that the scene is read from.
void refuse_scene_files(const OutputFiles& files, const std::set<std::filesystem::path>& scene_files);

// The AOVs to render.
std::vector<Aov> aovs_to_render(const Options& options);

// All but the picture. Throws OutputError.
void save_extra_files(const OutputFiles& files, const Frame& frame, int threads);

// objects: their names. Throws OutputError.
void save_picture(const OutputFiles& files, const Frame& frame, std::span<const std::string> objects,
                  int threads);

} // namespace fastrt::cli
