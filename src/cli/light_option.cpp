// SPDX-License-Identifier: Apache-2.0
#include "src/cli/light_option.hpp"

#include "src/cli/parse.hpp"
#include "src/scene/printable.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace fastrt::cli {
namespace {

std::string_view next_field(std::string_view& text) {
  const std::size_t colon = text.find(':');
  const std::string_view field = text.substr(0, colon);
  text = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  return field;
}

// One number, or a colour.
Vec3 parse_scale(std::string_view option, std::string_view text) {
  if (text.find(',') != std::string_view::npos) return parse_color(option, text);
  return Vec3(parse_length(option, text));
}

// [:scale][:ambient=r,g,b][:shadows=on|off], without the first colon.
void parse_fields(std::string_view option, std::string_view fields, Light& light) {
  for (bool first = true; !fields.empty(); first = false) {
    const std::string_view field = next_field(fields);
    const std::size_t equals = field.find('=');
    const std::string_view name = field.substr(0, equals);
    if (equals == std::string_view::npos && first)
      light.intensity = parse_scale(option, field);
    else if (name == "ambient" && equals != std::string_view::npos)
      light.ambient = parse_color(option, field.substr(equals + 1));
    else if (field == "shadows=on" || field == "shadows=off")
      light.casts_shadows = field == "shadows=on";
    else
      throw UsageError(std::string(option) + ": '" + std::string(field) +
                       "' is not ambient=r,g,b or shadows=off");
  }
}

std::uint32_t material_named(const SceneDesc& desc, const std::string& name) {
  const auto found = std::find_if(desc.materials.begin(), desc.materials.end(),
                                  [&](const Material& material) { return material.name == name; });
  if (found != desc.materials.end()) return static_cast<std::uint32_t>(found - desc.materials.begin());
  std::string emitting;
  for (const Light& light : emissive_lights(desc))
    emitting += (emitting.empty() ? "" : ", ") + printable(desc.materials[light.material].name);
  throw UsageError("--light: there is no material '" + printable(name) +
                   "'; those that emit light: " + (emitting.empty() ? "none" : emitting));
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
  std::string_view rest = text;
  const std::string_view kind = next_field(rest);
  if (kind == "default" && kind == text) {
    result.source = LightOption::Source::defaults;
    return result;
  }
  if (kind != "mesh" && kind != "emissive") {
    result.light = parse_light(option, text);
    return result;
  }
  result.light.kind = LightKind::mesh;
  result.source = LightOption::Source::all_emissive;
  if (kind == "mesh") {
    result.source = LightOption::Source::material;
    result.material = next_field(rest);
    if (result.material.empty())
      throw UsageError(std::string(option) + ": 'mesh:' is followed by the name of a material");
  }
  parse_fields(option, rest, result.light);
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
      desc.lights.push_back(option.light);
      desc.lights.back().material = material_named(desc, option.material);
      break;
    case LightOption::Source::described:
      desc.lights.push_back(option.light);
    }
  }
}

} // namespace fastrt::cli
