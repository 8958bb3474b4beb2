// SPDX-License-Identifier: Apache-2.0
// Reflected and refracted rays: directions, weights, media (docs/numerics.md, "Secondary rays"). Rays that
// are worth tracing are appended to the child batches lane by lane, so that those are full.
#pragma once

#include "src/trace/lighting.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// What surrounds the rays of a packet before and after the surface, per lane.
struct MediaLanes {
  alignas(64) float ior_before[widest], ior_after[widest];
  std::int32_t after[max_media][widest];
};

FASTRT_INLINE void cross_surface(const ShadingView& scene, const PathBatch& rays, std::int32_t material,
                                 int i, int lane, MediaLanes& media) {
  std::int32_t list[max_media];
  for (int k = 0; k < max_media; ++k) list[k] = rays.media[k][i + lane];
  media.ior_before[lane] = list[0] < 0 ? 1.0F : scene.materials[list[0]].ior;
  cross_medium(material, list);
  for (int k = 0; k < max_media; ++k) media.after[k][lane] = list[k];
  media.ior_after[lane] = list[0] < 0 ? 1.0F : scene.materials[list[0]].ior;
}

// The weights and directions of the two rays that leave a surface; lanes whose weight is 0 have none.
struct SecondaryLanes {
  PathV mirror, mirror_weight, transmitted, transmitted_weight;
};

struct SurfaceAngles {
  PathV incident, normal, geometric, viewer; // dn, nr, ng, c
  PathF cosine;                              // cos_i
};

FASTRT_INLINE SurfaceAngles surface_angles(const SurfaceBatch& s, int i) {
  SurfaceAngles a;
  a.viewer = load_viewer(s, i);
  a.incident = negate(a.viewer);
  a.geometric = load_geometric(s, i);
  const PathV shading = load_shading(s, i);
  a.normal = select(dot(a.viewer, shading) <= PathF(0.0F), a.geometric, shading);
  a.cosine = dot(a.viewer, a.normal);
  return a;
}

FASTRT_INLINE PathV mirror_direction(const SurfaceAngles& a) {
  const PathF two(2.0F);
  const PathV mirrored = a.incident + a.normal * (two * a.cosine);
  const PathV safe = a.incident + a.geometric * (two * dot(a.viewer, a.geometric));
  return select(dot(mirrored, a.geometric) <= PathF(0.0F), safe, mirrored);
}

FASTRT_INLINE SecondaryLanes secondary_lanes(const MaterialRow& row, const SurfaceAngles& a,
                                             const PathV& transmit, const PathF& ior_before,
                                             const PathF& ior_after) {
  const PathF zero(0.0F), one(1.0F);
  SecondaryLanes out;
  out.mirror = mirror_direction(a);
  out.mirror_weight = broadcast3<PathF>(row.mirror);
  out.transmitted = a.incident;
  out.transmitted_weight = transmit;
  const bool bends = is_medium(row);
  const PathF eta_i = bends ? ior_before : one;
  const PathF eta_t = bends ? ior_after : PathF(row.ior);
  const PathF eta = eta_i / eta_t;
  const PathF k = one - (eta * eta) * (one - a.cosine * a.cosine);
  const PathM total = k < zero;
  const PathF cos_t = sqrt(simd::select(total, zero, k));
  if (bends) {
    const PathV bent = a.incident * eta + a.normal * (eta * a.cosine - cos_t);
    out.transmitted = select(dot(bent, a.geometric) >= zero, a.incident, bent);
  }
  if (row.fresnel == static_cast<std::uint32_t>(1)) {
    const PathF x = max(one - a.cosine, zero);
    const PathF x2 = x * x;
    const PathF x5 = (x2 * x2) * x;
    const PathV kr = out.mirror_weight;
    out.mirror_weight = kr + V3<PathF>{one - kr.x, one - kr.y, one - kr.z} * x5;
  } else if (row.fresnel == static_cast<std::uint32_t>(2)) {
    const PathF rs = (eta_i * a.cosine - eta_t * cos_t) / (eta_i * a.cosine + eta_t * cos_t);
    const PathF rp = (eta_t * a.cosine - eta_i * cos_t) / (eta_t * a.cosine + eta_i * cos_t);
    const PathF reflected = simd::select(total, one, PathF(0.5F) * (rs * rs + rp * rp));
    out.mirror_weight = out.mirror_weight * reflected;
    out.transmitted_weight = out.transmitted_weight * (one - reflected);
  }
  if (bends) {
    out.mirror_weight = select(total, out.mirror_weight + out.transmitted_weight, out.mirror_weight);
    out.transmitted_weight = select(total, broadcast3<PathF>(0.0F, 0.0F, 0.0F), out.transmitted_weight);
  }
  return out;
}

// (1 - g) * Kt.
FASTRT_INLINE PathV transmit_of(const MaterialRow& row, const SurfaceBatch& s, int i) {
  if (row.has_transmit == 0 || row.textures == nullptr) return broadcast3<PathF>(row.transmit);
  return broadcast3<PathF>(row.transmission) * (PathF(1.0F) - PathF::load_aligned(s.opacity + i));
}

// Columns of a PathBatch that not every scene needs.
struct KeptColumns {
  bool media, width, inner;
};

FASTRT_INLINE KeptColumns kept_columns(const ShadingView& scene) {
  return {scene.has_transmission != 0, scene.has_textures != 0, scene.shapes.instance_count != 0};
}

// One packet's worth of new rays, before the ones worth tracing are picked.
struct NewRays {
  alignas(64) float origin[3][widest], dir[3][widest], weight[3][widest];
};

FASTRT_INLINE void store_lanes(const PathV& v, float (*to)[widest]) { store3(v, to[0], to[1], to[2]); }

// Appends the lanes in `bits` to `out`. after: null where the media stay as they are.
FASTRT_INLINE void append_rays(const NewRays& rays, const PathBatch& parent, const SurfaceBatch& s,
                               const KeptColumns& keep, const MediaLanes* after, int i, std::uint32_t bits,
                               PathBatch& out) {
  int count = out.count;
  for (; bits != 0; bits &= bits - 1, ++count) {
    const int lane = __builtin_ctz(bits);
    out.origin_x[count] = rays.origin[0][lane];
    out.origin_y[count] = rays.origin[1][lane];
    out.origin_z[count] = rays.origin[2][lane];
    out.dir_x[count] = rays.dir[0][lane];
    out.dir_y[count] = rays.dir[1][lane];
    out.dir_z[count] = rays.dir[2][lane];
    out.weight_r[count] = rays.weight[0][lane];
    out.weight_g[count] = rays.weight[1][lane];
    out.weight_b[count] = rays.weight[2][lane];
    out.t_min[count] = 0.0F;
    out.t_max[count] = __builtin_inff();
    out.exclude[count] = s.planar[i + lane];
    out.pixel[count] = parent.pixel[i + lane];
    if (keep.inner) out.exclude_inner[count] = s.planar_inner[i + lane];
    if (keep.width) out.width[count] = s.width[i + lane];
    if (!keep.media) continue;
    for (int k = 0; k < max_media; ++k)
      out.media[k][count] = after != nullptr ? after->after[k][lane] : parent.media[k][i + lane];
  }
  out.count = count;
}

// Lanes whose weight is worth a ray.
FASTRT_INLINE std::uint32_t worth_tracing(const PathV& weight, float min_contribution) {
  const PathF most = max(weight.x, max(weight.y, weight.z));
  return to_bits((most > PathF(0.0F)) & (most >= PathF(min_contribution)));
}

// The rays that leave the surfaces of lanes i .. of one material.
FASTRT_INLINE void leave_surface(const TileJob& job, const PathBatch& rays, const SurfaceBatch& s,
                                 const MaterialRow& row, std::uint32_t bits, int i, PathBatch& reflected,
                                 PathBatch& refracted) {
  const KeptColumns keep = kept_columns(job.scene->shading);
  MediaLanes media{};
  const bool bends = is_medium(row);
  if (bends)
    for (std::uint32_t b = bits; b != 0; b &= b - 1) {
      const int lane = __builtin_ctz(b);
      cross_surface(job.scene->shading, rays, s.material[i + lane], i, lane, media);
    }
  const SurfaceAngles angles = surface_angles(s, i);
  const SecondaryLanes lanes =
      secondary_lanes(row, angles, transmit_of(row, s, i), PathF::load_aligned(media.ior_before),
                      PathF::load_aligned(media.ior_after));
  const PathV weight = load3<PathF>(rays.weight_r + i, rays.weight_g + i, rays.weight_b + i);
  const PathV point = load_point(s, i);
  const PathF offset = PathF::load_aligned(s.magnitude + i) * PathF(offset_share);
  NewRays next;
  const PathV mirror_weight = weight * lanes.mirror_weight;
  if (const std::uint32_t worth = worth_tracing(mirror_weight, job.min_contribution) & bits; worth != 0) {
    store_lanes(point + angles.geometric * offset, next.origin);
    store_lanes(lanes.mirror, next.dir);
    store_lanes(mirror_weight, next.weight);
    append_rays(next, rays, s, keep, nullptr, i, worth, reflected);
  }
  const PathV transmitted_weight = weight * lanes.transmitted_weight;
  if (const std::uint32_t worth = worth_tracing(transmitted_weight, job.min_contribution) & bits;
      worth != 0) {
    store_lanes(point + angles.geometric * negate(offset), next.origin);
    store_lanes(lanes.transmitted, next.dir);
    store_lanes(transmitted_weight, next.weight);
    append_rays(next, rays, s, keep, bends ? &media : nullptr, i, worth, refracted);
  }
}

// All rays that leave the surfaces of a batch.
static void make_secondary_rays(const TileJob& job, const PathBatch& rays, const TileScratch& scratch,
                                PathBatch& reflected, PathBatch& refracted) noexcept {
  const SurfaceBatch& s = scratch.surface;
  for (int i = 0; i < rays.count; i += widest)
    for_each_material(job.scene->shading, s.material + i, hit_bits(rays, scratch.hits, i),
                      [&](const MaterialRow& row, const PathM&, std::uint32_t bits) {
                        if ((row.has_mirror | row.has_transmit) != 0 && row.unlit == 0)
                          leave_surface(job, rays, s, row, bits, i, reflected, refracted);
                      });
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
