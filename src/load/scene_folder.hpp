// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/load.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace fastrt {

// The folder of a scene file, and what may be opened because the scene says so: regular files in it and
// below, symbolic links followed.
class SceneFolder {
public:
  SceneFolder(const std::filesystem::path& scene_file, const LoadOptions& options);

  enum class Finding { regular, missing, outside, special };
  struct Answer {
    Finding finding;
    std::filesystem::path path; // without links; of regular files
  };
  // `name` as a scene writes it, relative to `folder`; `\` separates too. Opens nothing. Tells
  // LoadOptions::on_file of regular files.
  Answer find(std::string_view name, const std::filesystem::path& folder) const;
  const std::filesystem::path& root() const noexcept { return root_; }

private:
  bool holds(const std::filesystem::path& path) const;

  std::filesystem::path root_;
  bool allow_external_;
  std::function<void(const std::filesystem::path&)> on_file_;
};

// What messages say of Finding::outside.
inline constexpr const char* lies_outside =
    " lies outside the scene directory, and external files are not allowed";

// `\` to `/`.
std::string with_slashes(std::string_view name);

} // namespace fastrt
