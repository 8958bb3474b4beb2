// SPDX-License-Identifier: Apache-2.0
// Shadows in scenes whose media absorb light: as coloured shadows, and each stretch between two surfaces
// takes its part too (docs/numerics.md, "Shading").
#pragma once

#include "src/simd/shared_math.hpp"
#include "src/trace/media.hpp"
#include "src/trace/shadow_surfaces.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// A directional light's shadow rays start at the surfaces, on the side that the paths came from.
FASTRT_INLINE void begin_shadow_media(const LightRow& light, const PathBatch& paths, TileScratch& scratch) {
  for (int k = 0; k < max_media; ++k)
    for (int i = 0; i < scratch.shadow.count; i += widest) {
      const PathI media = light.directional != 0 ? load<PathI>(paths.media[k] + i) : PathI(light.media[k]);
      media.store_aligned(scratch.shadow_media[k] + i);
    }
}

// The stretch from t_min to the hit, or to the end of the ray, of the lanes i .. in `bits`.
FASTRT_INLINE void fade_stretch(const ShadingView& scene, const TileScratch& scratch, std::uint32_t bits,
                                int i, LightBatch& light) {
  alignas(64) float sigma[3][widest] = {};
  std::uint32_t fading = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    const std::int32_t medium = scratch.shadow_media[0][i + lane];
    if (medium < 0 || scene.materials[medium].has_absorption == 0) continue;
    fading |= 1U << lane;
    for (int c = 0; c < 3; ++c) sigma[c][lane] = scene.materials[medium].absorption[c];
  }
  if (fading == 0) return;
  const RayBatch& rays = scratch.shadow;
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  const PathF stretch = PathF::load_aligned(scratch.shadow_hits.t + i) - PathF::load_aligned(rays.t_min + i);
  const PathF distance = stretch * sqrt(dot(dir, dir));
  using Ops = BatchOps<widest>;
  const auto left = [&](int c) { return shared_exp<Ops>(negate(PathF::load_aligned(sigma[c]) * distance)); };
  const PathV visible = load3<PathF>(light.visible_r + i, light.visible_g + i, light.visible_b + i);
  store_visibility(select(from_bits<widest>(fading), visible * PathV{left(0), left(1), left(2)}, visible), i,
                   light);
}

FASTRT_INLINE void cross_shadow_surface(const ShadingView& scene, int i, TileScratch& scratch) {
  const std::uint32_t material = material_of_hit(scene, scratch.shadow_hits, i);
  if (!is_medium(scene.materials[material])) return;
  std::int32_t list[max_media];
  for (int k = 0; k < max_media; ++k) list[k] = scratch.shadow_media[k][i];
  cross_medium(static_cast<std::int32_t>(material), list);
  for (int k = 0; k < max_media; ++k) scratch.shadow_media[k][i] = list[k];
}

// The hits of the lanes i .. in `bits`. Returns the lanes whose rays go on.
FASTRT_INLINE std::uint32_t pass_surfaces(const ShadingView& scene, std::uint32_t bits, int i,
                                          TileScratch& scratch) {
  std::uint32_t going_on = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits), ray = i + lane;
    if (!pass_surface(scene, scratch.shadow, scratch.shadow_hits, ray, scratch.light)) continue;
    cross_shadow_surface(scene, ray, scratch);
    scratch.shadow.t_min[ray] = scratch.shadow_hits.t[ray];
    going_on |= 1U << lane;
  }
  return going_on;
}

// Of scratch.shadow, in scratch.shadow_media. endless: whether the rays have no end. lit: those that there
// are, a word per packet. Ends with all of them at 0.
static void trace_fading_shadows(const SceneView& scene, bool endless, std::uint32_t* lit,
                                 TileScratch& scratch) noexcept {
  RayBatch& rays = scratch.shadow;
  for (int i = 0; i < rays.count; i += widest)
    store_visibility(broadcast3<PathF>(1.0F, 1.0F, 1.0F), i, scratch.light);
  bool any_left = true;
  while (any_left) {
    find_closest_hits(scene.geometry, rays, scratch.shadow_hits);
    any_left = false;
    for (int i = 0; i < rays.count; i += widest) {
      std::uint32_t& bits = lit[i / widest];
      if (bits == 0) continue;
      const std::uint32_t hit =
          to_bits(simd::bool_cast(PathI::load_aligned(scratch.shadow_hits.primitive + i) >= PathI(0))) & bits;
      fade_stretch(scene.shading, scratch, endless ? hit : bits, i, scratch.light);
      const std::uint32_t going_on = pass_surfaces(scene.shading, hit, i, scratch);
      for (std::uint32_t done = bits & ~going_on; done != 0; done &= done - 1) {
        const int ray = i + __builtin_ctz(done);
        rays.t_max[ray] = rays.t_min[ray];
      }
      bits = going_on;
      any_left = any_left || going_on != 0;
    }
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
