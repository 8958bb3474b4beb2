// SPDX-License-Identifier: Apache-2.0
// What the readers of scene.toml's tables put together, from one file and those that it includes.
#pragma once

#include "src/load/material_set.hpp"
#include "src/load/scene_folder.hpp"
#include "src/load/texture_file.hpp"
#include "src/load/toml_fields.hpp"
#include "src/load/toml_transform.hpp"

#include <fastrt/load.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt {

// A scene file on its way in.
struct TomlFile {
  std::string name;             // as messages show it
  std::filesystem::path shown;  // its folder, as the user wrote it
  std::filesystem::path folder; // without links
};

// What is shown where a named prototype is: rows of the scene, and how they lie in it.
struct TomlPart {
  std::uint32_t prototype; // index of SceneDesc::prototypes
  TomlMap to_whole;
  std::uint32_t material = no_index, object = no_index;
};

// A texture whose file is read at the end, when all are known.
struct TomlTexture {
  std::uint32_t texture; // index of SceneDesc::textures
  std::filesystem::path path;
  TextureCode code;
  std::string fault; // "" if there is a file
  std::string file;  // of messages
  TomlPlace place;
  bool shows_fault; // a checker if there is no picture; others are left out
  bool may_be_alpha;
};

class TomlScene {
public:
  TomlScene(const std::filesystem::path& path, const LoadOptions& given, Diagnostics& to)
      : options(given), diagnostics(to), confines(path, given) {}

  // A warning, or with LoadOptions::strict an error.
  void warn(const std::string& file, TomlPlace place, const char* kind, const std::string& message);
  std::uint32_t add_object(std::string name);
  // The object that copy `number` of `count` is, from 1: its name is numbered if there are several.
  std::uint32_t add_copy(const std::string& name, std::size_t number, std::size_t count);
  // "sphere 3", counted by kind.
  std::string next_name(const char* kind);
  std::uint32_t material(const TomlValue& name) const;
  // That which `material` names, or a grey one.
  std::uint32_t material_of(const TomlFields& fields);
  const std::vector<TomlPart>& prototype(const TomlValue& name) const;
  // Shows the parts wherever `placements` puts them. name: of the object that each copy becomes, numbered if
  // there are several; without one, and without a material, the parts keep their own.
  void add_instances(const TomlFields& fields, const std::vector<TomlPart>& parts,
                     const std::vector<TomlMap>& placements, const std::optional<TomlValue>& name,
                     std::uint32_t material);
  // Makes the rows added since `begin` a prototype.
  std::uint32_t add_prototype(const std::array<std::uint32_t, 5>& begin);
  // Where a file that a scene names is; throws InputError unless it may be opened.
  struct FoundFile {
    std::filesystem::path shown, real; // as the user wrote it; without links
  };
  FoundFile find_file(const TomlFile& from, const TomlValue& name, const char* kind) const;

  SceneDesc desc;
  const LoadOptions& options;
  Diagnostics& diagnostics;
  SceneFolder confines;
  MaterialIds materials; // those that scene.toml may name
  std::map<std::string, std::vector<TomlPart>, std::less<>> prototypes;
  std::size_t prototype_parts = 0; // of all prototypes
  std::vector<TomlTexture> textures;
  std::optional<std::filesystem::path> base; // of a side-car: the file whose scene it completes
  std::size_t files = 0;                     // of meshes, that were read
  // Of the camera: what is known of it, and where it was spoken of last.
  bool knows_eye = false, knows_height = false;
  std::string camera_file;
  TomlPlace camera_place;

private:
  std::map<std::string, std::size_t> counts_;
  std::optional<std::uint32_t> default_material_;
};

// The readers, each of one kind of table. They throw InputError with file, line and column.
void read_toml_camera(const TomlFile& file, const TomlNode& node, TomlScene& scene);
// Lets a camera without a place of its own show the whole scene, and checks it.
void finish_toml_camera(TomlScene& scene);
void read_toml_picture(const TomlFile& file, const TomlNode& node, TomlScene& scene);
void read_toml_light(const TomlFile& file, const TomlNode& node, TomlScene& scene);
void read_toml_materials(const TomlFile& file, const TomlNode& node, TomlScene& scene);
// Index of the texture that `value` describes.
std::uint32_t read_toml_texture(const TomlFile& file, const TomlValue& value, TextureCode code,
                                TomlTexture wish, TomlScene& scene);
// Reads the pictures of all textures, and says what is wrong with them.
void load_toml_textures(TomlScene& scene);
void read_toml_prototype(const TomlFile& file, const TomlEntry& entry, TomlScene& scene);
void read_toml_instance(const TomlFile& file, const TomlNode& node, TomlScene& scene);

// A kind of primitive: its table's name, its keys, and what adds it to the scene.
struct TomlShape {
  std::string_view name;
  std::vector<std::string_view> keys;
  void (*add)(const TomlFile& file, const TomlFields& fields, TomlScene& scene);
};
// Null if there is none of that name. Planes are none.
const TomlShape* find_toml_shape(std::string_view name);
void read_toml_shape(const TomlFile& file, const TomlShape& shape, const TomlNode& node, TomlScene& scene);
void read_toml_plane(const TomlFile& file, const TomlNode& node, TomlScene& scene);
void add_toml_mesh(const TomlFile& file, const TomlFields& fields, TomlScene& scene);

// Whether it has `transform`, `transforms` or `repeat`.
bool is_placed_by(const TomlFields& fields);

// The tables of a list (`[[sphere]]`); throws InputError if it is none.
const TomlArray& toml_list(const TomlFile& file, const TomlEntry& entry);

} // namespace fastrt
