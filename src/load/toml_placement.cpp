// SPDX-License-Identifier: Apache-2.0
// Copies: `transform`, `transforms` and `repeat`.
#include "src/load/toml_transform.hpp"

#include <string>

namespace fastrt {
namespace {

struct Repeat {
  std::size_t count;
  TomlMap step;
};

Repeat read_repeat(const TomlValue& value) {
  static constexpr std::string_view keys[] = {"count", "step"};
  const TomlFields fields(value.file(), value.node(), "repeat", keys);
  return {static_cast<std::size_t>(fields.need("count").integer(1, most_toml_copies)),
          read_transform(fields.need("step"))};
}

// Each map, and each after the step, after the step twice, and so on.
std::vector<TomlMap> repeated(const std::vector<TomlMap>& maps, const Repeat& repeat,
                              const TomlValue& value) {
  if (repeat.count > most_toml_copies / maps.size())
    value.fail("more than " + std::to_string(most_toml_copies) + " copies");
  std::vector<TomlMap> all;
  all.reserve(repeat.count * maps.size());
  TomlMap by;
  for (std::size_t k = 0; k < repeat.count; ++k, by = after(repeat.step, by))
    for (const TomlMap& map : maps) all.push_back(after(by, map));
  return all;
}

} // namespace

std::vector<TomlMap> read_placements(const TomlFields& fields) {
  std::vector<TomlMap> maps;
  const auto one = fields.find("transform");
  if (one) maps.push_back(read_transform(*one));
  if (const auto several = fields.find("transforms")) {
    const TomlMap first = one ? maps.front() : TomlMap{};
    maps.clear();
    for (const TomlValue& value : several->elements()) maps.push_back(after(read_transform(value), first));
    if (maps.empty()) several->fail("expected at least one transform");
  }
  if (const auto repeat = fields.find("repeat")) {
    if (maps.empty()) maps.emplace_back();
    if (repeat->node().table() != nullptr) {
      maps = repeated(maps, read_repeat(*repeat), *repeat);
    } else {
      for (const TomlValue& value : repeat->elements()) maps = repeated(maps, read_repeat(value), *repeat);
    }
  }
  for (const TomlMap& map : maps)
    if (!can_be_undone(map))
      fields.fail(fields.place(), fields.what() + ": a transform that can't be undone");
  return maps;
}

} // namespace fastrt
