// SPDX-License-Identifier: Apache-2.0
#include "src/cli/extra_files.hpp"

#include "src/cli/save.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <span>
#include <string>
#include <system_error>

namespace fastrt::cli {
namespace {

namespace fs = std::filesystem;

// "dir/scene.png" and "normal" make "dir/scene-normal.png".
fs::path beside(const Options& options, const fs::path& output, const char* option, const char* name) {
  std::error_code error;
  const bool is_device = output.native().starts_with("/dev/") || fs::is_other(output, error);
  if (is_device)
    throw UsageError(std::string(option) + ": nothing can go beside '" + output.string() +
                     "'; give the picture a name of its own");
  fs::path stem = output.empty() ? fs::path(options.scene).stem() : output.parent_path() / output.stem();
  if (stem.empty()) stem = "scene";
  stem += std::string("-") + name + ".png";
  if (fs::equivalent(stem, options.scene, error))
    throw UsageError("the output '" + stem.string() + "' is the scene itself");
  check_image_path(stem);
  return stem;
}

void save_picture(const fs::path& path, std::span<const float> rgb, const Frame& frame, int threads) {
  save(path, encode_image(format_of(path), rgb, frame.width, frame.height, threads));
}

} // namespace

ExtraFiles choose_extra_files(const Options& options, const fs::path& output) {
  ExtraFiles files;
  files.layers_in_picture = !options.aovs.empty() && !output.empty() && format_of(output) == "exr";
  if (!files.layers_in_picture && !output.empty())
    for (const Aov aov : options.aovs)
      files.aovs.emplace_back(aov, beside(options, output, "--aov", aov_info(aov).name));
  if (!options.signature) return files;
  if (options.signature->empty()) {
    files.signature = beside(options, output, "--signature", "signature");
  } else {
    files.signature = *options.signature;
    std::error_code error;
    if (fs::equivalent(files.signature, options.scene, error) || files.signature == output)
      throw UsageError("--signature: '" + *options.signature + "' is the scene or the picture itself");
    check_image_path(files.signature);
  }
  return files;
}

std::vector<Aov> aovs_to_render(const Options& options) {
  std::vector<Aov> aovs = options.aovs;
  if (options.signature) aovs.push_back(Aov::id);
  return aovs;
}

void save_extra_files(const ExtraFiles& files, const Frame& frame, int threads) {
  for (const auto& [aov, path] : files.aovs)
    save_picture(path, aov_picture(*frame.find(aov)), frame, threads);
  if (!files.signature.empty())
    save_picture(files.signature, signature_picture(*frame.find(Aov::id)), frame, threads);
}

} // namespace fastrt::cli
