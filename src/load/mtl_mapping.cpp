// SPDX-License-Identifier: Apache-2.0
// From the statements of MTL to the terms of a Whitted ray tracer.
#include "src/load/mtl.hpp"
#include "src/load/text.hpp"
#include "src/load/texture_file.hpp"

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
  } else if (m.opacity < 1 || m.opacity_texture != no_texture) {
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
  // How much a texture takes away is not known.
  const bool varies = m.diffuse_texture != no_texture || m.specular_texture != no_texture;
  if (!m.unlit && !varies && std::max({energy.x, energy.y, energy.z}) > 1.001F)
    log.warn(record.offset, "energy", name + " returns more light than it gets: Kd + Ks + Kt exceeds 1");
}

Texture texture_of(const MtlMap& map) {
  Texture texture;
  texture.name = map.name;
  texture.image = map.image;
  texture.scale = map.scale;
  texture.offset = map.offset_uv;
  texture.clamp = map.clamp;
  texture.base = map.base;
  texture.gain = map.gain;
  switch (map.channel) {
  case 'r':
    texture.channel = {1, 0, 0, 0};
    break;
  case 'g':
    texture.channel = {0, 1, 0, 0};
    break;
  case 'b':
    texture.channel = {0, 0, 1, 0};
    break;
  case 'm':
    texture.channel = {0, 0, 0, 1};
    break;
  default:
    break;
  }
  return texture;
}

std::uint32_t add_texture(Texture texture, MaterialSet& materials) {
  materials.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(materials.textures.size() - 1);
}

std::uint32_t add_map(const MtlMap& map, MaterialSet& materials) {
  return map.image == nullptr ? no_texture : add_texture(texture_of(map), materials);
}

void set_textures(const MtlRecord& record, MaterialSet& materials, Material& m) {
  m.diffuse_texture = record.map_kd.failed ? add_texture(missing_texture(record.map_kd.name), materials)
                                           : add_map(record.map_kd, materials);
  m.ambient_texture = add_map(record.map_ka, materials);
  // A file without a map_Ka means its map_Kd for both.
  if (m.ambient_texture == no_texture) m.ambient_texture = m.diffuse_texture;
  m.specular_texture = add_map(record.map_ks, materials);
  m.emission_texture = add_map(record.map_ke, materials);
  m.opacity_texture = add_map(record.map_d, materials);
  // Cut-outs come as greys or as the alpha of a picture.
  if (m.opacity_texture != no_texture && record.map_d.channel == 0 && record.map_d.image->has_alpha())
    materials.textures[m.opacity_texture].channel = {0, 0, 0, 1};
  m.bump_texture = add_map(record.bump, materials);
  m.bump_scale = record.bump.bump;
  m.bump_is_normal_map = record.bump.is_normal_map;
}

Material map_material(const MtlRecord& record, bool tr_is_opacity, MaterialSet& materials) {
  Material m;
  m.name = record.name;
  m.diffuse = record.kd.value_or(Vec3(record.map_kd.empty() ? default_grey : 1.0F));
  m.ambient = record.ka.value_or(m.diffuse);
  m.specular = record.ks.value_or(Vec3(record.map_ks.image == nullptr ? 0.0F : 1.0F));
  m.emission = record.ke.value_or(Vec3(record.map_ke.image == nullptr ? 0.0F : 1.0F));
  m.shininess = record.ns.value_or(10.0F);
  m.ior = record.ni.value_or(1.0F);
  m.opacity = opacity_of(record, tr_is_opacity);
  set_textures(record, materials, m);
  set_illumination(record, m);
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
    Material material = map_material(record, tr_is_opacity || guessed, materials);
    warn_about(record, material, log);
    materials.add(std::move(material));
  }
}

} // namespace fastrt
