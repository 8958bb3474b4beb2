// SPDX-License-Identifier: Apache-2.0
#include "src/scene/texture_numbers.hpp"
#include "src/trace/tracer_parts.hpp"

#include <tuple>

namespace fastrt {
namespace {

template <int n>
void copy(const glm::vec<n, float>& from, float (&to)[n]) {
  for (int i = 0; i < n; ++i) to[i] = from[i];
}

std::size_t level_count(const Texture& texture) {
  return texture.kind == TextureKind::image ? texture.image->levels().size() : 0;
}

TextureLevel level_of(const Image& image, const Image::Level& level) {
  TextureLevel row{};
  if (image.bytes().empty())
    row.floats = image.floats().data() + 4 * level.first;
  else
    row.bytes = image.bytes().data() + 4 * level.first;
  row.width = level.width;
  row.height = level.height;
  return row;
}

TextureRow row_of(const Texture& texture) {
  TextureRow row{};
  row.checker = texture.kind == TextureKind::checker;
  row.planar = texture.space == TextureSpace::plane;
  row.clamp = texture.clamp;
  copy(texture.plane_u, row.plane_u);
  copy(texture.plane_v, row.plane_v);
  row.plane_density = glm::length(glm::cross(texture.plane_u, texture.plane_v));
  copy(texture.scale, row.scale);
  copy(texture.offset, row.offset);
  row.gain = texture.gain;
  row.base = texture.base;
  copy(texture.channel, row.channel);
  copy(texture.color_a, row.color_a);
  copy(texture.color_b, row.color_b);
  if (texture.kind != TextureKind::image) return row;
  const Image& image = *texture.image;
  row.decoded = image.decoded().data();
  row.pixels = texture_pixels(texture);
  row.last_level = static_cast<float>(image.levels().size() - 1);
  return row;
}

const TextureRow* at(const TextureRows& textures, std::uint32_t id) {
  return id == no_texture ? nullptr : &textures.rows[id];
}

// Whether two textures have the same colours everywhere.
bool are_alike(const Texture& a, const Texture& b) {
  const auto all = [](const Texture& t) {
    return std::tie(t.kind, t.image, t.color_a, t.color_b, t.space, t.plane_u, t.plane_v, t.scale, t.offset,
                    t.clamp, t.gain, t.base);
  };
  return all(a) == all(b);
}

// A material's ambient texture: where it is like the diffuse one, that one, so that it is looked up once.
const TextureRow* ambient_of(const Material& material, const Scene& scene, const TextureRows& textures) {
  const std::uint32_t ambient = material.ambient_texture, diffuse = material.diffuse_texture;
  const bool alike = ambient != no_texture && diffuse != no_texture &&
                     are_alike(scene.textures()[ambient], scene.textures()[diffuse]);
  return at(textures, alike ? diffuse : ambient);
}

SurfaceTextures textures_of(const Material& material, const Scene& scene, const TextureRows& textures) {
  SurfaceTextures row{};
  row.ambient = ambient_of(material, scene, textures);
  row.diffuse = at(textures, material.diffuse_texture);
  row.specular = at(textures, material.specular_texture);
  row.emission = at(textures, material.emission_texture);
  row.opacity = at(textures, material.opacity_texture);
  row.bump = at(textures, material.bump_texture);
  row.normal_map = material.bump_is_normal_map;
  row.vertex_colors = material.vertex_colors;
  if (row.bump == nullptr) return row;
  const Vec2 slope = bump_slope(material, scene.textures()[material.bump_texture]);
  row.bump_u = slope.x;
  row.bump_v = slope.y;
  return row;
}

} // namespace

TextureRows texture_rows(const Scene& scene) {
  TextureRows textures;
  std::size_t levels = 0;
  for (const Texture& texture : scene.textures()) levels += level_count(texture);
  textures.levels.reserve(levels); // rows point into it
  for (const Texture& texture : scene.textures()) {
    textures.rows.push_back(row_of(texture));
    if (texture.kind != TextureKind::image) continue;
    textures.rows.back().levels = textures.levels.data() + textures.levels.size();
    for (const Image::Level& level : texture.image->levels())
      textures.levels.push_back(level_of(*texture.image, level));
  }
  for (const Material& material : scene.materials())
    textures.materials.push_back(textures_of(material, scene, textures));
  return textures;
}

} // namespace fastrt
