// SPDX-License-Identifier: Apache-2.0
// Photons as they leave a light (docs/numerics.md, "Photons").
#pragma once

#include "src/film/photon_sampling.hpp"
#include "src/simd/shared_math.hpp"
#include "src/trace/lighting.hpp"
#include "src/trace/photon_job.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// What a spot sends into a direction whose cosine to its axis is x.
FASTRT_INLINE float spot_profile(const LightRow& light, float x) {
  if (!(x > light.rim)) return 0.0F;
  const float rise = (x - light.rim) * light.inverse_width;
  const float y = rise < 1.0F ? rise : 1.0F;
  const float soft = (y * y) * (3.0F - 2.0F * y);
  if (light.exponent == 0.0F) return soft;
  return soft * (x > 0.0F ? shared_pow<ScalarOps>(x, light.exponent) : 0.0F);
}

FASTRT_INLINE void start_parallel(const EmissionView& from, const SampleOffset& place, int i,
                                  PhotonBatch& rays) {
  const float x = place.x * from.half_side, y = place.y * from.half_side;
  rays.origin_x[i] = (from.middle[0] + from.u[0] * x) + from.v[0] * y;
  rays.origin_y[i] = (from.middle[1] + from.u[1] * x) + from.v[1] * y;
  rays.origin_z[i] = (from.middle[2] + from.u[2] * x) + from.v[2] * y;
  rays.dir_x[i] = from.w[0];
  rays.dir_y[i] = from.w[1];
  rays.dir_z[i] = from.w[2];
  rays.strength[i] = 1.0F;
}

FASTRT_INLINE void start_at_point(const PhotonJob& job, const LightRow& light, const SampleOffset& place,
                                  int i, PhotonBatch& rays) {
  const EmissionView& from = job.emission;
  float origin[3] = {light.position[0], light.position[1], light.position[2]};
  if (light.shape != 0) {
    const LightPlace start =
        photon_start(static_cast<LightShape>(light.shape), rays.index[i], from.light, job.seed);
    for (int axis = 0; axis < 3; ++axis)
      origin[axis] =
          ((light.position[axis] + light.half_axes[0][axis] * start.x) + light.half_axes[1][axis] * start.y) +
          light.half_axes[2][axis] * start.z;
  }
  const LightPlace way = cap_direction(place, from.cap_height);
  rays.origin_x[i] = origin[0];
  rays.origin_y[i] = origin[1];
  rays.origin_z[i] = origin[2];
  rays.dir_x[i] = (from.u[0] * way.x + from.v[0] * way.y) + from.w[0] * way.z;
  rays.dir_y[i] = (from.u[1] * way.x + from.v[1] * way.y) + from.w[1] * way.z;
  rays.dir_z[i] = (from.u[2] * way.x + from.v[2] * way.y) + from.w[2] * way.z;
  const float cosine =
      (rays.dir_x[i] * light.axis[0] + rays.dir_y[i] * light.axis[1]) + rays.dir_z[i] * light.axis[2];
  rays.strength[i] = light.spot != 0 ? spot_profile(light, cosine) : 1.0F;
}

// Off one of a mesh's triangles, to either side.
FASTRT_INLINE void start_on_mesh(const PhotonJob& job, const LightRow& light, const SampleOffset& place,
                                 int i, PhotonBatch& rays) {
  const MeshPlace start = photon_mesh_start(shares_of(light), rays.index[i], job.emission.light, job.seed);
  const EmitterRow& triangle = light.emitters[start.triangle];
  const float* const n = triangle.normal;
  const LightPlace way = matt_direction(place);
  const float side = __builtin_copysignf(1.0F, way.z), offset = light.largest_coordinate * offset_share;
  const float sign = __builtin_copysignf(1.0F, n[2]);
  const float a = -(1.0F / (sign + n[2])), b = (n[0] * n[1]) * a;
  const float u[3] = {1.0F + (sign * (n[0] * n[0])) * a, sign * b, -(sign * n[0])};
  const float v[3] = {b, sign + (n[1] * n[1]) * a, -n[1]};
  float* const origins[3] = {rays.origin_x, rays.origin_y, rays.origin_z};
  float* const directions[3] = {rays.dir_x, rays.dir_y, rays.dir_z};
  for (int axis = 0; axis < 3; ++axis) {
    const float point = (triangle.corners[0][axis] * start.a + triangle.corners[1][axis] * start.b) +
                        triangle.corners[2][axis] * start.c;
    origins[axis][i] = point + (side * n[axis]) * offset;
    directions[axis][i] = (u[axis] * way.x + v[axis] * way.y) + n[axis] * way.z;
  }
  rays.strength[i] = 1.0F;
}

// Photons first .. first + count - 1 of the job's light.
static void emit_photons(const PhotonJob& job, std::uint32_t first, int count, PhotonBatch& rays) noexcept {
  const EmissionView& from = job.emission;
  const LightRow& light = job.scene->shading.lights[from.light];
  for (int i = 0; i < count; ++i) {
    rays.index[i] = first + static_cast<std::uint32_t>(i);
    rays.key[i] = photon_key(rays.index[i], from.light, job.seed);
    const SampleOffset place =
        photon_place(rays.index[i], from.count, from.cells, from.cell_count, rays.key[i]);
    if (light.directional != 0)
      start_parallel(from, place, i, rays);
    else if (light.shape == static_cast<std::uint32_t>(LightShape::mesh))
      start_on_mesh(job, light, place, i, rays);
    else
      start_at_point(job, light, place, i, rays);
    rays.t_min[i] = 0.0F;
    rays.t_max[i] = __builtin_inff();
    rays.exclude[i] = -1;
    rays.weight_r[i] = rays.weight_g[i] = rays.weight_b[i] = 1.0F;
    rays.width[i] = 0.0F;
    rays.length[i] = 0.0F;
    rays.bent[i] = 0;
    for (int k = 0; k < max_media; ++k) rays.media[k][i] = light.media[k];
  }
  rays.count = count;
  rays.depth = 0;
  rays.scattered = false;
  rays.shape = shadow_shape(light, 0); // as shadow rays that come from it
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
