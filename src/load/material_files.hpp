// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/event_log.hpp"
#include "src/load/material_set.hpp"
#include "src/load/scene_folder.hpp"

#include <fastrt/load.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace fastrt {

// Reads the material files that an OBJ file names, each once.
class MaterialFiles {
public:
  static constexpr std::size_t most_files = 1024;

  MaterialFiles(const std::filesystem::path& scene_file, const LoadOptions& options);
  // names: the rest of an mtllib line, at `offset` of the OBJ file: one name with blanks, or several.
  void read(const std::string& names, std::uint64_t offset, MaterialSet& materials, EventLog& log);

private:
  // False if there is no such file and `names` may be several.
  bool read_one(std::string_view name, bool may_be_several, std::uint64_t offset, MaterialSet& materials,
                EventLog& log);
  void parse(const std::filesystem::path& path, const std::string& shown, std::uint64_t offset,
             MaterialSet& materials, EventLog& log);

  std::filesystem::path shown_folder_; // as the user wrote it
  LoadOptions options_;
  SceneFolder folder_;
  std::set<std::filesystem::path> read_;
};

} // namespace fastrt
