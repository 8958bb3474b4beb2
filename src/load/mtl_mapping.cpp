// SPDX-License-Identifier: Apache-2.0
// From the statements of MTL to the terms of a Whitted ray tracer.
#include "src/load/mtl.hpp"
#include "src/load/text.hpp"

#include <glm/glm.hpp>

#include <algorithm>

namespace fastrt {

namespace {

constexpr float default_grey = 0.8F;

// d where it is given, else from Tr, which says 1 - d by habit; some exporters write d itself.
float opacity_of(const MtlRecord& record, bool tr_is_opacity) {
  if (record.d) return *record.d;
  if (!record.tr) return 1;
  return tr_is_opacity ? *record.tr : 1 - *record.tr;
}

// Whether Tr read as 1 - d would make everything in the file invisible.
bool tr_must_be_opacity(const std::vector<MtlRecord>& records) {
  bool from_tr = false;
  for (const MtlRecord& record : records) {
    if (opacity_of(record, false) != 0) return false;
    from_tr = from_tr || !record.d;
  }
  return from_tr;
}

// What illum says about reflection and refraction.
void set_illumination(const MtlRecord& record, Material& m) {
  const Vec3 tf = record.tf.value_or(Vec3(1.0F));
  const bool refracts = record.illum == 6 || record.illum == 7;
  switch (record.illum) {
  case 0:
    m.unlit = true;
    break;
  case 1:
    m.specular = Vec3(0.0F);
    break;
  case 3:
  case 4:
  case 6:
    m.mirror = m.specular;
    break;
  case 5:
    m.mirror = m.specular;
    m.fresnel = Fresnel::schlick;
    break;
  case 7:
    m.mirror = Vec3(1.0F);
    m.fresnel = Fresnel::dielectric;
    break;
  default:
    break;
  }
  if (refracts) {
    // Tf alone says how much passes through; d is left at 1 by most exporters.
    if (m.opacity == 1) m.opacity = 0;
    m.transmission = record.illum == 6 ? (Vec3(1.0F) - glm::min(m.specular, Vec3(1.0F))) * tf : tf;
  } else if (m.opacity < 1) {
    m.thin = true;
    if (record.illum == 4 || record.illum == 9) m.transmission = tf;
  }
}

void warn_about(const MtlRecord& record, const Material& m, EventLog& log) {
  const std::string name = "material " + in_quotes(record.name);
  const bool refracts = record.illum == 6 || record.illum == 7;
  if (refracts && m.ior == 1)
    log.warn(record.offset, "no refraction",
             name + " refracts, but its Ni is 1 or missing: light is not bent");
  if (record.illum == 10)
    log.warn(record.offset, "illum", name + ": illum 10 (shadow catcher) is not supported and taken as 2");
  const Vec3 reflected = m.fresnel == Fresnel::none ? m.mirror : Vec3(0.0F);
  const Vec3 energy = m.opacity * (m.diffuse + m.specular) + (1 - m.opacity) * (m.transmission + reflected);
  if (!m.unlit && std::max({energy.x, energy.y, energy.z}) > 1.001F)
    log.warn(record.offset, "energy", name + " returns more light than it gets: Kd + Ks + Kt exceeds 1");
}

Material map_material(const MtlRecord& record, bool tr_is_opacity) {
  Material m;
  m.name = record.name;
  m.diffuse = record.kd.value_or(Vec3(record.map_kd.empty() ? default_grey : 1.0F));
  m.ambient = record.ka.value_or(m.diffuse);
  m.specular = record.ks.value_or(Vec3(0.0F));
  m.emission = record.ke.value_or(Vec3(0.0F));
  m.shininess = record.ns.value_or(10.0F);
  m.ior = record.ni.value_or(1.0F);
  m.opacity = opacity_of(record, tr_is_opacity);
  set_illumination(record, m);
  m.diffuse_map = record.map_kd;
  m.ambient_map = record.map_ka;
  m.specular_map = record.map_ks;
  m.emission_map = record.map_ke;
  m.opacity_map = record.map_d;
  m.bump_map = record.bump;
  return m;
}

} // namespace

Material default_material() {
  Material m;
  m.name = "default";
  m.diffuse = m.ambient = Vec3(default_grey);
  return m;
}

void map_materials(const std::vector<MtlRecord>& records, bool tr_is_opacity, MaterialSet& materials,
                   EventLog& log) {
  const bool guessed = !tr_is_opacity && tr_must_be_opacity(records);
  if (guessed)
    log.warn(records.front().offset, "Tr",
             "Tr as transparency would make every material invisible; it is taken as opacity");
  for (const MtlRecord& record : records) {
    if (materials.ids.contains(record.name))
      log.warn(record.offset, "duplicate material",
               "material " + in_quotes(record.name) + " is defined again; the last definition counts");
    Material material = map_material(record, tr_is_opacity || guessed);
    warn_about(record, material, log);
    materials.add(std::move(material));
  }
}

} // namespace fastrt
