// SPDX-License-Identifier: Apache-2.0
// Where photons leave a light and where they bounce to: functions of (photon, light, seed, the way so far)
// alone. Integers until the last steps, and those are additions, multiplications, divisions and square roots,
// so that every path gets the same bits.
#pragma once

#include "src/film/light_sampling.hpp"

namespace fastrt {

// The square of a light's directions or starting places, cut into cells; only some of them send photons.
inline constexpr std::uint32_t emission_bits = 6;
inline constexpr std::uint32_t emission_side = 1U << emission_bits; // cells along a side

// What photons bring to a pixel is added up in whole numbers, so that their order does not matter: in units
// of 2^-16 of what one photon may bring. More than film_most at once is cut off: a surface right before the
// eye. A pixel's sum has room for 2^47 over the number of photons in all: a hundred thousand times white for
// the most photons there may be.
inline constexpr float film_scale = 65536.0F;
inline constexpr float film_most = 1073741824.0F;

// The cosine between normals below which a photon of a caustic belongs to another surface.
inline constexpr float same_surface = 0.5F;

// The radii that light is averaged over, each half the one before.
inline constexpr int photon_radii = 12;

// Around a point photon i is added to sum i modulo this, so that as many are added at once.
inline constexpr std::uint32_t photon_sums = 16;

// Every second bit, from the lowest on, moved together.
[[gnu::always_inline]] static inline std::uint32_t even_bits(std::uint32_t x) {
  x &= 0x55555555U;
  x = (x | x >> 1U) & 0x33333333U;
  x = (x | x >> 2U) & 0x0F0F0F0FU;
  x = (x | x >> 4U) & 0x00FF00FFU;
  return (x | x >> 8U) & 0x0000FFFFU;
}

// What a photon's random numbers are made from.
[[gnu::always_inline]] static inline std::uint32_t photon_key(std::uint32_t index, std::uint32_t light,
                                                              std::uint32_t seed) {
  return hash32(index + hash32(light + hash32(seed + 0x5851F42DU)));
}

// The ways on from a surface. Each has random numbers of its own.
enum class PhotonTurn : std::uint32_t { reflected = 1, refracted = 2, scattered = 3 };
[[gnu::always_inline]] static inline std::uint32_t next_photon_key(std::uint32_t key, PhotonTurn turn) {
  return hash32(key + static_cast<std::uint32_t>(turn) * 0x9E3779B9U);
}

// Place of photon `index` of `count` on the square -1 .. 1: each has an equal piece of the active cells to
// itself, in the order of Morton's curve, and lies anywhere in it. So photons are spread evenly, and those
// with neighbouring indices are neighbours. cells: numbers of the active ones on the curve, ascending; at
// most 2^12 of them, and count at most 2^30.
[[gnu::always_inline]] static inline SampleOffset photon_place(std::uint32_t index, std::uint32_t count,
                                                               const std::uint16_t* cells,
                                                               std::uint32_t cell_count, std::uint32_t key) {
  const std::uint32_t piece = hash32(key + 1U);
  const std::uint32_t rest = hash32(key + 2U);
  const std::uint64_t fine = (static_cast<std::uint64_t>(index) << 20U) | (piece >> 12U);
  const std::uint64_t at = fine * cell_count / count; // in 2^-20 of a cell
  const std::uint32_t code =
      static_cast<std::uint32_t>(cells[at >> 20U]) << 20U | static_cast<std::uint32_t>(at & 0xFFFFFU);
  // Bits 20 .. 31 of the code are the cell's, the lower ones lead into it; below them come random bits.
  const std::uint32_t a = even_bits(code) << 8U | (rest & 0xFFU);
  const std::uint32_t b = even_bits(code >> 1U) << 8U | (rest >> 24U);
  return {static_cast<float>(static_cast<std::int32_t>(a)) * 0x1p-23F - 1.0F,
          static_cast<float>(static_cast<std::int32_t>(b)) * 0x1p-23F - 1.0F};
}

// A place on the square as a direction around the z axis, areas to solid angles: within the cap whose height
// is h (2: the whole sphere).
[[gnu::always_inline]] static inline LightPlace cap_direction(const SampleOffset& place, float h) {
  const SampleOffset disk = disk_point(place.x, place.y);
  const float hr2 = h * (disk.x * disk.x + disk.y * disk.y);
  const float square = h * (2.0F - hr2);
  const float scale = __builtin_sqrtf(square > 0.0F ? square : 0.0F);
  return {disk.x * scale, disk.y * scale, 1.0F - hr2};
}

// A place on the unit disk as a direction around the z axis, as likely as its cosine to it.
[[gnu::always_inline]] static inline LightPlace above_disk(const SampleOffset& disk) {
  const float left = 1.0F - (disk.x * disk.x + disk.y * disk.y);
  return {disk.x, disk.y, __builtin_sqrtf(left > 0.0F ? left : 0.0F)};
}

// A direction around the z axis, as likely as its cosine to it.
[[gnu::always_inline]] static inline LightPlace cosine_direction(std::uint32_t key) {
  const auto number = [](std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int32_t>(bits >> 8U)) * 0x1p-23F - 1.0F;
  };
  return above_disk(disk_point(number(hash32(key + 3U)), number(hash32(key + 4U))));
}

// A place on the square as a direction from a matt surface whose normal is the z axis: to either side, which
// the sign bit of z tells, as likely as the cosine. Each side has half of the square.
[[gnu::always_inline]] static inline LightPlace matt_direction(const SampleOffset& place) {
  const float side = place.x < 0.0F ? -1.0F : 1.0F;
  const LightPlace above = above_disk(disk_point(2.0F * place.x - side, place.y));
  return {above.x, above.y, side * above.z};
}

// Who asks a light with a size for the start of photon `index`.
[[gnu::always_inline]] static inline LightQuestion start_question(std::uint32_t index, std::uint32_t light,
                                                                  std::uint32_t seed) {
  return {index, 0x70686F74U, 0, 0, light, seed};
}

// Where on a light with a size that is no mesh photon `index` starts, in units of its half axes.
[[gnu::always_inline]] static inline LightPlace photon_start(LightShape shape, std::uint32_t index,
                                                             std::uint32_t light, std::uint32_t seed) {
  return light_place(shape, light_bits(start_question(index, light, seed), 0, 1));
}

// Where on a mesh.
[[gnu::always_inline]] static inline MeshPlace photon_mesh_start(const MeshShares& mesh, std::uint32_t index,
                                                                 std::uint32_t light, std::uint32_t seed) {
  return mesh_place(mesh, light_bits(start_question(index, light, seed), 0, 1));
}

} // namespace fastrt
