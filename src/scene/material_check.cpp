// SPDX-License-Identifier: Apache-2.0
#include "src/scene/finite.hpp"
#include "src/scene/printable.hpp"
#include "src/scene/scene_check.hpp"

#include <fastrt/error.hpp>

#include <cmath>

namespace fastrt {

namespace {

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

std::string spot_fault(const Light& light) {
  if (!(light.cone_degrees > 0.0F && light.cone_degrees <= 180.0F))
    return "the cone must be greater than 0 and at most 180 degrees";
  if (!(light.penumbra_degrees >= 0.0F && light.penumbra_degrees <= light.cone_degrees))
    return "the penumbra must be from 0 degrees to the cone's angle";
  return std::isfinite(light.exponent) && light.exponent >= 0.0F ? "" : "the exponent must be at least 0";
}

// The sine of the angle between a rectangle's sides up to which they count as parallel.
constexpr double least_sine = 1e-6;

bool spans_area(const Vec3& u, const Vec3& v) {
  const glm::dvec3 wide_u(u), wide_v(v);
  return glm::length(glm::cross(wide_u, wide_v)) > least_sine * glm::length(wide_u) * glm::length(wide_v);
}

std::string size_fault(const Light& light) {
  const bool is_round = light.kind == LightKind::disk || light.kind == LightKind::sphere;
  if (is_round && !(std::isfinite(light.radius) && light.radius > 0.0F))
    return "the radius must be greater than 0";
  if (light.kind != LightKind::rectangle) return "";
  if (!is_finite(light.half_u) || !is_finite(light.half_v)) return "the sides must be finite";
  return spans_area(light.half_u, light.half_v) ? "" : "the sides span no area";
}

std::string mesh_fault(const SceneDesc& desc, const Light& light) {
  if (light.material >= desc.materials.size())
    return "it refers to material " + std::to_string(light.material) + ", but there are " +
           std::to_string(desc.materials.size());
  const Material& material = desc.materials[light.material];
  const std::string name = "the material '" + printable(material.name) + "' ";
  if (material.emission == Vec3(0.0F)) return name + "emits nothing (Ke)";
  if (material.emission_texture != no_texture) return name + "has a texture of what it emits";
  return {};
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

std::string light_fault(const SceneDesc& desc, const Light& light) {
  if (!is_colour(light.intensity)) return "the intensity must be finite and not negative";
  if (light.kind > LightKind::mesh) return "the kind is not known";
  if (!is_colour(light.ambient)) return "the ambient part must be finite and not negative";
  if (light.kind == LightKind::mesh) return mesh_fault(desc, light);
  const bool has_place = light.kind != LightKind::directional;
  const bool has_direction = !has_place || light.kind == LightKind::spot || light.kind == LightKind::disk;
  if (has_place && !is_finite(light.position)) return "the position must be finite";
  if (has_direction && !is_finite(light.direction)) return "the direction must be finite";
  if (has_direction && light.direction == Vec3(0.0F)) return "the direction must not be 0";
  const bool falls = is_colour({light.constant, light.linear, light.quadratic}) &&
                     light.constant + light.linear + light.quadratic > 0.0F;
  if (has_place && !falls) return "its fall-off must be finite, not negative, and not 0";
  return light.kind == LightKind::spot ? spot_fault(light) : size_fault(light);
}

void check_lights(const SceneDesc& desc) {
  for (std::size_t i = 0; i < desc.lights.size(); ++i) {
    const std::string fault = light_fault(desc, desc.lights[i]);
    if (!fault.empty()) throw InputError("light " + std::to_string(i) + ": " + fault);
  }
  if (desc.ambient && !is_colour(*desc.ambient))
    throw InputError("the ambient light must be finite and not negative");
  if (desc.background && !is_colour(*desc.background))
    throw InputError("the background must be finite and not negative");
}

} // namespace fastrt
