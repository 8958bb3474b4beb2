// SPDX-License-Identifier: Apache-2.0
// The shading normals that bump maps turn (docs/numerics.md, "Textures").
#pragma once

#include "src/trace/texture_lookup.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Which way u and v grow on the surface; false where there are no coordinates.
FASTRT_INLINE bool tangents(const HitSite& site, const TextureRow& row, Row3& along_u, Row3& along_v) {
  if (row.planar != 0) {
    along_u = {row.plane_u[0], row.plane_u[1], row.plane_u[2]};
    along_v = {row.plane_v[0], row.plane_v[1], row.plane_v[2]};
    return true;
  }
  if (!site.has_uv) return false;
  const bool mirrored = site.du1 * site.dv2 - site.du2 * site.dv1 < 0.0F;
  const float sign = mirrored ? -1.0F : 1.0F;
  along_u = (site.edge1 * site.dv2 - site.edge2 * site.dv1) * sign;
  along_v = (site.edge2 * site.du1 - site.edge1 * site.du2) * sign;
  return true;
}

// What the bump map makes of height: how far it rises along u and v, as the normal's x and y.
FASTRT_INLINE PathV slopes_of(const SurfaceTextures& textures, const TexturePlaces& places,
                              std::uint32_t bits) {
  const TextureRow& row = *textures.bump;
  alignas(64) std::int32_t level[widest];
  alignas(64) float width[widest], height[widest];
  simd::to_int(places.level).store_aligned(level);
  PathF(1.0F).store_aligned(width);
  PathF(1.0F).store_aligned(height);
  for (std::uint32_t left = bits; left != 0; left &= left - 1) {
    const int k = __builtin_ctz(left);
    width[k] = static_cast<float>(row.levels[level[k]].width);
    height[k] = static_cast<float>(row.levels[level[k]].height);
  }
  const PathF one(1.0F), w = PathF::load_aligned(width), h = PathF::load_aligned(height);
  TexturePlaces right = places, above = places;
  right.s = places.s + one / w;
  above.t = places.t + one / h;
  const PathF here = look_up_number(row, places, bits);
  const PathF rise_u = look_up_number(row, right, bits) - here,
              rise_v = look_up_number(row, above, bits) - here;
  return {negate((rise_u * w) * PathF(textures.bump_u)), negate((rise_v * h) * PathF(textures.bump_v)), one};
}

// The bump map's normals in the frame of u, v and the surface's normal.
FASTRT_INLINE PathV bumps_of(const SurfaceTextures& textures, const TexturePlaces& places,
                             std::uint32_t bits) {
  if (textures.normal_map == 0) return slopes_of(textures, places, bits);
  const PathV found = look_up(*textures.bump, places, bits).color;
  const PathF one(1.0F), two(2.0F);
  const PathV n{found.x * two - one, found.y * two - one, found.z * two - one};
  return {n.x * PathF(textures.bump_u), n.y * PathF(textures.bump_v), n.z};
}

// b: the bump map's normal. n: the shading normal, kept where the bump makes no sense. ng: the geometric one.
FASTRT_INLINE Row3 bumped(const TextureRow& row, const HitSite& site, const Row3& b, const Row3& n,
                          const Row3& ng) {
  Row3 along_u, along_v;
  if (!tangents(site, row, along_u, along_v)) return n;
  Row3 x = along_u - n * dot(n, along_u);
  const float x2 = dot(x, x);
  if (!(x2 > 0.0F && x2 < __builtin_inff())) return n;
  x = x * (1.0F / __builtin_sqrtf(x2));
  Row3 y = cross(n, x);
  if (dot(y, along_v) < 0.0F) y = Row3{-y.x, -y.y, -y.z};
  const Row3 turned = (x * b.x + y * b.y) + n * b.z;
  const float length2 = dot(turned, turned);
  if (!(length2 > 0.0F && length2 < __builtin_inff())) return n;
  const Row3 unit = turned * (1.0F / __builtin_sqrtf(length2));
  return dot(unit, ng) > 0.0F ? unit : n;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
