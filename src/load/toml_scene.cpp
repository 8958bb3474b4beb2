// SPDX-License-Identifier: Apache-2.0
#include "src/load/toml_scene.hpp"

#include "src/load/mtl.hpp"
#include "src/load/spelling.hpp"
#include "src/load/text.hpp"
#include "src/load/warn.hpp"
#include "src/scene/row_counts.hpp"

#include <fastrt/error.hpp>

#include <utility>

namespace fastrt {
namespace {

// Of a scene.
constexpr std::size_t most_instances = most_toml_copies;

template <class Map>
[[noreturn]] void fail_unknown(const TomlValue& name, const char* kind, const Map& known,
                               const char* otherwise) {
  std::vector<std::string_view> names;
  for (const auto& entry : known) names.emplace_back(entry.first);
  const std::string meant = did_you_mean(name.text(), names);
  name.fail(std::string("unknown ") + kind + ' ' + in_quotes(name.text()) +
            (meant.empty() ? otherwise : meant));
}

} // namespace

void TomlScene::warn(const std::string& file, TomlPlace place, const char* kind, const std::string& message) {
  fastrt::warn(kind, InputError(file, place.line, place.column, message).what(), options.strict, diagnostics);
}

std::uint32_t TomlScene::add_object(std::string name) {
  const std::uint32_t object = checked_size(desc.object_names.size(), "objects");
  desc.object_names.push_back(std::move(name));
  return object;
}

std::uint32_t TomlScene::add_copy(const std::string& name, std::size_t number, std::size_t count) {
  return add_object(count > 1 ? name + ' ' + std::to_string(number) : name);
}

std::string TomlScene::next_name(const char* kind) { return kind + (' ' + std::to_string(++counts_[kind])); }

std::uint32_t TomlScene::material(const TomlValue& name) const {
  const auto known = materials.find(std::string_view(name.text()));
  if (known == materials.end()) fail_unknown(name, "material", materials, "");
  return known->second;
}

std::uint32_t TomlScene::material_of(const TomlFields& fields) {
  if (const auto name = fields.find("material")) return material(*name);
  if (!default_material_) {
    default_material_ = checked_size(desc.materials.size(), "materials");
    desc.materials.push_back(default_material());
  }
  return *default_material_;
}

const std::vector<TomlPart>& TomlScene::prototype(const TomlValue& name) const {
  const auto known = prototypes.find(name.text());
  if (known == prototypes.end())
    fail_unknown(name, "prototype", prototypes, "; a prototype must stand above what shows it");
  return known->second;
}

std::uint32_t TomlScene::add_prototype(const std::array<std::uint32_t, 5>& begin) {
  desc.prototypes.push_back({begin, checked_row_counts(desc)});
  return checked_size(desc.prototypes.size() - 1, "prototypes");
}

void TomlScene::add_instances(const TomlFields& fields, const std::vector<TomlPart>& parts,
                              const std::vector<TomlMap>& placements, const std::optional<TomlValue>& name,
                              std::uint32_t material) {
  InstanceColumns& rows = desc.instances;
  if (!parts.empty() && placements.size() > (most_instances - rows.size()) / parts.size())
    fields.fail(fields.place(),
                fields.what() + ": the scene has more than " + std::to_string(most_instances) + " instances");
  std::size_t copy = 0;
  for (const TomlMap& placement : placements) {
    const std::uint32_t object = name ? add_copy(name->text(), ++copy, placements.size()) : no_index;
    for (const TomlPart& part : parts) {
      const TomlMap to_world = after(placement, part.to_whole);
      if (!can_be_undone(to_world))
        fields.fail(fields.place(), fields.what() + ": a transform that can't be undone");
      rows.prototype.push_back(part.prototype);
      rows.to_world.push_back(rounded(to_world));
      rows.material.push_back(material != no_index ? material : part.material);
      rows.object.push_back(object != no_index ? object : part.object);
    }
  }
}

TomlScene::FoundFile TomlScene::find_file(const TomlFile& from, const TomlValue& name,
                                          const char* kind) const {
  const std::string subject = kind + (' ' + in_quotes(name.text()));
  SceneFolder::Answer answer = confines.find(name.text(), from.folder);
  switch (answer.finding) {
  case SceneFolder::Finding::regular:
    // As the user wrote it, for messages; without its `..` it is what has been looked at.
    return {from.shown / std::filesystem::path(with_slashes(name.text())).lexically_normal(),
            std::move(answer.path)};
  case SceneFolder::Finding::missing:
    name.fail(subject + " does not exist");
  case SceneFolder::Finding::outside:
    name.fail(subject + lies_outside);
  default:
    name.fail(subject + " is not a regular file");
  }
}

} // namespace fastrt
