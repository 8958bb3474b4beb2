// SPDX-License-Identifier: Apache-2.0
// What options say for nothing, now that the scene's values are known.
#pragma once

#include "src/cli/options.hpp"

#include <fastrt/scene.hpp>

#include <string>
#include <vector>

namespace fastrt::cli {

// options: after take_picture_settings.
std::vector<std::string> sampling_warnings(const Options& options);

// camera: of choose_camera.
std::vector<std::string> camera_warnings(const Options& options, const Camera& camera);

// Of --caustics where nothing makes them.
std::vector<std::string> caustic_warnings(const Options& options, const Scene& scene);

} // namespace fastrt::cli
