// SPDX-License-Identifier: Apache-2.0
// Reflected and refracted rays: directions, weights, media (docs/numerics.md, "Secondary rays"). Rays that
// are worth tracing are appended to the child batches side by side, so that those are full.
#pragma once

#include "src/simd/compress.hpp"
#include "src/trace/lighting.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// What surrounds the rays of a packet before and after the surface, per lane.
struct MediaLanes {
  PathF ior_before, ior_after;
  alignas(64) std::int32_t after[max_media][widest];
};

FASTRT_INLINE PathF ior_in(const ShadingView& scene, const PathI& media, std::uint32_t bits) {
  const std::uint32_t some = to_bits(simd::bool_cast(media >= PathI(0))) & bits;
  return simd::select(from_bits<widest>(some),
                      gather(&scene.materials->ior, media * PathI(material_words), some), PathF(1.0F));
}

// cross_medium for the lanes in `bits`, whose media are in `after` yet.
FASTRT_INLINE void cross_surface(const ShadingView& scene, std::int32_t material, std::uint32_t bits,
                                 MediaLanes& media) {
  const PathM mask = from_bits<widest>(bits);
  const PathI crossed(material), none(-1);
  PathI list[max_media];
  PathM held[max_media]; // there or further inside
  for (int k = 0; k < max_media; ++k) {
    list[k] = PathI::load_aligned(media.after[k]);
    held[k] = simd::bool_cast(list[k] == crossed);
    if (k != 0) held[k] = held[k] | held[k - 1];
  }
  const PathM leaves = held[max_media - 1];
  PathI first = none;
  for (int k = 0; k < max_media; ++k) {
    const PathI further_out = k + 1 < max_media ? list[k + 1] : none,
                further_in = k > 0 ? list[k - 1] : crossed;
    const PathI left = select_ints<PathF>(held[k], further_out, list[k]);
    const PathI now = select_ints<PathF>(mask, select_ints<PathF>(leaves, left, further_in), list[k]);
    now.store_aligned(media.after[k]);
    if (k == 0) first = now;
  }
  media.ior_before = simd::select(mask, ior_in(scene, list[0], bits), media.ior_before);
  media.ior_after = simd::select(mask, ior_in(scene, first, bits), media.ior_after);
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
  if (row.fresnel == fresnel_schlick) {
    const PathF x = max(one - a.cosine, zero);
    const PathF x2 = x * x;
    const PathF x5 = (x2 * x2) * x;
    const PathV kr = out.mirror_weight;
    out.mirror_weight = kr + V3<PathF>{one - kr.x, one - kr.y, one - kr.z} * x5;
  } else if (row.fresnel == fresnel_dielectric) {
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

// New rays of one register, and the lanes that have one.
struct NewRays {
  PathV origin, dir, weight;
  std::uint32_t bits;
};

FASTRT_INLINE void store_lanes(const PathV& v, float (*to)[widest]) { store3(v, to[0], to[1], to[2]); }

FASTRT_INLINE void append3(const Compressor& pick, const PathV& v, float* x, float* y, float* z) {
  pick.store(v.x, x);
  pick.store(v.y, y);
  pick.store(v.z, z);
}

// Appends the new rays to `out`. media: theirs. Whole registers are written, and fit: a child batch holds at
// most as many rays as its parent has rows before i.
FASTRT_INLINE void append_rays(const NewRays& rays, const PathBatch& parent, const SurfaceBatch& s,
                               const KeptColumns& keep, const std::int32_t* const (&media)[max_media], int i,
                               PathBatch& out) {
  if (rays.bits == 0) return;
  const Compressor pick(rays.bits);
  const int n = out.count;
  append3(pick, rays.origin, out.origin_x + n, out.origin_y + n, out.origin_z + n);
  append3(pick, rays.dir, out.dir_x + n, out.dir_y + n, out.dir_z + n);
  append3(pick, rays.weight, out.weight_r + n, out.weight_g + n, out.weight_b + n);
  PathF(0.0F).store_unaligned(out.t_min + n);
  PathF(__builtin_inff()).store_unaligned(out.t_max + n);
  pick.store(PathI::load_aligned(s.planar + i), out.exclude + n);
  pick.store(PathI::load_aligned(parent.pixel + i), out.pixel + n);
  if (keep.inner) pick.store(PathI::load_aligned(s.planar_inner + i), out.exclude_inner + n);
  if (keep.width) pick.store(PathF::load_aligned(s.width + i), out.width + n);
  for (int k = 0; keep.media && k < max_media; ++k)
    pick.store(PathI::load_aligned(media[k]), out.media[k] + n);
  out.count = n + __builtin_popcount(rays.bits);
}

// Lanes whose weight is worth a ray.
FASTRT_INLINE std::uint32_t worth_tracing(const PathV& weight, float min_contribution) {
  const PathF most = max(weight.x, max(weight.y, weight.z));
  return to_bits((most > PathF(0.0F)) & (most >= PathF(min_contribution)));
}

// What leaves the surfaces of one register of rays.
struct LeavingRays {
  NewRays reflected, refracted;
  MediaLanes media;
};

FASTRT_INLINE void add_rays(const PathM& mask, std::uint32_t bits, const PathV& origin, const PathV& dir,
                            const PathV& weight, float min_contribution, NewRays& out) {
  out.origin = select(mask, origin, out.origin);
  out.dir = select(mask, dir, out.dir);
  out.weight = select(mask, weight, out.weight);
  out.bits |= worth_tracing(weight, min_contribution) & bits;
}

// Adds what leaves the surfaces of one material, lanes `bits` of i .. .
FASTRT_INLINE void leave_surface(const TileJob& job, const PathBatch& rays, const SurfaceBatch& s,
                                 const MaterialRow& row, const PathM& mask, std::uint32_t bits, int i,
                                 LeavingRays& out) {
  if (is_medium(row)) cross_surface(job.scene->shading, s.material[i + __builtin_ctz(bits)], bits, out.media);
  const SurfaceAngles angles = surface_angles(s, i);
  const SecondaryLanes lanes =
      secondary_lanes(row, angles, transmit_of(row, s, i), out.media.ior_before, out.media.ior_after);
  const PathV weight = load3<PathF>(rays.weight_r + i, rays.weight_g + i, rays.weight_b + i);
  const PathV point = load_point(s, i);
  const PathF offset = PathF::load_aligned(s.magnitude + i) * PathF(offset_share);
  add_rays(mask, bits, point + angles.geometric * offset, lanes.mirror, weight * lanes.mirror_weight,
           job.min_contribution, out.reflected);
  if (row.has_transmit == 0) return;
  add_rays(mask, bits, point + angles.geometric * negate(offset), lanes.transmitted,
           weight * lanes.transmitted_weight, job.min_contribution, out.refracted);
}

// One column after the other: structs are copied through memory.
FASTRT_INLINE void clear(NewRays& rays) {
  rays.origin = rays.dir = rays.weight = broadcast3<PathF>(0.0F, 0.0F, 0.0F);
  rays.bits = 0;
}

// Nothing leaves yet; where a surface is not crossed, the media stay as they are.
FASTRT_INLINE void clear(const PathBatch& rays, const KeptColumns& keep, int i, LeavingRays& out) {
  clear(out.reflected);
  clear(out.refracted);
  out.media.ior_before = out.media.ior_after = PathF(1.0F);
  for (int k = 0; keep.media && k < max_media; ++k)
    PathI::load_aligned(rays.media[k] + i).store_aligned(out.media.after[k]);
}

// All rays that leave the surfaces of a batch.
static void make_secondary_rays(const TileJob& job, const PathBatch& rays, const TileScratch& scratch,
                                PathBatch& reflected, PathBatch& refracted) noexcept {
  const SurfaceBatch& s = scratch.surface;
  const KeptColumns keep = kept_columns(job.scene->shading);
  for (int i = 0; i < rays.count; i += widest) {
    const std::uint32_t hits = hit_bits(rays, scratch.hits, i);
    if (hits == 0) continue;
    LeavingRays leaving;
    clear(rays, keep, i, leaving);
    for_each_material(job.scene->shading, s.material + i, hits,
                      [&](const MaterialRow& row, const PathM& mask, std::uint32_t bits) {
                        if ((row.has_mirror | row.has_transmit) != 0 && row.unlit == 0)
                          leave_surface(job, rays, s, row, mask, bits, i, leaving);
                      });
    const std::int32_t *before[max_media], *after[max_media];
    for (int k = 0; k < max_media; ++k) {
      before[k] = rays.media[k] + i;
      after[k] = leaving.media.after[k];
    }
    append_rays(leaving.reflected, rays, s, keep, before, i, reflected);
    append_rays(leaving.refracted, rays, s, keep, after, i, refracted);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
