// SPDX-License-Identifier: Apache-2.0
// Which points of lights with a size are asked, and how strong lights that vary are (docs/numerics.md,
// "Shading").
#pragma once

#include "src/film/light_sampling.hpp"
#include "src/kernels/vec3.hpp"
#include "src/simd/shared_math.hpp"
#include "src/trace/surface_lanes.hpp"
#include "src/trace/tile_places.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

FASTRT_INLINE PathV load_position(const LightRow& light, const LightBatch& seen, int i) {
  return light.shape != 0 ? load3<PathF>(seen.position_x + i, seen.position_y + i, seen.position_z + i)
                          : broadcast3<PathF>(light.position);
}

// Who asks light k for ray i of the batch.
FASTRT_INLINE LightQuestion question_of(const TileJob& job, const PathBatch& rays, std::uint32_t k, int i,
                                        const TileScratch& scratch) {
  const int row = rays.pixel[i];
  const bool mixed = scratch.row_count != 0;
  const int pixel = mixed ? scratch.row_places[row] : row;
  const int sample = mixed ? scratch.row_samples[row] : scratch.sample;
  return {static_cast<std::uint32_t>(picture_x(job, pixel)),
          static_cast<std::uint32_t>(picture_y(job, pixel)),
          static_cast<std::uint32_t>(sample),
          static_cast<std::uint32_t>(rays.depth),
          k,
          job.seed};
}

// A point of a mesh, into row i.
FASTRT_INLINE void place_on_mesh(const LightRow& light, const MeshPlace& place, int i, LightBatch& out) {
  const EmitterRow& triangle = light.emitters[place.triangle];
  float* const positions[3] = {out.position_x, out.position_y, out.position_z};
  float* const normals[3] = {out.normal_x, out.normal_y, out.normal_z};
  for (int axis = 0; axis < 3; ++axis) {
    positions[axis][i] = (triangle.corners[0][axis] * place.a + triangle.corners[1][axis] * place.b) +
                         triangle.corners[2][axis] * place.c;
    normals[axis][i] = triangle.normal[axis];
  }
}

// The points of a light with a size that sample `index` asks.
static void place_light(const TileJob& job, const PathBatch& rays, std::uint32_t k, int index,
                        const TileScratch& scratch, LightBatch& out) noexcept {
  const LightRow& light = job.scene->shading.lights[k];
  const auto shape = static_cast<LightShape>(light.shape);
  const auto at = static_cast<std::uint32_t>(index), count = static_cast<std::uint32_t>(job.light_samples);
  for (int i = 0; i < rays.count; ++i) {
    const LightQuestion question = question_of(job, rays, k, i, scratch);
    if (shape == LightShape::mesh) {
      place_on_mesh(light, mesh_place(light.emitter_begin, light.emitter_count, question, at, count), i, out);
      continue;
    }
    const LightPlace place = light_place(shape, question, at, count);
    float* const out_axes[3] = {out.position_x, out.position_y, out.position_z};
    for (int axis = 0; axis < 3; ++axis)
      out_axes[axis][i] =
          ((light.position[axis] + light.half_axes[0][axis] * place.x) + light.half_axes[1][axis] * place.y) +
          light.half_axes[2][axis] * place.z;
  }
}

// How strong a mesh is at rays i ..; turns its normals to their side.
FASTRT_INLINE void mesh_strength(const LightRow& light, const PathV& way, const PathV& to_light, float share,
                                 int i, LightBatch& out) {
  const PathV normal = load3<PathF>(out.normal_x + i, out.normal_y + i, out.normal_z + i);
  const PathF x = dot(normal, to_light);
  const PathF strength = ((abs(x) * PathF(light.area_over_pi)) / dot(way, way)) * PathF(share);
  strength.store_aligned(out.strength + i);
  store3(select(x > PathF(0.0F), negate(normal), normal), out.normal_x + i, out.normal_y + i,
         out.normal_z + i);
}

// How strong a light that varies is at rays i ..; returns the lanes that lie in its cone.
FASTRT_INLINE std::uint32_t light_strength(const LightRow& light, const PathV& way, const PathV& to_light,
                                           float share, int i, LightBatch& out) {
  const PathF zero(0.0F), one(1.0F);
  const PathF d = sqrt(dot(way, way));
  PathF strength = one / (PathF(light.constant) + d * (PathF(light.linear) + PathF(light.quadratic) * d));
  std::uint32_t bits = ~0U;
  if (light.spot != 0) {
    const PathF x = dot(negate(to_light), broadcast3<PathF>(light.axis));
    bits = to_bits(x > PathF(light.rim));
    const PathF y = min((x - PathF(light.rim)) * PathF(light.inverse_width), one);
    PathF soft = (y * y) * (PathF(3.0F) - PathF(2.0F) * y);
    if (light.exponent != 0.0F) {
      const PathF power = shared_pow<BatchOps<widest>>(x, PathF(light.exponent));
      soft = soft * simd::select(x > zero, power, zero);
    }
    strength = strength * soft;
  }
  if (light.shape != 0) strength = strength * PathF(share);
  strength.store_aligned(out.strength + i);
  return bits;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
