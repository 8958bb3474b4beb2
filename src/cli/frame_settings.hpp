// SPDX-License-Identifier: Apache-2.0
// What rendering is asked for.
#pragma once

#include "src/cli/options.hpp"

#include <fastrt/isa.hpp>
#include <fastrt/render.hpp>

#include <filesystem>

namespace fastrt::cli {

// Throws LimitError for a frame that takes more memory than --max-image-mb. picture: where it goes, or empty.
void check_image_size(const Options& options, const std::filesystem::path& picture, Isa isa);

// options: after take_picture_settings.
RenderSettings render_settings(const Options& options, const std::filesystem::path& picture, Isa isa,
                               int threads);

} // namespace fastrt::cli
