// SPDX-License-Identifier: Apache-2.0
#include "src/load/toml_reader.hpp"

#include "src/load/scene_append.hpp"
#include "src/load/source.hpp"
#include "src/load/text.hpp"
#include "src/load/toml_scene.hpp"
#include "src/load/warn.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

namespace fastrt {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 24U;
constexpr std::size_t deepest = 16;
constexpr std::size_t most_files = 1024;

constexpr std::string_view keys[] = {"include",   "background", "ambient",  "camera", "picture", "material",
                                     "prototype", "light",      "instance", "plane",  "sphere",  "cylinder",
                                     "cone",      "disk",       "polygon",  "cube",   "mesh"};

std::string text_of(const fs::path& path) {
  const Source source = Source::open(path);
  if (source.size() > most_bytes) throw LimitError(in_quotes(source.name()) + " is larger than 16 MiB");
  std::string text(source.size(), '\0');
  source.read(0, text.data(), text.size());
  source.check_unchanged();
  return text;
}

// One of the tables that add something to the scene, in the order of the file.
struct Piece {
  TomlPlace place;
  const TomlEntry* entry; // the list, or the prototype
  const TomlNode* node;
};

std::vector<Piece> pieces_of(const TomlFile& file, const TomlTable& root) {
  std::vector<Piece> pieces;
  for (const TomlEntry& entry : root) {
    if (entry.key == "prototype") {
      if (entry.node.table() == nullptr)
        toml_fail(file.name, entry.place, "prototype: expected tables [prototype.NAME]");
      for (const TomlEntry& named : *entry.node.table()) pieces.push_back({named.place, &named, nullptr});
    } else if (entry.key == "light" || entry.key == "instance" || entry.key == "plane" ||
               find_toml_shape(entry.key) != nullptr) {
      for (const TomlNode& node : toml_list(file, entry)) pieces.push_back({node.place, &entry, &node});
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.place < b.place; });
  return pieces;
}

void read_piece(const TomlFile& file, const Piece& piece, TomlScene& scene) {
  const std::string& list = piece.entry->key;
  if (piece.node == nullptr) return read_toml_prototype(file, *piece.entry, scene);
  if (list == "light") return read_toml_light(file, *piece.node, scene);
  if (list == "instance") return read_toml_instance(file, *piece.node, scene);
  if (list == "plane") return read_toml_plane(file, *piece.node, scene);
  read_toml_shape(file, *find_toml_shape(list), *piece.node, scene);
}

// Reads files, and first those that they include, each once.
class FileReader {
public:
  explicit FileReader(TomlScene& scene) : scene_(scene) {}

  void read(const fs::path& shown, const fs::path& real) {
    const TomlFile file{shown.string(), shown.parent_path(), real.parent_path()};
    const TomlNode root{{}, parse_toml(text_of(shown), file.name)};
    const TomlFields fields(file.name, root, "the scene", keys);
    open_.push_back(real);
    if (const auto include = fields.find("include")) read_includes(file, *include);
    open_.pop_back();
    done_.insert(real);
    if (const auto background = fields.find("background")) scene_.desc.background = background->color();
    if (const auto ambient = fields.find("ambient")) scene_.desc.ambient = ambient->color();
    if (const auto camera = fields.find("camera")) read_toml_camera(file, camera->node(), scene_);
    if (const auto picture = fields.find("picture")) read_toml_picture(file, picture->node(), scene_);
    if (const auto materials = fields.find("material")) read_toml_materials(file, materials->node(), scene_);
    for (const Piece& piece : pieces_of(file, *root.table())) read_piece(file, piece, scene_);
  }

private:
  void read_includes(const TomlFile& file, const TomlValue& include) {
    if (include.node().text() != nullptr) return read_include(file, include);
    for (const TomlValue& name : include.elements()) read_include(file, name);
  }

  void read_include(const TomlFile& file, const TomlValue& name) {
    const auto [shown, real] = scene_.find_file(file, name, "scene file");
    if (std::find(open_.begin(), open_.end(), real) != open_.end())
      name.fail("include cycle: " + in_quotes(name.text()) + " is being read already");
    if (done_.contains(real)) return;
    if (lower_case(real.extension().string()) != ".toml")
      name.fail("only .toml files can be included; a [[mesh]] shows others");
    if (open_.size() == deepest)
      name.fail("includes are more than " + std::to_string(deepest) + " files deep");
    if (done_.size() + open_.size() == most_files)
      name.fail("more than " + std::to_string(most_files) + " scene files");
    read(shown, real);
  }

  TomlScene& scene_;
  std::vector<fs::path> open_; // those that include what is being read
  std::set<fs::path> done_;
};

fs::path without_links(const fs::path& path) {
  std::error_code error;
  fs::path real = fs::canonical(path, error);
  return error ? path : real;
}

// The materials of the file that a side-car stands beside can be named.
void know_materials(TomlScene& scene) {
  for (std::size_t i = 0; i < scene.desc.materials.size(); ++i)
    scene.materials.try_emplace(scene.desc.materials[i].name, static_cast<std::uint32_t>(i));
}

} // namespace

void read_toml(const fs::path& path, const LoadOptions& options, Diagnostics& diagnostics, SceneDesc& desc,
               const fs::path& base) {
  TomlScene scene(path, options, diagnostics);
  scene.desc = std::move(desc);
  if (!base.empty()) scene.base = without_links(base);
  know_materials(scene);
  FileReader(scene).read(path, without_links(path));
  load_toml_textures(scene);
  if (scene.desc.colors.size() != 0) pad_colors(scene.desc);
  finish_toml_camera(scene);
  if (base.empty()) warn_without_primitives(scene.desc, path.string(), options.strict, diagnostics);
  desc = std::move(scene.desc);
}

} // namespace fastrt
