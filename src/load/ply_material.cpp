// SPDX-License-Identifier: Apache-2.0
#include "src/load/ply_material.hpp"

#include "src/load/mtl.hpp"
#include "src/load/text.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace fastrt {

namespace {

// Whether the header names a picture that the vertices can take.
bool has_texture(const PlyHeader& header, const PlyReaderSettings& settings, const PlyWarning& warn,
                 const SceneDesc& desc) {
  if (header.textures.empty() || !settings.read_texture) return false;
  const PlyTexture& first = header.textures.front();
  if (desc.uvs.size() == 0) {
    warn("texture", first.place,
         "texture " + in_quotes(first.name) + " is not used: the vertices have no texture coordinates");
    return false;
  }
  if (header.textures.size() > 1)
    warn("textures", header.textures[1].place, "several textures are not supported: the first one is used");
  return true;
}

Texture read_texture(const PlyTexture& wanted, const PlyReaderSettings& settings, const PlyWarning& warn) {
  TextureFile file = settings.read_texture(wanted.name);
  if (!file.fault.empty())
    warn("texture", wanted.place, "texture " + in_quotes(wanted.name) + ' ' + file.fault);
  if (file.image == nullptr) return missing_texture(wanted.name);
  Texture texture;
  texture.name = wanted.name;
  texture.image = std::move(file.image);
  return texture;
}

} // namespace

void warn_about_face_properties(const PlyElement& face, const PlyWarning& warn) {
  static constexpr std::array<std::string_view, 3> colors = {"red", "green", "blue"};
  bool has_colors = false;
  for (const PlyProperty& property : face.properties) {
    const bool is_color = std::find(colors.begin(), colors.end(), property.name) != colors.end();
    if (is_color && !std::exchange(has_colors, true))
      warn("colours of faces", property.place, "colours of faces are not supported and skipped");
    if (property.is_list && property.name == "texcoord")
      warn("texture coordinates of faces", property.place,
           "texture coordinates of faces are not supported and skipped; those of vertices are");
  }
}

void add_ply_material(const PlyHeader& header, const PlyReaderSettings& settings, const PlyWarning& warn,
                      SceneDesc& desc) {
  Material material = default_material();
  if (has_texture(header, settings, warn, desc)) {
    material.ambient = material.diffuse = Vec3(1.0F);
    material.ambient_texture = material.diffuse_texture = 0;
    desc.textures.push_back(read_texture(header.textures.front(), settings, warn));
  } else if (desc.colors.size() != 0) {
    material.ambient = material.diffuse = Vec3(1.0F);
    material.vertex_colors = true;
  }
  desc.materials = {material};
}

} // namespace fastrt
