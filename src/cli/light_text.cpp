// SPDX-License-Identifier: Apache-2.0
#include "src/cli/light_text.hpp"

#include "src/cli/read_numbers.hpp"
#include "src/load/spelling.hpp"
#include "src/scene/scene_check.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fastrt::cli {
namespace {

constexpr LightForm forms[] = {
    {"point", "point:X,Y,Z", "a point"},
    {"dir", "dir:X,Y,Z", "parallel light that travels this way"},
    {"spot", "spot:X,Y,Z:DX,DY,DZ:CONE[,PENUMBRA[,EXPONENT]]", "a cone of CONE degrees from a point"},
    {"rect", "rect:X,Y,Z:UX,UY,UZ:VX,VY,VZ", "a rectangle, by its middle and half sides"},
    {"disk", "disk:X,Y,Z:NX,NY,NZ:RADIUS", "a disk, square to the direction"},
    {"sphere", "sphere:X,Y,Z:RADIUS", "a ball"},
    {"mesh", "mesh:MATERIAL[:SCALE]", "all triangles of a material that emits light"},
    {"emissive", "emissive[:SCALE]", "all materials that emit light"},
    {"default", "default", "the key light and the fill light"},
};

[[noreturn]] void refuse(std::string_view option, std::string_view part, const std::string& expected) {
  throw UsageError(std::string(option) + ": '" + std::string(part) + "' is not " + expected);
}

// "; a point is point:X,Y,Z"
std::string form_of(std::string_view kind) {
  const auto* const found = std::find_if(std::begin(forms), std::end(forms),
                                         [&](const LightForm& form) { return form.name == kind; });
  return "; a " + std::string(kind) + " is " + found->form;
}

// cone[,penumbra[,exponent]]
bool read_cone(std::string_view text, Light& light) {
  float* const targets[] = {&light.cone_degrees, &light.penumbra_degrees, &light.exponent};
  light.penumbra_degrees = 0;
  for (float* target : targets) {
    const std::size_t comma = text.find(',');
    if (!read_number(text.substr(0, comma), *target) || *target < 0) return false;
    if (comma == std::string_view::npos)
      return light.cone_degrees > 0 && light.cone_degrees <= 180 &&
             light.penumbra_degrees <= light.cone_degrees;
    text = text.substr(comma + 1);
  }
  return false;
}

// Reads the parts that a kind of light begins with.
class PlaceReader {
public:
  PlaceReader(std::string_view option, std::string_view kind, ColonParts& parts)
      : option_(option), kind_(kind), parts_(parts) {}

  void point(const char* name, Vec3& target) {
    const std::string_view part = next(name);
    if (!read_vector(part, target)) fail(part, name, "three numbers");
  }
  void direction(const char* name, Vec3& target) {
    const std::string_view part = next(name);
    if (!read_vector(part, target) || target == Vec3(0.0F)) fail(part, name, "three numbers, not all 0");
  }
  void radius(float& target) {
    const std::string_view part = next("RADIUS");
    if (!read_number(part, target) || target <= 0) fail(part, "RADIUS", "a number greater than 0");
  }
  void cone(Light& light) {
    constexpr const char* name = "CONE[,PENUMBRA[,EXPONENT]]";
    const std::string_view part = next(name);
    if (!read_cone(part, light))
      fail(part, name, "CONE up to 180 degrees, PENUMBRA no wider than it, EXPONENT at least 0");
  }

private:
  std::string_view next(const char* name) {
    if (parts_.done()) refuse_lack(option_, kind_, name);
    return parts_.next();
  }
  [[noreturn]] void fail(std::string_view part, const std::string& name, const char* meaning) const {
    refuse(option_, part, name + " (" + meaning + ")" + form_of(kind_));
  }

  std::string_view option_, kind_;
  ColonParts& parts_;
};

void read_place(std::string_view option, std::string_view kind, ColonParts& parts, Light& light) {
  PlaceReader reader(option, kind, parts);
  if (kind == "dir") {
    light.kind = LightKind::directional;
    return reader.direction("X,Y,Z", light.direction);
  }
  if (kind != "point" && kind != "spot" && kind != "rect" && kind != "disk" && kind != "sphere")
    refuse_light_kind(option, kind);
  reader.point("X,Y,Z", light.position);
  if (kind == "spot") {
    light.kind = LightKind::spot;
    reader.direction("DX,DY,DZ", light.direction);
    reader.cone(light);
  } else if (kind == "rect") {
    light.kind = LightKind::rectangle;
    reader.direction("UX,UY,UZ", light.half_u);
    reader.direction("VX,VY,VZ", light.half_v);
  } else if (kind == "disk") {
    light.kind = LightKind::disk;
    reader.direction("NX,NY,NZ", light.direction);
    reader.radius(light.radius);
  } else if (kind == "sphere") {
    light.kind = LightKind::sphere;
    reader.radius(light.radius);
  }
}

void read_intensity(std::string_view option, std::string_view part, Light& light) {
  if (read_color(part, light.intensity)) return;
  if (light.kind != LightKind::mesh)
    refuse(option, part, "a colour R,G,B (three numbers that are at least 0)");
  float scale = 0;
  if (!read_number(part, scale) || scale <= 0)
    refuse(option, part, "a SCALE (a number greater than 0, or three R,G,B that are at least 0)");
  light.intensity = Vec3(scale);
}

bool read_fade(std::string_view value, Light& light) {
  Vec3 fade{0.0F};
  if (!read_color(value, fade) || fade == Vec3(0.0F)) return false;
  light.constant = fade.x;
  light.linear = fade.y;
  light.quadratic = fade.z;
  return true;
}

// false if no field has that name.
bool read_named(std::string_view option, std::string_view part, Light& light) {
  const std::size_t equals = std::min(part.find('='), part.size());
  const std::string_view name = part.substr(0, equals);
  const std::string_view value = equals < part.size() ? part.substr(equals + 1) : std::string_view();
  if (name == "ambient") {
    if (!read_color(value, light.ambient))
      refuse(option, part, "ambient=R,G,B (numbers that are at least 0)");
  } else if (name == "shadows") {
    if (value != "on" && value != "off") refuse(option, part, "shadows=on or shadows=off");
    light.casts_shadows = value == "on";
  } else if (name == "fade") {
    if (light.kind == LightKind::directional || light.kind == LightKind::mesh)
      throw UsageError(
          std::string(option) + ": '" + std::string(part) + "': " +
          (light.kind == LightKind::mesh ? "meshes fade by themselves" : "parallel light can't fade"));
    if (!read_fade(value, light)) refuse(option, part, "fade=C,L,Q (numbers that are at least 0, not all 0)");
  } else {
    return false;
  }
  return true;
}

[[noreturn]] void refuse_field(std::string_view option, std::string_view part) {
  static constexpr std::string_view names[] = {"fade", "ambient", "shadows"};
  const std::string_view name = part.substr(0, part.find('='));
  throw UsageError(std::string(option) + ": '" + std::string(name) +
                   "' is no field of a light: fade, ambient or shadows" + did_you_mean(name, names));
}

bool begins_a_number(std::string_view part) {
  return part.empty() || std::string_view("+-.,0123456789").find(part[0]) != std::string_view::npos;
}

} // namespace

std::span<const LightForm> light_forms() { return forms; }

std::string_view ColonParts::next() {
  if (done_) return {};
  const std::size_t colon = text_.find(':');
  const std::string_view part = text_.substr(0, colon);
  done_ = colon == std::string_view::npos;
  text_ = done_ ? std::string_view() : text_.substr(colon + 1);
  return part;
}

Light parse_light(std::string_view option, std::string_view text) {
  Light light;
  ColonParts parts(text);
  read_place(option, parts.next(), parts, light);
  read_light_fields(option, parts, light);
  const std::string fault = light_fault(SceneDesc(), light);
  if (!fault.empty()) throw UsageError(std::string(option) + ": '" + std::string(text) + "': " + fault);
  return light;
}

void read_light_fields(std::string_view option, ColonParts parts, Light& light) {
  for (bool first = true; !parts.done(); first = false) {
    const std::string_view part = parts.next();
    if (read_named(option, part, light)) continue;
    if (!begins_a_number(part)) refuse_field(option, part);
    if (!first) refuse(option, part, "expected here: what follows the colour has a name");
    read_intensity(option, part, light);
  }
}

void refuse_light_kind(std::string_view option, std::string_view kind) {
  std::vector<std::string_view> names;
  std::string list;
  for (const LightForm& form : forms) {
    names.emplace_back(form.name);
    list += (list.empty() ? "" : ", ") + std::string(form.name);
  }
  throw UsageError(std::string(option) + ": '" + std::string(kind) + "' is no kind of light: " + list +
                   did_you_mean(kind, names));
}

void refuse_lack(std::string_view option, std::string_view kind, const std::string& missing) {
  throw UsageError(std::string(option) + ": " + missing + " is missing" + form_of(kind));
}

} // namespace fastrt::cli
