// SPDX-License-Identifier: Apache-2.0
#include "src/load/scene_append.hpp"
#include "src/load/text.hpp"
#include "src/load/toml_scene.hpp"
#include "src/scene/row_counts.hpp"
#include "src/scene/threads.hpp"

#include <map>
#include <set>
#include <utility>

namespace fastrt {
namespace {

constexpr std::string_view keys[] = {"file",  "checker", "gradient", "plane",   "scale",     "offset",
                                     "clamp", "gain",    "base",     "channel", "colorspace"};

glm::vec4 opaque(const Vec3& color) { return {color, 1.0F}; }

void read_colors(const TomlValue& value, TextureKind kind, Texture& texture) {
  const std::vector<TomlValue> colors = value.elements();
  if (colors.size() != 2) value.fail("expected two colours, found " + describe(value.node()));
  texture.kind = kind;
  texture.color_a = opaque(colors[0].color());
  texture.color_b = opaque(colors[1].color());
}

void read_plane(const TomlValue& value, Texture& texture) {
  const std::vector<Vec3> axes = value.vectors(2);
  if (axes.size() != 2) value.fail("expected two vectors, found " + describe(value.node()));
  texture.space = TextureSpace::plane;
  texture.plane_u = axes[0];
  texture.plane_v = axes[1];
}

void read_channel(const TomlValue& value, Texture& texture) {
  static constexpr std::string_view channels[] = {"red", "green", "blue", "alpha", "luminance"};
  const std::size_t which = value.choice(channels);
  if (which == 4) return;
  texture.channel = glm::vec4(0.0F);
  texture.channel[static_cast<int>(which)] = 1.0F;
}

void read_layout(const TomlFields& fields, Texture& texture) {
  if (const auto plane = fields.find("plane")) read_plane(*plane, texture);
  if (const auto scale = fields.find("scale")) texture.scale = scale->pair();
  if (const auto offset = fields.find("offset")) texture.offset = offset->pair();
  fields.read("clamp", texture.clamp);
  fields.read("gain", texture.gain);
  fields.read("base", texture.base);
  if (const auto channel = fields.find("channel")) read_channel(*channel, texture);
}

// Exactly one of file, checker and gradient.
void check_kind(const TomlValue& value, const TomlFields& fields) {
  int kinds = 0;
  for (const std::string_view key : {"file", "checker", "gradient"}) kinds += fields.has(key) ? 1 : 0;
  if (kinds != 1) value.fail("expected one of 'file', 'checker' and 'gradient'");
}

TextureCode code_of(const TomlFields& fields, TextureCode code) {
  static constexpr std::string_view spaces[] = {"srgb", "linear"};
  const auto space = fields.find("colorspace");
  if (!space) return code;
  return space->choice(spaces) == 0 ? TextureCode::color : TextureCode::data;
}

// The file is read later; one that must not be opened, or is not there, is a fault.
void wish_for(const TomlFile& file, const TomlValue& name, TomlTexture& wish, const TomlScene& scene) {
  wish.file = file.name;
  wish.place = name.place();
  SceneFolder::Answer answer = scene.confines.find(name.text(), file.folder);
  wish.path = std::move(answer.path);
  wish.fault = texture_fault(answer.finding);
}

// Materials do without textures that have no picture.
void leave_out(const std::vector<bool>& without_picture, SceneDesc& desc) {
  for (Material& m : desc.materials)
    for (std::uint32_t* const slot : texture_slots(m))
      if (*slot != no_texture && without_picture[*slot]) *slot = no_texture;
}

// False if it is to be left out.
bool take_picture(const TomlTexture& wish, const TextureFile& picture, SceneDesc& desc) {
  Texture& texture = desc.textures[wish.texture];
  texture.image = picture.image;
  if (picture.image != nullptr) {
    if (wish.may_be_alpha && picture.image->has_alpha()) texture.channel = {0, 0, 0, 1};
    return true;
  }
  texture = missing_texture(texture.name);
  return wish.shows_fault;
}

} // namespace

std::uint32_t read_toml_texture(const TomlFile& file, const TomlValue& value, TextureCode code,
                                TomlTexture wish, TomlScene& scene) {
  if (const bool* is = std::get_if<bool>(&value.node().value); is != nullptr && !*is) return no_texture;
  Texture texture;
  wish.texture = checked_size(scene.desc.textures.size(), "textures");
  wish.code = code;
  std::optional<TomlValue> name;
  if (value.node().text() != nullptr) {
    name = value;
  } else {
    const TomlFields fields(file.name, value.node(), value.name(), keys);
    check_kind(value, fields);
    read_layout(fields, texture);
    wish.code = code_of(fields, code);
    wish.may_be_alpha = wish.may_be_alpha && !fields.has("channel");
    if (const auto colors = fields.find("checker")) read_colors(*colors, TextureKind::checker, texture);
    if (const auto colors = fields.find("gradient")) read_colors(*colors, TextureKind::gradient, texture);
    name = fields.find("file");
  }
  if (name) {
    texture.name = name->text();
    wish_for(file, *name, wish, scene);
    scene.textures.push_back(wish);
  }
  scene.desc.textures.push_back(std::move(texture));
  return wish.texture;
}

void load_toml_textures(TomlScene& scene) {
  std::set<TextureKey> wanted;
  for (const TomlTexture& wish : scene.textures)
    if (wish.fault.empty()) wanted.emplace(wish.path, wish.code);
  const std::map<TextureKey, TextureFile> files = read_textures(wanted, thread_count(scene.options.threads));
  std::set<TextureKey> told; // once for each file
  std::vector<bool> without_picture(scene.desc.textures.size());
  for (const TomlTexture& wish : scene.textures) {
    const bool found = wish.fault.empty();
    const TextureFile picture = found ? files.at({wish.path, wish.code}) : TextureFile{nullptr, wish.fault};
    if (!picture.fault.empty() && (!found || told.emplace(wish.path, wish.code).second))
      scene.warn(wish.file, wish.place, "texture",
                 "texture " + in_quotes(scene.desc.textures[wish.texture].name) + ' ' + picture.fault);
    without_picture[wish.texture] = !take_picture(wish, picture, scene.desc);
  }
  leave_out(without_picture, scene.desc);
}

} // namespace fastrt
