// SPDX-License-Identifier: Apache-2.0
#include "src/scene/printable.hpp"
#include "src/write/formats.hpp"
#include "src/write/output_file.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <algorithm>

namespace fastrt {

namespace {

// The format that the name asks for. A device or pipe without an extension (/dev/null, /dev/stdout) gets PNG.
std::string format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return "png"; // refused when it is opened, for what it is
  const bool is_other = std::filesystem::is_other(path, ignored) || path.native().starts_with("/dev/std") ||
                        path.native().starts_with("/dev/fd/");
  if (extension.empty() && is_other) return "png";
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::vector<std::string> known = image_extensions();
  if (std::find(known.begin(), known.end(), extension) != known.end()) return extension;
  std::string list;
  for (const std::string& name : known) list += " ." + name;
  throw UsageError("'" + printable(path.string()) +
                   "' is no image name that is known; write one that ends in one of" + list);
}

} // namespace

void check_image_path(const std::filesystem::path& path) {
  require_module(format_of(path));
  check_writable(path);
}

void write_image(const std::filesystem::path& path, std::span<const float> rgb, int width, int height,
                 int threads) {
  const std::vector<unsigned char> bytes = encode_image(format_of(path), rgb, width, height, threads);
  replace_file(path, bytes.data(), bytes.size());
}

} // namespace fastrt
