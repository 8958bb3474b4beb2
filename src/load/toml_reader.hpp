// SPDX-License-Identifier: Apache-2.0
// scene.toml: the scene format of fastrt (docs/scene-toml.md).
#pragma once

#include <fastrt/load.hpp>

#include <filesystem>

namespace fastrt {

// Adds what the file says to `desc`: an empty scene, or, for a side-car, that of the file `base`, whose
// materials it may change. Throws as load_toml does.
void read_toml(const std::filesystem::path& path, const LoadOptions& options, Diagnostics& diagnostics,
               SceneDesc& desc, const std::filesystem::path& base = {});

} // namespace fastrt
