// SPDX-License-Identifier: Apache-2.0
#include "src/cli/output_files.hpp"

#include "src/cli/save.hpp"
#include "src/cli/streams.hpp"
#include "src/film/srgb.hpp"
#include "src/write/output_file.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>
#include <fastrt/write.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <system_error>

namespace fastrt::cli {
namespace {

namespace fs = std::filesystem;

// Throws UsageError if they are one file.
void refuse_part(const fs::path& output, const fs::path& part) {
  std::error_code error;
  if (fs::equivalent(output, part, error))
    throw UsageError("the output '" + output.string() + "' is '" + part.string() +
                     "', which is read as a part of the scene");
}

// Throws UsageError for what is read; what the scene's text names, such as textures, is not known yet.
void refuse_inputs(const Options& options, const fs::path& path) {
  std::error_code error;
  const fs::path sidecar = options.sidecar ? find_sidecar(options.scene) : fs::path();
  if (fs::equivalent(path, options.scene, error))
    throw UsageError("the output '" + path.string() + "' is the scene itself");
  if (!sidecar.empty()) refuse_part(path, sidecar);
}

// "dir/scene.png" and "normal" make "dir/scene-normal.png".
fs::path beside(const Options& options, const fs::path& output, const char* option, const char* name) {
  std::error_code error;
  const bool is_device = output.native().starts_with("/dev/") || fs::is_other(output, error);
  if (is_device)
    throw UsageError(std::string(option) + ": nothing can go beside " +
                     (options.output == "-" ? "standard output" : "'" + output.string() + "'") +
                     "; give the picture a name of its own");
  fs::path stem = output.empty() ? fs::path(options.scene).stem() : output.parent_path() / output.stem();
  if (stem.empty()) stem = "scene";
  stem += std::string("-") + name + ".png";
  refuse_inputs(options, stem);
  check_image_path(stem);
  return stem;
}

std::vector<float> linear(std::span<const unsigned char> codes) {
  std::vector<float> rgb(codes.size());
  std::transform(codes.begin(), codes.end(), rgb.begin(), linear_of_srgb8);
  return rgb;
}

void save_codes(const fs::path& path, std::span<const unsigned char> codes, const Frame& frame, int threads) {
  const std::string format = format_of(path);
  save(path, is_8bit_format(format)
                 ? encode_image(format, codes, frame.width, frame.height, threads)
                 : encode_image(format, linear(codes), frame.width, frame.height, threads));
}

std::vector<unsigned char> encode_picture(const Frame& frame, const std::string& format, int threads) {
  return frame.rgb.empty() ? encode_image(format, frame.srgb8, frame.width, frame.height, threads)
                           : encode_image(format, frame.rgb, frame.width, frame.height, threads);
}

// Empty for nowhere.
fs::path choose_picture(const Options& options) {
  if (options.output == "none") return {};
  fs::path path = options.output == "-" ? "/dev/stdout" : options.output;
  if (path == "/dev/stdout" && standard_output_is_closed())
    throw OutputError("cannot write to standard output: it is closed");
  if (path.empty()) path = fs::path(options.scene).stem();
  if (options.output.empty()) path += path.empty() ? "scene.png" : ".png";
  refuse_inputs(options, path);
  check_image_path(path);
  return path;
}

fs::path choose_signature(const Options& options, const fs::path& picture) {
  if (options.signature->empty()) return beside(options, picture, "--signature", "signature");
  const fs::path path = *options.signature;
  refuse_inputs(options, path);
  check_image_path(path);
  return path;
}

// Throws UsageError if two of them are one file, however it is spelled.
void refuse_same_places(const OutputFiles& files) {
  std::map<fs::path, std::string> options; // by the place that they write to
  const auto add = [&](const fs::path& path, const std::string& option) {
    if (path.empty()) return;
    const auto [other, is_new] = options.emplace(place_of(path), option);
    if (!is_new)
      throw UsageError(option + " and " + other->second + " write the same file, '" + path.string() + "'");
  };
  add(files.picture, "--output");
  for (const auto& [aov, path] : files.aovs) add(path, std::string("--aov ") + aov_info(aov).name);
  add(files.signature, "--signature");
}

} // namespace

OutputFiles choose_output_files(const Options& options) {
  OutputFiles files;
  files.picture = choose_picture(options);
  const bool has_picture = !files.picture.empty();
  files.layers_in_picture = has_picture && !options.aovs.empty() && format_of(files.picture) == "exr";
  if (has_picture && !files.layers_in_picture)
    for (const Aov aov : options.aovs)
      files.aovs.emplace_back(aov, beside(options, files.picture, "--aov", aov_info(aov).name));
  if (options.signature) files.signature = choose_signature(options, files.picture);
  refuse_same_places(files);
  check_output_sizes(files, options);
  return files;
}

void check_output_sizes(const OutputFiles& files, const Options& options) {
  const Resolution size = frame_size(options);
  for (const fs::path& path : {files.picture, files.signature})
    if (!path.empty()) check_picture_size(format_of(path), size.width, size.height);
}

void refuse_scene_files(const OutputFiles& files, const std::set<fs::path>& scene_files) {
  std::vector<fs::path> outputs = {files.picture, files.signature};
  for (const auto& [aov, path] : files.aovs) outputs.push_back(path);
  std::error_code error;
  for (const fs::path& output : outputs)
    if (!output.empty() && fs::exists(output, error))
      for (const fs::path& file : scene_files) refuse_part(output, file);
}

std::vector<Aov> aovs_to_render(const Options& options) {
  std::vector<Aov> aovs = options.aovs;
  if (options.signature) aovs.push_back(Aov::id);
  return aovs;
}

void save_extra_files(const OutputFiles& files, const Frame& frame, int threads) {
  for (const auto& [aov, path] : files.aovs)
    save_codes(path, aov_picture(*frame.find(aov), threads), frame, threads);
  if (!files.signature.empty())
    save_codes(files.signature, signature_picture(*frame.find(Aov::id), threads), frame, threads);
}

void save_picture(const OutputFiles& files, const Frame& frame, std::span<const std::string> objects,
                  int threads) {
  const std::string format = format_of(files.picture);
  if (frame.aovs.empty()) objects = {};
  save(files.picture,
       format == "exr" ? encode_layers(frame, objects, threads) : encode_picture(frame, format, threads));
}

} // namespace fastrt::cli
