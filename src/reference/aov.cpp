// SPDX-License-Identifier: Apache-2.0
// AOVs: docs/numerics.md, "AOVs".
#include "src/reference/render.hpp"

namespace fastrt::reference {
namespace {

Vec2 texture_coordinates(const Scene& scene, const Hit& hit) {
  const Vec2 own{hit.u, hit.v};
  const auto primitive = static_cast<std::uint32_t>(hit.primitive);
  const TriangleColumns& triangles = scene.triangles();
  if (scene.kind(primitive) != PrimitiveKind::triangle || triangles.t0.empty()) return own;
  const std::uint32_t a = triangles.t0[primitive];
  const std::uint32_t b = triangles.t1[primitive];
  const std::uint32_t c = triangles.t2[primitive];
  if (a == no_index || b == no_index || c == no_index) return own;
  const Columns2& uvs = scene.desc().uvs;
  const float w = (1.0F - hit.u) - hit.v;
  return (w * Vec2(uvs.x[a], uvs.y[a]) + hit.u * Vec2(uvs.x[b], uvs.y[b])) + hit.v * Vec2(uvs.x[c], uvs.y[c]);
}

// The mean over the lights that cast shadows; 1 where there is none.
Vec3 shadow_of(const Scene& scene, const Sight& sight) {
  int count = 0;
  for (const Light& light : scene.lights()) count += light.casts_shadows ? 1 : 0;
  return count == 0 ? Vec3(1.0F) : sight.light_left * (1.0F / static_cast<float>(count));
}

std::int32_t id_of(const Scene& scene, const Sight& sight, Aov aov) {
  const auto primitive = static_cast<std::uint32_t>(sight.hit.primitive);
  if (aov == Aov::id) return static_cast<std::int32_t>(scene.object_of(primitive, sight.hit.instance));
  if (aov == Aov::material) return static_cast<std::int32_t>(sight.surface.material);
  return sight.hit.primitive;
}

// As many of its numbers count as the AOV has channels.
Vec3 value_of(const Scene& scene, const Sight& sight, Aov aov) {
  switch (aov) {
  case Aov::depth:
    return Vec3(sight.surface.distance);
  case Aov::normal:
    return sight.surface.shading_normal;
  case Aov::position:
    return sight.surface.point;
  case Aov::uv:
    return {texture_coordinates(scene, sight.hit), 0.0F};
  case Aov::albedo:
    return finish_of(scene.materials()[sight.surface.material], sight.surface).diffuse;
  default:
    return shadow_of(scene, sight);
  }
}

} // namespace

void record_aovs(const Scene& scene, const Sight& sight, std::uint64_t ray_count, std::size_t pixel,
                 Frame& frame) {
  for (AovPlane& plane : frame.aovs) {
    if (plane.aov == Aov::recursion) {
      plane.ids[pixel] = sight.deepest;
    } else if (plane.aov == Aov::cost) {
      plane.ids[pixel] = static_cast<std::int32_t>(ray_count);
    } else if (!sight.hit.found()) {
      continue;
    } else if (aov_info(plane.aov).integer) {
      plane.ids[pixel] = id_of(scene, sight, plane.aov);
    } else {
      const Vec3 value = value_of(scene, sight, plane.aov);
      const auto channels = static_cast<std::size_t>(aov_info(plane.aov).channels);
      for (std::size_t c = 0; c < channels; ++c)
        plane.values[channels * pixel + c] = value[static_cast<int>(c)];
    }
  }
}

} // namespace fastrt::reference
