// SPDX-License-Identifier: Apache-2.0
#include "src/load/mtl.hpp"
#include "src/load/text.hpp"
#include "src/load/toml_scene.hpp"
#include "src/scene/row_counts.hpp"

#include <iterator>
#include <utility>

namespace fastrt {
namespace {

// A key of a texture, and the slot that it fills.
struct Slot {
  std::string_view key;
  std::uint32_t Material::*texture;
  Vec3 Material::*color; // becomes 1 if a new material has the texture and does not say it
  std::string_view color_key;
  TextureCode code;
};

constexpr Slot slots[] = {
    {"diffuse_texture", &Material::diffuse_texture, &Material::diffuse, "diffuse", TextureCode::color},
    {"ambient_texture", &Material::ambient_texture, nullptr, "ambient", TextureCode::color},
    {"specular_texture", &Material::specular_texture, &Material::specular, "specular", TextureCode::color},
    {"emission_texture", &Material::emission_texture, &Material::emission, "emission", TextureCode::color},
    {"opacity_texture", &Material::opacity_texture, nullptr, "opacity", TextureCode::data},
    {"bump_texture", &Material::bump_texture, nullptr, "bump_scale", TextureCode::data},
    {"normal_texture", &Material::bump_texture, nullptr, "bump_scale", TextureCode::data}};

constexpr std::string_view keys[] = {"preset",
                                     "ambient",
                                     "diffuse",
                                     "specular",
                                     "specular_model",
                                     "shininess",
                                     "emission",
                                     "mirror",
                                     "fresnel",
                                     "opacity",
                                     "transmission",
                                     "ior",
                                     "absorption",
                                     "thin",
                                     "unlit",
                                     "vertex_colors",
                                     "bump_scale",
                                     "ambient_texture",
                                     "diffuse_texture",
                                     "specular_texture",
                                     "emission_texture",
                                     "opacity_texture",
                                     "bump_texture",
                                     "normal_texture"};

Material new_material() {
  Material m = default_material();
  m.shininess = 10;
  return m;
}

void read_preset(const TomlFields& fields, Material& m) {
  static constexpr std::string_view presets[] = {"glass", "water", "mirror"};
  const auto preset = fields.find("preset");
  if (!preset) return;
  const std::size_t which = preset->choice(presets);
  m.mirror = Vec3(1.0F);
  m.diffuse = m.ambient = Vec3(0.0F);
  if (which == 2) return;
  m.opacity = 0;
  m.ior = which == 0 ? 1.5F : 1.333F;
  m.fresnel = Fresnel::dielectric;
  m.thin = false;
}

void read_terms(const TomlFields& fields, Material& m) {
  static constexpr std::string_view models[] = {"phong", "blinn"};
  static constexpr std::string_view fresnels[] = {"none", "schlick", "dielectric"};
  const bool ambient_follows = m.ambient == m.diffuse;
  fields.read_color("diffuse", m.diffuse);
  if (ambient_follows) m.ambient = m.diffuse;
  fields.read_color("ambient", m.ambient);
  fields.read_color("specular", m.specular);
  if (const auto model = fields.find("specular_model"))
    m.specular_model = static_cast<SpecularModel>(model->choice(models));
  fields.read("shininess", m.shininess, {1});
  fields.read_color("emission", m.emission);
  fields.read_color("mirror", m.mirror);
  if (const auto fresnel = fields.find("fresnel"))
    m.fresnel = static_cast<Fresnel>(fresnel->choice(fresnels));
  fields.read("opacity", m.opacity, {0, 1});
  fields.read_color("transmission", m.transmission);
  fields.read("ior", m.ior, positive);
  fields.read_color("absorption", m.absorption);
  fields.read("unlit", m.unlit);
  fields.read("vertex_colors", m.vertex_colors);
}

void read_textures(const TomlFile& file, const TomlFields& fields, bool is_new, Material& m,
                   TomlScene& scene) {
  if (fields.has("bump_texture") && fields.has("normal_texture"))
    fields.fail(fields.place("normal_texture"),
                fields.what() + " has both 'bump_texture' and 'normal_texture'");
  const bool ambient_follows = m.ambient_texture == m.diffuse_texture;
  for (const Slot& slot : slots) {
    const auto value = fields.find(slot.key);
    if (!value) continue;
    TomlTexture wish{};
    wish.shows_fault = slot.texture == &Material::diffuse_texture;
    wish.may_be_alpha = slot.texture == &Material::opacity_texture;
    m.*slot.texture = read_toml_texture(file, *value, slot.code, std::move(wish), scene);
    const bool takes_image = slot.texture == &Material::bump_texture;
    if (takes_image && m.bump_texture != no_texture &&
        scene.desc.textures[m.bump_texture].kind != TextureKind::image)
      value->fail("must be a picture");
    if (takes_image) m.bump_is_normal_map = slot.key == "normal_texture";
    if (is_new && slot.color != nullptr && !fields.has(slot.color_key)) m.*slot.color = Vec3(1.0F);
  }
  if (ambient_follows && fields.has("diffuse_texture") && !fields.has("ambient_texture")) {
    m.ambient_texture = m.diffuse_texture;
    if (is_new && !fields.has("ambient")) m.ambient = m.diffuse;
  }
  fields.read("bump_scale", m.bump_scale);
}

// Light that is not bent goes straight through.
void read_thin(const TomlFields& fields, Material& m) {
  const bool lets_through = m.opacity < 1.0F || m.opacity_texture != no_texture;
  bool is_spoken_of = false;
  for (const std::string_view key : {"opacity", "opacity_texture", "ior", "absorption"})
    is_spoken_of = is_spoken_of || fields.has(key);
  if (is_spoken_of) m.thin = lets_through && m.ior == 1.0F && m.absorption == Vec3(0.0F);
  fields.read("thin", m.thin);
}

void read_material(const TomlFile& file, const TomlEntry& entry, TomlScene& scene) {
  const TomlFields fields(file.name, entry.node, "[material." + entry.key + "]", keys);
  const auto known = scene.materials.find(std::string_view(entry.key));
  const bool is_new = known == scene.materials.end();
  Material material = is_new ? new_material() : scene.desc.materials[known->second];
  material.name = entry.key;
  read_preset(fields, material);
  read_terms(fields, material);
  read_textures(file, fields, is_new, material, scene);
  read_thin(fields, material);
  if (is_new) {
    scene.materials.emplace(entry.key, checked_size(scene.desc.materials.size(), "materials"));
    scene.desc.materials.push_back(std::move(material));
  } else {
    scene.desc.materials[known->second] = std::move(material);
  }
}

} // namespace

void read_toml_materials(const TomlFile& file, const TomlNode& node, TomlScene& scene) {
  if (node.table() == nullptr)
    toml_fail(file.name, node.place, "material: expected tables [material.NAME], found " + describe(node));
  for (const TomlEntry& entry : *node.table()) read_material(file, entry, scene);
}

} // namespace fastrt
