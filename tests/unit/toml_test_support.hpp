// SPDX-License-Identifier: Apache-2.0
// What the tests of scene.toml share.
#pragma once

#include "tests/unit/obj_test_support.hpp"

#include <string>
#include <string_view>

namespace fastrt::test {

// Reads the text as `t.toml` of a folder of its own.
class TomlTexts {
public:
  Loaded read(std::string_view text, const LoadOptions& options = {}) {
    Loaded loaded;
    // A file that is written over may have to reach the disk first, which takes its time.
    std::filesystem::remove(folder_.path() / "t.toml");
    loaded.desc = load_toml(folder_.write("t.toml", text), options, loaded.diagnostics);
    return loaded;
  }
  SceneDesc desc(std::string_view text) { return read(text).desc; }
  // The message of the InputError that the text causes, without the folder; or "".
  std::string error(std::string_view text, const LoadOptions& options = {}) {
    try {
      read(text, options);
    } catch (const InputError& error) {
      return without_folder(error.what());
    }
    return {};
  }
  std::string without_folder(std::string message) const {
    const std::string folder = folder_.path().string() + '/';
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }
  const TemporaryFolder& folder() const { return folder_; }

private:
  TemporaryFolder folder_;
};

} // namespace fastrt::test
