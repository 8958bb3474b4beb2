// SPDX-License-Identifier: Apache-2.0
// What the tests of the OBJ and MTL readers share.
#pragma once

#include "src/load/obj_reader.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt::test {

struct Loaded {
  SceneDesc desc;
  Diagnostics diagnostics;
  std::vector<std::string> warnings() const { return diagnostics.lines(); }
};

inline ObjReaderSettings settings_for_tests() {
  ObjReaderSettings settings;
  settings.object_name = "stem";
  return settings;
}

inline Loaded parse(std::string_view text, const ObjReaderSettings& settings = settings_for_tests()) {
  Loaded loaded;
  loaded.desc = read_obj(Source::memory(text, "t.obj"), settings, loaded.diagnostics);
  return loaded;
}

// The message of the InputError that the text causes, or "".
inline std::string error_of(std::string_view text, const ObjReaderSettings& settings = settings_for_tests()) {
  try {
    parse(text, settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in '" << text << "'";
}

inline bool same_columns(const SceneDesc& a, const SceneDesc& b) {
  const TriangleColumns &s = a.triangles, &t = b.triangles;
  return a.positions.x == b.positions.x && a.positions.y == b.positions.y && a.positions.z == b.positions.z &&
         a.normals.x == b.normals.x && a.normals.y == b.normals.y && a.normals.z == b.normals.z &&
         a.uvs.x == b.uvs.x && a.uvs.y == b.uvs.y && a.colors.x == b.colors.x && a.colors.y == b.colors.y &&
         a.colors.z == b.colors.z && s.v0 == t.v0 && s.v1 == t.v1 && s.v2 == t.v2 && s.n0 == t.n0 &&
         s.n1 == t.n1 && s.n2 == t.n2 && s.t0 == t.t0 && s.t1 == t.t1 && s.t2 == t.t2 &&
         s.material == t.material && s.object == t.object && a.object_names == b.object_names &&
         a.materials.size() == b.materials.size();
}

// Every index of a scene in its range, and columns of the lengths that belong together.
inline bool is_sound(const SceneDesc& desc) {
  const TriangleColumns& rows = desc.triangles;
  const auto within = [&](const Column<std::uint32_t>& column, std::size_t count, bool optional) {
    if (column.size() != rows.size() && !(optional && column.empty())) return false;
    for (const std::uint32_t index : column)
      if (index >= count && !(optional && index == no_index)) return false;
    return true;
  };
  bool sound = within(rows.material, desc.materials.size(), false) && !desc.materials.empty();
  sound = sound && within(rows.object, desc.object_names.size(), false);
  for (const auto* column : {&rows.v0, &rows.v1, &rows.v2})
    sound = sound && within(*column, desc.positions.size(), false);
  for (const auto* column : {&rows.n0, &rows.n1, &rows.n2})
    sound = sound && within(*column, desc.normals.size(), true);
  for (const auto* column : {&rows.t0, &rows.t1, &rows.t2})
    sound = sound && within(*column, desc.uvs.size(), true);
  return sound;
}

// A folder of its own for files, gone at the end.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "fastrt_test_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, std::string_view text) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

private:
  std::filesystem::path path_;
};

inline Loaded load(const std::filesystem::path& path, const LoadOptions& options = {}) {
  Loaded loaded;
  loaded.desc = load_obj(path, options, loaded.diagnostics);
  return loaded;
}

inline std::string load_error(const std::filesystem::path& path, const LoadOptions& options = {}) {
  try {
    load(path, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

} // namespace fastrt::test
