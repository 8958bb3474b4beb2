// SPDX-License-Identifier: Apache-2.0
// Which points of lights with a size are asked, and how strong lights that vary are (docs/numerics.md,
// "Shading").
#pragma once

#include "src/kernels/vec3.hpp"
#include "src/simd/shared_math.hpp"
#include "src/trace/mesh_points.hpp"
#include "src/trace/tile_places.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

FASTRT_INLINE PathV load_position(const LightRow& light, const LightBatch& seen, int i) {
  return light.shape != 0 ? load3<PathF>(seen.position_x + i, seen.position_y + i, seen.position_z + i)
                          : broadcast3<PathF>(light.position);
}

// Which pixels' samples the rays of a batch belong to.
struct Askers {
  alignas(64) std::uint32_t x[batch_size], y[batch_size], sample[batch_size];
};

FASTRT_INLINE void find_askers(const TileJob& job, const PathBatch& rays, const TileScratch& scratch,
                               Askers& out) {
  const bool mixed = scratch.row_count != 0;
  for (int i = 0; i < rays.count; ++i) {
    const int row = rays.pixel[i];
    const int pixel = mixed ? scratch.row_places[row] : row;
    out.x[i] = static_cast<std::uint32_t>(picture_x(job, pixel));
    out.y[i] = static_cast<std::uint32_t>(picture_y(job, pixel));
    out.sample[i] = static_cast<std::uint32_t>(mixed ? scratch.row_samples[row] : scratch.sample);
  }
}

// What shifts the samples of light k, ray by ray, and numbers them: the same for all of them. (A loop that
// compilers make SIMD of; rays that only fill a register ask as well.)
static void find_light_keys(const TileJob& job, const PathBatch& rays, std::uint32_t k,
                            const TileScratch& scratch, LightBatch& out) noexcept {
  Askers askers{};
  find_askers(job, rays, scratch, askers);
  const auto depth = static_cast<std::uint32_t>(rays.depth), seed = job.seed,
             count = static_cast<std::uint32_t>(job.light_samples);
  const int end = (rays.count + widest - 1) / widest * widest;
  for (int i = 0; i < end; ++i) {
    const LightBits key = light_key({askers.x[i], askers.y[i], askers.sample[i], depth, k, seed});
    out.key_u[i] = key.u;
    out.key_v[i] = key.v;
    out.first[i] = first_stratum(key.u, count);
  }
}

// One sample of each of the first `count` rays, on a light of a shape that is not a mesh. (A loop that
// compilers make SIMD of.)
template <LightShape shape>
static void place_on_shape(const LightRow& light, const SampleNumber& number, int count,
                           LightBatch& out) noexcept {
  const LightRow row = light; // which no store to `out` can change
  for (int i = 0; i < count; ++i) {
    const LightPlace place = light_place(shape, bits_of(number, out, i));
    const auto at = [&](int axis) {
      return ((row.position[axis] + row.half_axes[0][axis] * place.x) + row.half_axes[1][axis] * place.y) +
             row.half_axes[2][axis] * place.z;
    };
    out.position_x[i] = at(0);
    out.position_y[i] = at(1);
    out.position_z[i] = at(2);
  }
}

// The points of a light with a size that sample `index` of `count` asks, after find_light_keys().
static void place_light(const LightRow& light, int index, int count, int rays, LightBatch& out) noexcept {
  const SampleNumber number{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(count)};
  switch (static_cast<LightShape>(light.shape)) {
  case LightShape::mesh:
    return place_on_mesh(light, number, rays, out);
  case LightShape::rectangle:
    return place_on_shape<LightShape::rectangle>(light, number, rays, out);
  case LightShape::disk:
    return place_on_shape<LightShape::disk>(light, number, rays, out);
  default:
    return place_on_shape<LightShape::sphere>(light, number, rays, out);
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
