// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>
#include <fastrt/texture.hpp>

#include <cstdint>
#include <string>

namespace fastrt {

// Which vector the highlight is measured against: the light's mirror direction (the lecture's Phong) or the
// half vector (Blinn, what the MTL specification means).
enum class SpecularModel : std::uint32_t { phong, blinn };

// How the mirror coefficient depends on the angle: not at all; Schlick's approximation with Kr as its value
// at normal incidence; or the Fresnel equations of a dielectric, Kr scaled by F and what passes through by 1
// - F.
enum class Fresnel : std::uint32_t { none, schlick, dielectric };

// How a surface answers light; the shading equation is in docs/numerics.md. Colours are linear RGB, 0..1 by
// habit.
struct Material {
  std::string name;
  Vec3 ambient{0.8F};  // Ka
  Vec3 diffuse{0.8F};  // Kd
  Vec3 specular{0.0F}; // Ks
  Vec3 emission{0.0F}; // Ke
  float shininess = 1; // Phong exponent, at least 1
  SpecularModel specular_model = SpecularModel::blinn;
  Vec3 mirror{0.0F}; // Kr: weight of the reflected ray
  Fresnel fresnel = Fresnel::none;
  float opacity = 1;       // g: 1 is opaque, 0 shows only what passes through
  Vec3 transmission{1.0F}; // Kt: colour of what passes through, counted with 1 - g
  float ior = 1;           // index of refraction, > 0
  Vec3 absorption{0.0F};   // sigma, per unit of length inside: light fades by exp(-sigma * distance)
  bool thin = false;       // light passes straight through; the inside is no medium
  bool unlit = false;      // shows Ke + Kd, no lights, no secondary rays

  // What multiplies the terms above, point by point: indices of SceneDesc::textures, or no_texture.
  std::uint32_t ambient_texture = no_texture, diffuse_texture = no_texture, specular_texture = no_texture;
  std::uint32_t emission_texture = no_texture, opacity_texture = no_texture;
  // Turns the shading normal: a height, or with bump_is_normal_map a normal (x along u, y along v, 0.5 being
  // 0). bump_scale: the height of 1 in pixels of the image; for normal maps it multiplies x and y.
  std::uint32_t bump_texture = no_texture;
  float bump_scale = 1;
  bool bump_is_normal_map = false;
  bool vertex_colors = false; // SceneDesc::colors multiply Ka and Kd
};

} // namespace fastrt
