// SPDX-License-Identifier: Apache-2.0
// Where on their surfaces hits lie, as far as textures ask for it: hit by hit, since each has corners of its
// own (docs/numerics.md, "Textures").
#pragma once

#include "src/trace/shape_weights.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

using Row3 = V3<float>;
using Rgba = Floats<4>;

FASTRT_INLINE Row3 row3(const float* x, const float* y, const float* z, std::uint32_t i) {
  return {x[i], y[i], z[i]};
}

// One hit of a ray. Triangles alone have weights, coordinates and edges.
struct HitSite {
  float at_u, at_v;
  float density; // area of (u, v) per area of the surface
  float w, u, v;
  std::uint32_t corner[3];
  float du1, dv1, du2, dv2; // (u, v) along the edges from A to B and to C
  Row3 edge1, edge2;
  bool is_triangle, has_uv;
};

// Hit i of the batch.
static HitSite find_site(const ShadingView& scene, const RayBatch& rays, const HitBatch& hits,
                         int i) noexcept {
  HitSite site{};
  const float t = hits.t[i];
  const std::int32_t primitive = shown_primitive(scene.shapes, hits, i);
  const InstanceRow* const instance = instance_of(scene.shapes, hits.primitive[i]);
  Row3 origin = row3(rays.origin_x, rays.origin_y, rays.origin_z, static_cast<std::uint32_t>(i));
  Row3 dir = row3(rays.dir_x, rays.dir_y, rays.dir_z, static_cast<std::uint32_t>(i));
  if (instance != nullptr) {
    origin = map_point(instance->to_object, origin);
    dir = map_vector(instance->to_object, dir);
  }
  const auto id = static_cast<std::uint32_t>(primitive);
  site.is_triangle = id < scene.triangle_count;
  if (!site.is_triangle) {
    const ShapeWeights weights = shape_weights(scene, primitive, origin, dir, t);
    site.at_u = weights.u;
    site.at_v = weights.v;
    return site;
  }
  const std::uint32_t corner[3] = {scene.v0[id], scene.v1[id], scene.v2[id]};
  Row3 vertex[3];
  V3<Rgba> relative[3];
  for (int k = 0; k < 3; ++k) {
    site.corner[k] = corner[k];
    vertex[k] = row3(scene.position_x, scene.position_y, scene.position_z, corner[k]);
    const Row3 r = vertex[k] - origin;
    relative[k] = broadcast3<Rgba>(r.x, r.y, r.z);
  }
  const auto weights = triangle_weights(set_up_triangle(relative[0], relative[1], relative[2]),
                                        broadcast3<Rgba>(dir.x, dir.y, dir.z));
  site.u = weights.u.get(0);
  site.v = weights.v.get(0);
  site.w = (1.0F - site.u) - site.v;
  if (scene.t0 == nullptr) return site;
  const std::uint32_t uv[3] = {scene.t0[id], scene.t1[id], scene.t2[id]};
  if (uv[0] == no_row || uv[1] == no_row || uv[2] == no_row) return site;
  const float *tu = scene.uv_x, *tv = scene.uv_y;
  site.has_uv = true;
  site.at_u = (site.w * tu[uv[0]] + site.u * tu[uv[1]]) + site.v * tu[uv[2]];
  site.at_v = (site.w * tv[uv[0]] + site.u * tv[uv[1]]) + site.v * tv[uv[2]];
  site.du1 = tu[uv[1]] - tu[uv[0]];
  site.dv1 = tv[uv[1]] - tv[uv[0]];
  site.du2 = tu[uv[2]] - tu[uv[0]];
  site.dv2 = tv[uv[2]] - tv[uv[0]];
  site.edge1 = vertex[1] - vertex[0];
  site.edge2 = vertex[2] - vertex[0];
  if (instance != nullptr) {
    site.edge1 = map_vector(instance->to_world, site.edge1);
    site.edge2 = map_vector(instance->to_world, site.edge2);
  }
  const Row3 normal = cross(site.edge1, site.edge2);
  site.density =
      __builtin_fabsf(site.du1 * site.dv2 - site.du2 * site.dv1) / __builtin_sqrtf(dot(normal, normal));
  return site;
}

// The hits in the lanes `bits` of rays i .., and what of them is asked lane by lane.
struct HitSites {
  HitSite hit[widest];
  alignas(64) float u[widest], v[widest], density[widest]; // 0 in the other lanes
};

FASTRT_INLINE void find_sites(const ShadingView& scene, const RayBatch& rays, const HitBatch& hits,
                              std::uint32_t bits, int i, HitSites& out) {
  const PathF zero(0.0F);
  zero.store_aligned(out.u);
  zero.store_aligned(out.v);
  zero.store_aligned(out.density);
  for (; bits != 0; bits &= bits - 1) {
    const int k = __builtin_ctz(bits);
    HitSite& hit = out.hit[k];
    hit = find_site(scene, rays, hits, i + k);
    out.u[k] = hit.at_u;
    out.v[k] = hit.at_v;
    out.density[k] = hit.density;
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
