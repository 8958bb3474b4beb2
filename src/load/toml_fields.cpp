// SPDX-License-Identifier: Apache-2.0
#include "src/load/toml_fields.hpp"

#include "src/load/spelling.hpp"
#include "src/load/text.hpp"

#include <algorithm>
#include <utility>

namespace fastrt {

TomlFields::TomlFields(const std::string& file, const TomlNode& node, std::string what,
                       std::span<const std::string_view> keys)
    : file_(&file), node_(&node), what_(std::move(what)) {
  if (node.table() == nullptr) fail(node.place, what_ + ": expected a table, found " + describe(node));
  for (const TomlEntry& entry : *node.table())
    if (std::find(keys.begin(), keys.end(), entry.key) == keys.end())
      fail(entry.place,
           "unknown key " + in_quotes(entry.key) + " in " + what_ + did_you_mean(entry.key, keys));
}

void TomlFields::fail(TomlPlace place, const std::string& message) const {
  toml_fail(*file_, place, message);
}

std::optional<TomlValue> TomlFields::find(std::string_view key) const {
  for (const TomlEntry& entry : *node_->table())
    if (entry.key == key) return TomlValue(*file_, entry.node, entry.key);
  return std::nullopt;
}

TomlValue TomlFields::need(std::string_view key) const {
  const std::optional<TomlValue> value = find(key);
  if (!value) fail(node_->place, what_ + ": " + in_quotes(key) + " is missing");
  return *value;
}

TomlPlace TomlFields::place(std::string_view key) const {
  for (const TomlEntry& entry : *node_->table())
    if (entry.key == key) return entry.place;
  return node_->place;
}

void TomlFields::read(std::string_view key, float& target, const TomlRange& range) const {
  if (const auto value = find(key)) target = value->number(range);
}

void TomlFields::read(std::string_view key, bool& target) const {
  if (const auto value = find(key)) target = value->boolean();
}

void TomlFields::read_vector(std::string_view key, Vec3& target) const {
  if (const auto value = find(key)) target = value->vector();
}

void TomlFields::read_direction(std::string_view key, Vec3& target) const {
  if (const auto value = find(key)) target = value->direction();
}

void TomlFields::read_color(std::string_view key, Vec3& target) const {
  if (const auto value = find(key)) target = value->color();
}

} // namespace fastrt
