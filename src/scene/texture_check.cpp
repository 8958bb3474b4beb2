// SPDX-License-Identifier: Apache-2.0
#include "src/scene/printable.hpp"
#include "src/scene/scene_check.hpp"

#include <fastrt/error.hpp>

#include <cmath>

namespace fastrt {

namespace {

template <int n>
bool are_finite(const glm::vec<n, float>& v) {
  for (int i = 0; i < n; ++i)
    if (!std::isfinite(v[i])) return false;
  return true;
}

bool is_colour(const glm::vec4& v) {
  return are_finite(v) && v.x >= 0.0F && v.y >= 0.0F && v.z >= 0.0F && v.w >= 0.0F;
}

std::string fault_of(const Texture& t) {
  if (t.kind > TextureKind::gradient) return "the kind is not known";
  if (t.space > TextureSpace::plane) return "the space is not known";
  if (t.kind == TextureKind::image && t.image == nullptr) return "there is no image";
  if (!is_colour(t.color_a) || !is_colour(t.color_b)) return "the colours must be finite and not negative";
  const bool finite = are_finite(t.scale) && are_finite(t.offset) && are_finite(t.plane_u) &&
                      are_finite(t.plane_v) && are_finite(t.channel) && std::isfinite(t.gain) &&
                      std::isfinite(t.base);
  return finite ? "" : "its numbers must be finite";
}

// "" if the material's textures can be used, else what is wrong.
std::string fault_of(const Material& m, const std::vector<Texture>& textures) {
  for (const std::uint32_t id : {m.ambient_texture, m.diffuse_texture, m.specular_texture, m.emission_texture,
                                 m.opacity_texture, m.bump_texture})
    if (id != no_texture && id >= textures.size())
      return "refers to texture " + std::to_string(id) + ", but there are " + std::to_string(textures.size());
  if (m.bump_texture != no_texture && textures[m.bump_texture].kind != TextureKind::image)
    return "a bump texture must be an image";
  return std::isfinite(m.bump_scale) ? "" : "the bump scale must be finite";
}

} // namespace

void check_textures(const SceneDesc& desc) {
  for (std::size_t i = 0; i < desc.textures.size(); ++i)
    if (const std::string fault = fault_of(desc.textures[i]); !fault.empty())
      throw InputError("texture " + std::to_string(i) + ": " + fault);
  for (std::size_t i = 0; i < desc.materials.size(); ++i) {
    const Material& material = desc.materials[i];
    std::string fault = fault_of(material, desc.textures);
    if (fault.empty() && material.vertex_colors && desc.colors.size() == 0)
      fault = "takes vertex colours, but there are none";
    if (fault.empty()) continue;
    const std::string name = material.name.empty() ? "" : " ('" + printable(material.name) + "')";
    throw InputError("material " + std::to_string(i) + name + ": " + fault);
  }
}

} // namespace fastrt
