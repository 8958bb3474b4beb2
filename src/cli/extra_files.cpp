// SPDX-License-Identifier: Apache-2.0
#include "src/cli/extra_files.hpp"

#include "src/cli/save.hpp"
#include "src/film/srgb.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <algorithm>
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

std::vector<float> linear(std::span<const unsigned char> codes) {
  std::vector<float> rgb(codes.size());
  std::transform(codes.begin(), codes.end(), rgb.begin(), linear_of_srgb8);
  return rgb;
}

void save_picture(const fs::path& path, std::span<const unsigned char> codes, const Frame& frame,
                  int threads) {
  const std::string format = format_of(path);
  save(path, is_8bit_format(format)
                 ? encode_image(format, codes, frame.width, frame.height, threads)
                 : encode_image(format, linear(codes), frame.width, frame.height, threads));
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
    save_picture(path, aov_picture(*frame.find(aov), threads), frame, threads);
  if (!files.signature.empty())
    save_picture(files.signature, signature_picture(*frame.find(Aov::id), threads), frame, threads);
}

} // namespace fastrt::cli
