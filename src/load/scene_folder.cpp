// SPDX-License-Identifier: Apache-2.0
#include "src/load/scene_folder.hpp"

#include <algorithm>
#include <system_error>

namespace fastrt {

namespace fs = std::filesystem;

std::string with_slashes(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

SceneFolder::SceneFolder(const fs::path& scene_file, const LoadOptions& options)
    : allow_external_(options.allow_external_files), on_file_(options.on_file) {
  const fs::path parent = scene_file.has_parent_path() ? scene_file.parent_path() : fs::path(".");
  std::error_code error;
  root_ = fs::canonical(parent, error);
  if (error) root_ = parent;
}

bool SceneFolder::holds(const fs::path& path) const {
  return std::mismatch(root_.begin(), root_.end(), path.begin(), path.end()).first == root_.end();
}

SceneFolder::Answer SceneFolder::find(std::string_view name, const fs::path& folder) const {
  const fs::path wanted = (folder / with_slashes(name)).lexically_normal();
  // What lies outside by its name is not even looked for: the answer would say whether it exists.
  if (!allow_external_ && !holds(wanted)) return {Finding::outside, {}};
  std::error_code error;
  fs::path real = fs::canonical(wanted, error);
  if (error) return {Finding::missing, {}};
  if (!allow_external_ && !holds(real)) return {Finding::outside, {}};
  if (!fs::is_regular_file(real, error)) return {Finding::special, {}};
  if (on_file_) on_file_(real);
  return {Finding::regular, std::move(real)};
}

} // namespace fastrt
