// SPDX-License-Identifier: Apache-2.0
// The files that go beside the picture: AOVs and the scene signature.
#pragma once

#include "src/cli/options.hpp"

#include <fastrt/aov.hpp>

#include <filesystem>
#include <utility>
#include <vector>

namespace fastrt::cli {

struct ExtraFiles {
  bool layers_in_picture = false; // the picture is an EXR and holds the AOVs
  std::vector<std::pair<Aov, std::filesystem::path>> aovs;
  std::filesystem::path signature; // empty: none
};

// Where they go for a picture at `output` (empty: nowhere). Throws as check_image_path does, and UsageError
// where the picture has no name for others to go beside.
ExtraFiles choose_extra_files(const Options& options, const std::filesystem::path& output);

// The AOVs to render.
std::vector<Aov> aovs_to_render(const Options& options);

// Throws OutputError.
void save_extra_files(const ExtraFiles& files, const Frame& frame, int threads);

} // namespace fastrt::cli
