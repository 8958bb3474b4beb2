// SPDX-License-Identifier: Apache-2.0
#include "src/load/material_files.hpp"

#include "src/load/mtl.hpp"
#include "src/load/source.hpp"
#include "src/load/text.hpp"
#include "src/load/texture_file.hpp"
#include "src/scene/threads.hpp"

#include <fastrt/error.hpp>

#include <utility>

namespace fastrt {

namespace fs = std::filesystem;

namespace {

using Finding = SceneFolder::Finding;

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28U;

// Textures lie beside the material file or beside the scene.
MtlOptions::TextureVerdict check_texture(const SceneFolder& folder, const fs::path& beside,
                                         const std::string& name) {
  SceneFolder::Answer answer = folder.find(name, beside);
  if (answer.finding == Finding::missing) answer = folder.find(name, folder.root());
  return {texture_fault(answer.finding), std::move(answer.path)};
}

} // namespace

MaterialFiles::MaterialFiles(const fs::path& scene_file, const LoadOptions& options)
    : shown_folder_(scene_file.parent_path()), options_(options), folder_(scene_file, options) {}

void MaterialFiles::read(const std::string& names, std::uint64_t offset, MaterialSet& materials,
                         EventLog& log) {
  const bool may_be_several = names.find_first_of(" \t") != std::string::npos;
  if (names.empty() || read_one(names, may_be_several, offset, materials, log)) return;
  Words words(names);
  for (std::string_view name = words.next(); !name.empty() && !log.failed(); name = words.next())
    read_one(name, false, offset, materials, log);
}

bool MaterialFiles::read_one(std::string_view name, bool may_be_several, std::uint64_t offset,
                             MaterialSet& materials, EventLog& log) {
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  auto [finding, path] = folder_.find(name, folder_.root());
  if (finding != Finding::regular && may_be_several) return false;
  const std::string subject = "material file " + in_quotes(name);
  switch (finding) {
  case Finding::regular:
    if (!read_.contains(path) && read_.size() == most_files) {
      log.fail(offset, "more than " + std::to_string(most_files) + " material files");
    } else if (read_.insert(path).second) {
      parse(path, (shown_folder_ / with_slashes(name)).string(), offset, materials, log);
    }
    break;
  case Finding::missing:
    log.warn(offset, "missing material file", subject + " does not exist: default materials are used");
    break;
  case Finding::outside:
    log.fail(offset, subject + lies_outside);
    break;
  default:
    log.fail(offset, subject + " is not a regular file");
  }
  return true;
}

void MaterialFiles::parse(const fs::path& path, const std::string& shown, std::uint64_t offset,
                          MaterialSet& materials, EventLog& log) {
  std::string text;
  try {
    const Source source = Source::open(path);
    if (source.size() > most_bytes) {
      log.fail(offset, "material file " + in_quotes(shown) + " is larger than 256 MiB");
      return;
    }
    text.resize(source.size());
    source.read(0, text.data(), text.size());
  } catch (const InputError& error) {
    log.fail(offset, error.what());
    return;
  }
  MtlOptions mtl_options;
  mtl_options.tr_is_opacity = options_.tr_is_opacity;
  mtl_options.check_texture = [this, &path](const std::string& name) {
    return check_texture(folder_, path.parent_path(), name);
  };
  EventLog found;
  auto records = parse_mtl(text, mtl_options, found);
  if (!found.failed()) read_maps(records, thread_count(options_.threads), found);
  map_materials(records, options_.tr_is_opacity, materials, found);
  EventReport report;
  report.take(std::move(found));
  report.pass_on(Source::memory(text, shown), log, offset);
}

} // namespace fastrt
