// SPDX-License-Identifier: Apache-2.0
// A TOML file as a tree of values that know their place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace fastrt {

struct TomlNode;
struct TomlEntry;

// Where a value or a key begins; from 1.
struct TomlPlace {
  std::uint32_t line = 1, column = 1;
  auto operator<=>(const TomlPlace&) const = default;
};

using TomlArray = std::vector<TomlNode>;
using TomlTable = std::vector<TomlEntry>; // in the order of the file

// Dates and times, which no scene needs.
struct TomlTime {};

struct TomlNode {
  TomlPlace place;
  std::variant<bool, std::int64_t, double, std::string, TomlArray, TomlTable, TomlTime> value;

  const TomlTable* table() const { return std::get_if<TomlTable>(&value); }
  const TomlArray* array() const { return std::get_if<TomlArray>(&value); }
  const std::string* text() const { return std::get_if<std::string>(&value); }
};

struct TomlEntry {
  std::string key;
  TomlPlace place; // of the key
  TomlNode node;
};

// What a message calls the value: "a number", "an array of 2".
std::string describe(const TomlNode& node);

// Reads a whole file. `name` is for messages. Throws InputError with file, line and column for text that is
// not TOML, and for tables within tables deeper than any scene's.
TomlTable parse_toml(std::string_view text, const std::string& name);

} // namespace fastrt
