// SPDX-License-Identifier: Apache-2.0
#include "src/cli/light_option.hpp"

#include "src/cli/light_text.hpp"
#include "src/scene/printable.hpp"
#include "src/scene/scene_check.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace fastrt::cli {
namespace {

// What could be meant.
std::string emitting_materials(const SceneDesc& desc, const std::vector<Light>& emitting) {
  std::string names;
  for (const Light& light : emitting) {
    const std::string& name = desc.materials[light.material].name;
    if (!name.empty()) names += (names.empty() ? "" : ", ") + printable(name);
  }
  return "; those that emit light: " + (names.empty() ? "none" : names);
}

std::optional<std::uint32_t> material_named(const SceneDesc& desc, std::string_view name) {
  const auto found = std::find_if(desc.materials.begin(), desc.materials.end(),
                                  [&](const Material& material) { return material.name == name; });
  if (found == desc.materials.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - desc.materials.begin());
}

// Throws UsageError unless some triangle shines by the material.
void check_emits(const SceneDesc& desc, const Light& light) {
  const std::vector<Light> emitting = emissive_lights(desc);
  const bool does = std::any_of(emitting.begin(), emitting.end(),
                                [&](const Light& other) { return other.material == light.material; });
  if (does) return;
  const std::string fault = light_fault(desc, light);
  const std::string name = printable(desc.materials[light.material].name);
  throw UsageError("--light: " + (fault.empty() ? "no triangle has the material '" + name + "'" : fault) +
                   emitting_materials(desc, emitting));
}

// The name is the longest part of the text, from its beginning to a colon or its end, that a material has.
Light mesh_light(const SceneDesc& desc, std::string_view text) {
  for (std::size_t end = text.size(); end != 0 && end != std::string_view::npos;
       end = text.rfind(':', end - 1)) {
    const std::optional<std::uint32_t> material = material_named(desc, text.substr(0, end));
    if (!material) continue;
    Light light;
    light.kind = LightKind::mesh;
    light.material = *material;
    if (end != text.size()) read_light_fields("--light", ColonParts(text.substr(end + 1)), light);
    check_emits(desc, light);
    return light;
  }
  throw UsageError("--light: there is no material '" + printable(std::string(text)) + "'" +
                   emitting_materials(desc, emissive_lights(desc)));
}

void add_all_emissive(const Light& like, const SceneDesc& desc, std::vector<Light>& lights) {
  const std::vector<Light> found = emissive_lights(desc);
  if (found.empty()) throw UsageError("--light emissive: no triangle has a material that emits light (Ke)");
  for (const Light& light : found) {
    lights.push_back(like);
    lights.back().material = light.material;
  }
}

} // namespace

LightOption parse_light_option(std::string_view option, std::string_view text) {
  LightOption result;
  ColonParts parts(text);
  const std::string_view kind = parts.next();
  if (kind == "default") {
    if (!parts.done()) throw UsageError(std::string(option) + ": nothing follows 'default'");
    result.source = LightOption::Source::defaults;
  } else if (kind == "mesh") {
    if (parts.rest().empty()) refuse_lack(option, kind, "MATERIAL");
    result.source = LightOption::Source::material;
    result.material = parts.rest();
  } else if (kind == "emissive") {
    result.source = LightOption::Source::all_emissive;
    result.light.kind = LightKind::mesh;
    read_light_fields(option, parts, result.light);
  } else {
    result.light = parse_light(option, text);
  }
  return result;
}

void choose_lights(const std::vector<LightOption>& options, const Aabb& bounds, const Camera& camera,
                   SceneDesc& desc) {
  std::vector<Light> own = std::exchange(desc.lights, {});
  std::vector<Light> defaults;
  if (own.empty()) {
    add_default_lights(desc, bounds, camera); // and ambient light and a background
    defaults = std::exchange(desc.lights, {});
    own = emissive_lights(desc, 1.0F);
    if (own.empty()) own = defaults;
  } else {
    SceneDesc bare;
    add_default_lights(bare, bounds, camera);
    defaults = std::move(bare.lights);
  }
  if (options.empty()) desc.lights = std::move(own);
  for (const LightOption& option : options) {
    switch (option.source) {
    case LightOption::Source::defaults:
      desc.lights.insert(desc.lights.end(), defaults.begin(), defaults.end());
      break;
    case LightOption::Source::all_emissive:
      add_all_emissive(option.light, desc, desc.lights);
      break;
    case LightOption::Source::material:
      desc.lights.push_back(mesh_light(desc, option.material));
      break;
    case LightOption::Source::described:
      desc.lights.push_back(option.light);
    }
  }
}

} // namespace fastrt::cli
