// SPDX-License-Identifier: Apache-2.0
// What is left of a light along shadow rays: nothing or all of it, or what transparent surfaces let through
// (docs/numerics.md, "Shading").
#pragma once

#include "src/kernels/batch_queries.hpp"
#include "src/trace/textures.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

FASTRT_INLINE void store_visibility(const PathV& visible, int i, LightBatch& light) {
  store3(visible, light.visible_r + i, light.visible_g + i, light.visible_b + i);
}

// Shadows where nothing is transparent: 0 or 1.
FASTRT_INLINE void trace_opaque_shadows(const GeometryView& scene, const RayBatch& rays, HitBatch& hits,
                                        LightBatch& light) {
  find_any_hits(scene, rays, hits);
  for (int i = 0; i < rays.count; i += widest) {
    const PathM free = simd::bool_cast(PathI::load_aligned(hits.primitive + i) < PathI(0));
    const PathF visible = simd::select(free, PathF(1.0F), PathF(0.0F));
    store_visibility({visible, visible, visible}, i, light);
  }
}

// One surface on the way of shadow ray i: takes what it holds back. Returns whether the ray goes on behind
// it.
FASTRT_INLINE bool pass_surface(const ShadingView& scene, const RayBatch& rays, const HitBatch& hits, int i,
                                LightBatch& light) {
  const MaterialRow& row = scene.materials[material_of_hit(scene, hits, i)];
  if (row.passes_light == 0) {
    light.visible_r[i] = light.visible_g[i] = light.visible_b[i] = 0.0F;
    return false;
  }
  Row3 transmit{row.transmit[0], row.transmit[1], row.transmit[2]};
  if (row.textures != nullptr && row.textures->opacity != nullptr)
    transmit = transmit_at(scene, row, rays, hits, i);
  light.visible_r[i] = light.visible_r[i] * transmit.x;
  light.visible_g[i] = light.visible_g[i] * transmit.y;
  light.visible_b[i] = light.visible_b[i] * transmit.z;
  return light.visible_r[i] != 0.0F || light.visible_g[i] != 0.0F || light.visible_b[i] != 0.0F;
}

// The same for rays i .. in the lanes `bits` where there are neither textures nor instances. Returns the
// lanes that go on.
FASTRT_INLINE std::uint32_t pass_plain_surfaces(const ShadingView& scene, const HitBatch& hits,
                                                std::uint32_t bits, int i, LightBatch& light) {
  const PathI ids = PathI::load_aligned(hits.primitive + i);
  const PathI places = materials_of(scene, ids, kinds_of(scene, ids, bits)) * PathI(material_words);
  const std::uint32_t pass =
      to_bits(simd::bool_cast(gather(&scene.materials->passes_light, places, bits) != PathI(0)));
  const float* const first = scene.materials->transmit;
  const PathV transmit = gather3(first, first + 1, first + 2, places, pass); // 0 where nothing passes
  const PathV visible = load3<PathF>(light.visible_r + i, light.visible_g + i, light.visible_b + i);
  const PathV left = visible * transmit;
  store_visibility(select(from_bits<widest>(bits), left, visible), i, light);
  const PathF zero(0.0F);
  return to_bits((left.x != zero) | (left.y != zero) | (left.z != zero)) & pass;
}

// The hits of shadow rays i .. : what they hold back, and where the rays go on. (Rows behind the last ray
// have none.) Returns whether any does.
FASTRT_INLINE bool pass_surfaces(const ShadingView& scene, RayBatch& rays, const HitBatch& hits, int i,
                                 LightBatch& light) {
  std::uint32_t bits = to_bits(simd::bool_cast(PathI::load_aligned(hits.primitive + i) >= PathI(0)));
  std::uint32_t going_on = 0;
  if (bits != 0 && scene.has_textures == 0 && scene.shapes.instance_count == 0) {
    going_on = pass_plain_surfaces(scene, hits, bits, i, light);
  } else {
    for (; bits != 0; bits &= bits - 1)
      if (pass_surface(scene, rays, hits, i + __builtin_ctz(bits), light))
        going_on |= 1U << __builtin_ctz(bits);
  }
  const PathM mask = from_bits<widest>(going_on);
  const PathF t_min = PathF::load_aligned(rays.t_min + i);
  simd::select(mask, PathF::load_aligned(hits.t + i), t_min).store_aligned(rays.t_min + i);
  simd::select(mask, PathF::load_aligned(rays.t_max + i), t_min).store_aligned(rays.t_max + i); // done
  return going_on != 0;
}

// Shadows through transparent surfaces: from surface to surface along each ray, in order of t.
FASTRT_INLINE void trace_coloured_shadows(const SceneView& scene, RayBatch& rays, HitBatch& hits,
                                          LightBatch& light) {
  for (int i = 0; i < rays.count; i += widest)
    store_visibility(broadcast3<PathF>(1.0F, 1.0F, 1.0F), i, light);
  bool going_on = true;
  while (going_on) {
    find_closest_hits(scene.geometry, rays, hits);
    going_on = false;
    for (int i = 0; i < rays.count; i += widest)
      if (pass_surfaces(scene.shading, rays, hits, i, light)) going_on = true;
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
