// SPDX-License-Identifier: Apache-2.0
#include "src/load/toml_scene.hpp"
#include "src/scene/scene_check.hpp"

#include <algorithm>
#include <iterator>

namespace fastrt {
namespace {

// A kind of light: what it is called, and its keys beside those of all.
struct LightRow {
  std::string_view name;
  LightKind kind;
  std::vector<std::string_view> keys;    // that it must have
  std::vector<std::string_view> options; // that it may have
};

const std::vector<LightRow>& light_rows() {
  static const std::vector<LightRow> rows = {
      {"point", LightKind::point, {"position"}, {"fade"}},
      {"directional", LightKind::directional, {"direction"}, {}},
      {"spot", LightKind::spot, {"position", "direction"}, {"fade", "cone", "penumbra", "exponent"}},
      {"rectangle", LightKind::rectangle, {"position", "u", "v"}, {"fade"}},
      {"disk", LightKind::disk, {"position", "direction", "radius"}, {"fade"}},
      {"sphere", LightKind::sphere, {"position", "radius"}, {"fade"}},
      {"mesh", LightKind::mesh, {"material"}, {}}};
  return rows;
}

constexpr std::string_view common_keys[] = {"type", "color", "ambient", "shadows"};

void read_fade(const TomlValue& value, Light& light) {
  float parts[3];
  value.numbers(parts);
  for (const float part : parts)
    if (part < 0.0F) value.fail("must not be negative");
  if (parts[0] + parts[1] + parts[2] <= 0.0F) value.fail("one number must be greater than 0");
  light.constant = parts[0], light.linear = parts[1], light.quadratic = parts[2];
}

void read_values(const TomlFields& fields, Light& light) {
  fields.read_color("color", light.intensity);
  fields.read_color("ambient", light.ambient);
  fields.read("shadows", light.casts_shadows);
  fields.read_vector("position", light.position);
  fields.read_direction("direction", light.direction);
  if (const auto fade = fields.find("fade")) read_fade(*fade, light);
  fields.read("cone", light.cone_degrees, {0, 180, true});
  light.penumbra_degrees = std::min(light.penumbra_degrees, light.cone_degrees);
  fields.read("penumbra", light.penumbra_degrees, {0, static_cast<double>(light.cone_degrees)});
  fields.read("exponent", light.exponent, not_negative);
  fields.read_direction("u", light.half_u);
  fields.read_direction("v", light.half_v);
  fields.read("radius", light.radius, positive);
}

const LightRow& row_of(const TomlFile& file, const TomlNode& node) {
  std::vector<std::string_view> keys(std::begin(common_keys), std::end(common_keys));
  std::vector<std::string_view> names;
  for (const LightRow& row : light_rows()) {
    names.push_back(row.name);
    keys.insert(keys.end(), row.keys.begin(), row.keys.end());
    keys.insert(keys.end(), row.options.begin(), row.options.end());
  }
  const TomlFields fields(file.name, node, "[[light]]", keys);
  return light_rows()[fields.need("type").choice(names)];
}

} // namespace

void read_toml_light(const TomlFile& file, const TomlNode& node, TomlScene& scene) {
  const LightRow& row = row_of(file, node);
  std::vector<std::string_view> keys(std::begin(common_keys), std::end(common_keys));
  keys.insert(keys.end(), row.keys.begin(), row.keys.end());
  keys.insert(keys.end(), row.options.begin(), row.options.end());
  const TomlFields fields(file.name, node, "[[light]] of type '" + std::string(row.name) + "'", keys);
  for (const std::string_view key : row.keys) fields.need(key);
  Light light;
  light.kind = row.kind;
  read_values(fields, light);
  if (const auto material = fields.find("material")) light.material = scene.material(*material);
  // What a material emits may be said further below.
  const std::string fault = light.kind == LightKind::mesh ? std::string() : light_fault(scene.desc, light);
  if (!fault.empty()) fields.fail(fields.place(), fields.what() + ": " + fault);
  scene.desc.lights.push_back(light);
}

} // namespace fastrt
