// SPDX-License-Identifier: Apache-2.0
// Where the samples of a light with a size lie on it: a function of (pixel, sample, bounce, light, index,
// seed) alone. Integers until the last steps, and those are additions, multiplications, divisions and square
// roots, so that every path gets the same bits.
#pragma once

#include "src/film/sampling.hpp"

namespace fastrt {

enum class LightShape : std::uint32_t { none, rectangle, disk, sphere, mesh };

// Which point of a picture asks.
struct LightQuestion {
  std::uint32_t x, y;   // pixel
  std::uint32_t sample; // of the pixel
  std::uint32_t depth;  // bounces of the ray
  std::uint32_t light;
  std::uint32_t seed;
};

// In units of the light's three half axes.
struct LightPlace {
  float x, y, z;
};

// A point of the unit square, in units of 2^-32.
struct LightBits {
  std::uint32_t u, v;
};

// What shifts the samples of a question, all alike.
[[gnu::always_inline]] static inline LightBits light_key(const LightQuestion& question) {
  const std::uint32_t at = hash32(question.x + hash32(question.y + hash32(question.sample)));
  const std::uint32_t key =
      hash32(at + hash32(question.light + hash32(question.depth + hash32(question.seed))));
  return {key, hash32(key)};
}

// Point `index` of `count` of a Hammersley set, so that every row and column of a count-fold grid holds one.
[[gnu::always_inline]] static inline LightBits hammersley_point(std::uint32_t index, std::uint32_t count) {
  const auto stratum = static_cast<std::uint32_t>((std::uint64_t{1} << 32U) / count);
  return {index * stratum, reverse_bits(index)};
}

// Which stratum of `count` the key shifts the first of them into.
[[gnu::always_inline]] static inline std::uint32_t first_stratum(std::uint32_t key, std::uint32_t count) {
  return static_cast<std::uint32_t>((static_cast<std::uint64_t>(key) * count) >> 32U);
}

// Sample `index`: the set's points are shifted at random (Cranley & Patterson 1976), and numbered by the
// strata that they come to lie in. So samples of one number lie near each other on the light, whoever asks.
[[gnu::always_inline]] static inline LightBits light_sample(std::uint32_t index, std::uint32_t count,
                                                            const LightBits& key, std::uint32_t first) {
  const std::uint32_t back = index - first; // below 0: from the other end
  const LightBits point = hammersley_point(index < first ? back + count : back, count);
  return {point.u + key.u, point.v + key.v};
}
[[gnu::always_inline]] static inline LightBits light_bits(const LightQuestion& question, std::uint32_t index,
                                                          std::uint32_t count) {
  const LightBits key = light_key(question);
  return light_sample(index, count, key, first_stratum(key.u, count));
}

// The place of a sample on a light of a shape that is not a mesh. (No branches but on the shape.)
[[gnu::always_inline]] static inline LightPlace light_place(LightShape shape, const LightBits& bits) {
  const float a = static_cast<float>(static_cast<std::int32_t>(bits.u >> 8U)) * 0x1p-23F - 1.0F;
  const float b = static_cast<float>(static_cast<std::int32_t>(bits.v >> 8U)) * 0x1p-23F - 1.0F;
  if (shape == LightShape::rectangle) return {a, b, 0.0F};
  const SampleOffset disk = disk_point(a, b);
  if (shape == LightShape::disk) return {disk.x, disk.y, 0.0F};
  // The disk to the sphere, areas to areas (Lambert's map).
  const float r2 = disk.x * disk.x + disk.y * disk.y;
  const float left = 1.0F - r2;
  const float scale = 2.0F * __builtin_sqrtf(pick(left > 0.0F, left, 0.0F));
  return {disk.x * scale, disk.y * scale, 1.0F - 2.0F * r2};
}

// A point of a mesh: one of its triangles, and the weights of the corners.
struct MeshPlace {
  std::uint32_t triangle;
  float a, b, c;
};

// How 2^32 numbers choose among a mesh's triangles: number i by those from begin[i] up to begin[i + 1].
// scale[i]: 2 divided by how many these are.
struct MeshShares {
  const std::uint32_t* begin;
  const float* scale;
  std::uint32_t count;
};

// The last triangle that begins at u or before. (Which half it is in can't be foreseen: no branch asks.)
[[gnu::always_inline]] static inline std::uint32_t choose_triangle(const MeshShares& mesh, std::uint32_t u) {
  std::uint32_t chosen = 0;
  for (std::uint32_t count = mesh.count; count > 1;) {
    const std::uint32_t half = count / 2;
    chosen += mesh.begin[chosen + half] <= u ? half : 0U;
    count -= half;
  }
  return chosen;
}

// The place of a sample on a mesh. What is left of the number that chose the triangle is spread out again and
// says where in it, so that strata of the mesh are strata of each triangle.
[[gnu::always_inline]] static inline MeshPlace mesh_place(const MeshShares& mesh, const LightBits& bits) {
  const std::uint32_t chosen = choose_triangle(mesh, bits.u);
  const std::uint32_t left = (bits.u - mesh.begin[chosen]) >> 1U;
  const float rest = static_cast<float>(static_cast<std::int32_t>(left)) * mesh.scale[chosen];
  const float root = __builtin_sqrtf(rest < 1.0F ? rest : 1.0F);
  const float along = static_cast<float>(static_cast<std::int32_t>(bits.v >> 8U)) * 0x1p-24F;
  return {chosen, 1.0F - root, root * (1.0F - along), root * along};
}

} // namespace fastrt
