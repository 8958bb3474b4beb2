// SPDX-License-Identifier: Apache-2.0
#include "src/scene/printable.hpp"
#include "src/scene/scene_check.hpp"

#include <fastrt/error.hpp>

#include <cmath>

namespace fastrt {

namespace {

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_colour(const Vec3& v) { return is_finite(v) && v.x >= 0.0F && v.y >= 0.0F && v.z >= 0.0F; }

// "" if the material can be used, else what is wrong with it.
std::string fault_of(const Material& m) {
  const struct {
    const char* name;
    const Vec3& value;
  } colours[] = {{"ambient (Ka)", m.ambient},         {"diffuse (Kd)", m.diffuse},
                 {"specular (Ks)", m.specular},       {"emission (Ke)", m.emission},
                 {"mirror (Kr)", m.mirror},           {"transmission (Kt)", m.transmission},
                 {"absorption (sigma)", m.absorption}};
  for (const auto& colour : colours)
    if (!is_colour(colour.value))
      return std::string("the ") + colour.name + " colour must be finite and not negative";
  if (!(std::isfinite(m.shininess) && m.shininess >= 1.0F)) return "the shininess must be at least 1";
  if (!(m.opacity >= 0.0F && m.opacity <= 1.0F)) return "the opacity must be from 0 to 1";
  if (!(std::isfinite(m.ior) && m.ior > 0.0F)) return "the index of refraction must be greater than 0";
  if (m.specular_model > SpecularModel::blinn) return "the specular model is not known";
  if (m.fresnel > Fresnel::dielectric) return "the Fresnel model is not known";
  return {};
}

std::string fault_of(const Light& light) {
  if (!is_colour(light.intensity)) return "the intensity must be finite and not negative";
  switch (light.kind) {
  case LightKind::point:
    return is_finite(light.position) ? "" : "the position must be finite";
  case LightKind::directional:
    if (!is_finite(light.direction)) return "the direction must be finite";
    return light.direction == Vec3(0.0F) ? "the direction must not be 0" : "";
  }
  return "the kind is not known";
}

} // namespace

void check_materials(const SceneDesc& desc) {
  for (std::size_t i = 0; i < desc.materials.size(); ++i) {
    const std::string fault = fault_of(desc.materials[i]);
    if (fault.empty()) continue;
    const std::string& name = desc.materials[i].name;
    std::string which = std::to_string(i);
    if (!name.empty()) which.append(" ('").append(printable(name)).append("')");
    throw InputError("material " + which + ": " + fault);
  }
}

void check_lights(const SceneDesc& desc) {
  for (std::size_t i = 0; i < desc.lights.size(); ++i) {
    const std::string fault = fault_of(desc.lights[i]);
    if (!fault.empty()) throw InputError("light " + std::to_string(i) + ": " + fault);
  }
  if (!is_colour(desc.ambient)) throw InputError("the ambient light must be finite and not negative");
  if (!is_colour(desc.background)) throw InputError("the background must be finite and not negative");
}

} // namespace fastrt
