// SPDX-License-Identifier: Apache-2.0
// Textures at random, and surfaces that have them.
#pragma once

#include "tests/equivalence/random_shots.hpp"

#include <memory>
#include <vector>

namespace fastrt::test {

inline std::shared_ptr<const Image> any_image(Random& random) {
  constexpr int sides[] = {1, 2, 3, 5, 8, 17, 32};
  const int width = sides[random.below(7)], height = sides[random.below(7)];
  const auto count = static_cast<std::size_t>(4 * width * height);
  if (random.below(3) == 0) {
    std::vector<float> values(count);
    for (float& value : values) value = random.uniform(0, 1.5F);
    return std::make_shared<const Image>(width, height, std::span<const float>(values));
  }
  std::vector<std::uint8_t> codes(count);
  for (std::uint8_t& code : codes) code = static_cast<std::uint8_t>(random.below(256));
  return std::make_shared<const Image>(width, height, std::span<const std::uint8_t>(codes),
                                       random.below(2) == 0);
}

inline glm::vec4 any_rgba(Random& random) {
  const Vec3 rgb = any_colour(random, 1);
  return {rgb, random.uniform()};
}

inline Texture any_texture(Random& random, bool image) {
  Texture t;
  t.kind = image ? TextureKind::image : static_cast<TextureKind>(random.below(3));
  if (t.kind == TextureKind::image) t.image = any_image(random);
  t.color_a = any_rgba(random);
  t.color_b = any_rgba(random);
  t.space = random.below(3) == 0 ? TextureSpace::plane : TextureSpace::surface;
  t.plane_u = random.uniform(0.2F, 3) * random.direction();
  t.plane_v = random.uniform(0.2F, 3) * random.direction();
  t.scale = {random.uniform(-4, 4), random.below(9) == 0 ? 0.0F : random.uniform(-4, 4)};
  t.offset = {random.uniform(-2, 2), random.uniform(-2, 2)};
  t.clamp = random.below(3) == 0;
  if (random.below(4) == 0) t.gain = random.uniform(-1, 2), t.base = random.uniform(-0.2F, 0.5F);
  constexpr float ones[] = {0, 1};
  if (random.below(2) == 0) t.channel = {ones[random.below(2)], 0, 0, ones[random.below(2)]};
  return t;
}

inline Material any_textured_material(Random& random, std::uint32_t textures) {
  Material m = any_material(random);
  for (std::uint32_t* slot : {&m.ambient_texture, &m.diffuse_texture, &m.specular_texture,
                              &m.emission_texture, &m.opacity_texture, &m.bump_texture})
    if (random.below(2) == 0) *slot = random.below(textures);
  if (m.bump_texture != no_texture) m.bump_texture = 0; // an image
  m.bump_scale = random.uniform(-4, 4);
  m.bump_is_normal_map = random.below(2) == 0;
  m.vertex_colors = random.below(3) == 0;
  return m;
}

inline void add_textured(SceneBuilder& builder, const Mesh& mesh, std::uint32_t material, Random& random) {
  std::vector<Vec2> uvs;
  std::vector<Vec3> colors;
  const bool huge = random.below(12) == 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    uvs.emplace_back(random.uniform(-2, 2), random.uniform(-2, 2));
    if (huge) uvs.back() *= 1e30F;
    colors.push_back(any_colour(random, 1.5F));
  }
  if (random.below(6) == 0) uvs.clear();
  builder.add_mesh(mesh.positions, mesh.indices, material, {}, "mesh", uvs, colors);
}

} // namespace fastrt::test
