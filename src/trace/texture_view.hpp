// SPDX-License-Identifier: Apache-2.0
// Textures as the kernels see them: plain pointers and rows, made once per tracer (docs/numerics.md,
// "Textures").
#pragma once

#include <cstdint>

namespace fastrt {

// A mip level: four bytes or four floats a pixel, rows from the top; the other pointer is null.
struct TextureLevel {
  const std::uint8_t* bytes;
  const float* floats;
  std::int32_t width, height;
};

struct TextureRow {
  const TextureLevel* levels; // null: no image
  const float* decoded;       // of bytes: 256 values of colours, 256 of alpha
  std::uint32_t checker;      // without an image: else a gradient
  std::uint32_t planar, clamp;
  float plane_u[3], plane_v[3], plane_density; // |plane_u x plane_v|
  float scale[2], offset[2];
  float pixels; // of level 0 per unit of area of (u, v)
  float last_level;
  float gain, base;
  float channel[4];
  float color_a[4], color_b[4];
};

// The textures of a material, null where it has none, and what its hits need besides its row.
struct SurfaceTextures {
  const TextureRow *ambient, *diffuse, *specular, *emission, *opacity, *bump;
  std::uint32_t normal_map, vertex_colors;
  float bump_u, bump_v; // slope per step of 1 / width of level 0; of normal maps, factors
};

} // namespace fastrt
