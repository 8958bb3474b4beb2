// SPDX-License-Identifier: Apache-2.0
// What a picture can tell besides its colours: arbitrary output values (AOVs) of the first surface that each
// pixel's centre sees.
#pragma once

#include <fastrt/column.hpp>
#include <fastrt/math.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fastrt {

enum class Aov : std::uint32_t {
  id,        // object
  primitive, // triangles first, then the other kinds
  material,
  depth,     // distance from the ray's origin, in the scene's unit; infinity where nothing is seen
  normal,    // shading normal, unit, on the viewer's side
  position,  // in world space
  uv,        // texture coordinates where the mesh has them, otherwise the surface's own
  albedo,    // Kd
  shadow,    // mean over the lights that cast shadows: 1 where the light arrives, 0 in shadow or turned away
  recursion, // bounces of the longest path that was followed
  cost,      // rays that were traced, shadow rays too
};
inline constexpr std::size_t aov_count = 11;

struct AovInfo {
  const char* name;
  int channels;                             // 1, 2 or 3 values a pixel
  bool integer;                             // kept in AovPlane::ids, otherwise in AovPlane::values
  std::array<const char*, 3> channel_names; // as files name them
};
const AovInfo& aov_info(Aov aov) noexcept;
// Empty for a name that is none.
std::optional<Aov> aov_named(std::string_view name) noexcept;

// One AOV of a frame: `channels` values a pixel, rows from the top. Of `values` and `ids` one is empty. Where
// nothing is seen: -1 for id, primitive and material; infinity for depth; 0 for the other surface values;
// recursion and cost are never less than 0 and 1.
struct AovPlane {
  Aov aov;
  Column<float> values;
  Column<std::int32_t> ids;
};

// The colour that stands for an object in scene signatures, as sRGB codes 0..255: always the same for an id,
// never black, another one for each of the first 1.8 million, and far from the others' for the first 448.
std::array<std::uint8_t, 3> signature_color(std::uint32_t object) noexcept;

} // namespace fastrt
