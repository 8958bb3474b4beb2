// SPDX-License-Identifier: Apache-2.0
// The only file that includes toml++, which is slow to compile.
#include "src/load/toml_key_depth.hpp"
#include "src/load/toml_node.hpp"

#include <fastrt/error.hpp>

#include <algorithm>

#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 32
// Broken files break assertions of toml++ 3.3, which reports them as errors a few lines later. With NDEBUG it
// lets clang assume that they hold, so it must not see that.
#define TOML_ASSERT(condition) static_cast<void>(0)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace fastrt {
namespace {

TomlPlace place_of(const toml::source_region& region) { return {region.begin.line, region.begin.column}; }

TomlNode converted(const toml::node& node);

TomlArray converted_array(const toml::array& array) {
  TomlArray nodes;
  nodes.reserve(array.size());
  for (const toml::node& element : array) nodes.push_back(converted(element));
  return nodes;
}

TomlTable converted_table(const toml::table& table) {
  TomlTable entries;
  entries.reserve(table.size());
  for (const auto& [key, node] : table)
    entries.push_back({std::string(key.str()), place_of(key.source()), converted(node)});
  std::sort(entries.begin(), entries.end(),
            [](const TomlEntry& a, const TomlEntry& b) { return a.place < b.place; });
  return entries;
}

TomlNode converted(const toml::node& node) {
  const TomlPlace place = place_of(node.source());
  switch (node.type()) {
  case toml::node_type::boolean:
    return {place, node.as_boolean()->get()};
  case toml::node_type::integer:
    return {place, node.as_integer()->get()};
  case toml::node_type::floating_point:
    return {place, node.as_floating_point()->get()};
  case toml::node_type::string:
    return {place, node.as_string()->get()};
  case toml::node_type::array:
    return {place, converted_array(*node.as_array())};
  case toml::node_type::table:
    return {place, converted_table(*node.as_table())};
  default:
    return {place, TomlTime{}};
  }
}

// Keys of many parts nest as deep as they are long, and toml++ has no limit for that: it would end with a
// full stack.
void check_depth(std::string_view text, const std::string& name) {
  constexpr int most_parts = 32;
  const std::size_t at = find_deep_key(text, most_parts);
  if (at == std::string_view::npos) return;
  const std::string_view before = text.substr(0, at);
  const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  const std::size_t column = at - (before.rfind('\n') + 1) + 1; // npos + 1 is 0
  throw InputError(name, line, column, "a key has more than " + std::to_string(most_parts) + " parts");
}

} // namespace

std::string describe(const TomlNode& node) {
  switch (node.value.index()) {
  case 0:
    return "true or false";
  case 1:
  case 2:
    return "a number";
  case 3:
    return "a text";
  case 4:
    return "an array of " + std::to_string(node.array()->size());
  case 5:
    return "a table";
  default:
    return "a date or time";
  }
}

TomlTable parse_toml(std::string_view text, const std::string& name) {
  check_depth(text, name);
  try {
    return converted_table(toml::parse(text, name));
  } catch (const toml::parse_error& error) {
    const TomlPlace place = place_of(error.source());
    throw InputError(name, place.line, place.column, std::string(error.description()));
  }
}

} // namespace fastrt
