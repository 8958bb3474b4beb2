// SPDX-License-Identifier: Apache-2.0
// Neighbouring rays that a smooth surface has mirrored or refracted are an astigmatic pencil: to first order
// they pass through two lines, each across the pencil and to the other one. Flat mirrors let the two meet in
// a point, the image of the eye. Seen from there, rays are points of a plane again, as those of a tile are: a
// point (x, y, depth) lies at (x / (1 + spread_u * depth), y / (1 + spread_v * depth)), and rays stay where
// they are. What is wrong with this for single rays is measured, and rays that it does not fit are left out.
//
// Sturm's conoid: Stavroudis, "The Optics of Rays, Wavefronts, and Caustics", 1972; pencils of rays in
// rendering: Shinya, Takahashi & Naito, "Principles and Applications of Pencil Tracing", 1987.
#pragma once

#include "src/kernels/tile_traversal.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// How far a ray may stray from the pencil on its way, as a share of what 16 rays spread (their standard
// deviation).
inline constexpr float pencil_stray = 0.25F;
// How small the pencil may get, as a share of its width at depth 0.
inline constexpr float least_width = 0.125F;

struct PencilFrame {
  V3<float> u, v, w;        // of a point from the origin: across, across and depth. u and v may lean along w
  float length_u, length_v; // of u and v; 1 or a little more
  V3<float> origin;         // depth 0: in the midst of the rays' origins
  float spread_u, spread_v; // by how much wider per depth, as a share of the width at depth 0
  float stray_x, stray_y;   // how far a ray may be from its place in the plane; of all rays, the most
  float stray_slope;        // and how its slope may differ from the pencil's there
  float largest_begin;      // |coordinate| of the rays' origins from `origin`, at most
  float size;               // of all coordinates in play
  float padding;            // boxes are met as if larger by this
  float near, end;          // depths: what lies before and behind matters to no ray
};

// Means of a group's rays, and products of their distances from these, summed: positions at depth 0 (x, y)
// and slopes (s, t).
struct PencilMoments {
  float x, y, s, t;
  float xx, xy, yy, sx, sy, tx, ty;
};

// The middle of a group's origins and directions; u and v across, in no special way.
FASTRT_INLINE void aim_pencil(const RayBatch& rays, int first, std::uint32_t live, PencilFrame& f) {
  const PacketF zero(0.0F);
  V3<PacketF> origins{zero, zero, zero}, dirs{zero, zero, zero};
  for (int k = 0; k < group_size; k += widest) {
    const PacketM mask = from_bits<widest>(live >> k & register_bits);
    const V3<PacketF> dir = load_dir(rays, first + k), none{zero, zero, zero};
    origins = origins + select(mask, load_origin(rays, first + k), none);
    dirs = dirs + select(mask, dir * (PacketF(1.0F) / sum_of_sizes(dir)), none);
  }
  const float share = 1.0F / static_cast<float>(__builtin_popcount(live));
  f.origin = {simd::hadd(origins.x) * share, simd::hadd(origins.y) * share, simd::hadd(origins.z) * share};
  f.w = unit({simd::hadd(dirs.x), simd::hadd(dirs.y), simd::hadd(dirs.z)});
  f.u = direction_across(f.w, minus(ray_origin(rays, first + 31 - __builtin_clz(live)),
                                    ray_origin(rays, first + __builtin_ctz(live))));
  f.v = {f.w.y * f.u.z - f.w.z * f.u.y, f.w.z * f.u.x - f.w.x * f.u.z, f.w.x * f.u.y - f.w.y * f.u.x};
}

// Rays as lines, seen in the frame: where they begin, and how they move with depth.
struct PencilRays {
  PacketF begin_x, begin_y, begin; // begin: depth
  PacketF slope_x, slope_y, scale; // scale: depth per t
  PacketF away;                    // largest |coordinate| of the origin, from the frame's
};

FASTRT_INLINE PencilRays see_rays(const PencilFrame& f, const RayBatch& rays, int i) {
  const V3<PacketF> u = broadcast3<PacketF>(f.u), v = broadcast3<PacketF>(f.v), w = broadcast3<PacketF>(f.w);
  const V3<PacketF> from = load_origin(rays, i) - broadcast3<PacketF>(f.origin), dir = load_dir(rays, i);
  const PacketF scale = cull_dot(dir, w), inverse = PacketF(1.0F) / scale;
  return {cull_dot(from, u),
          cull_dot(from, v),
          cull_dot(from, w),
          cull_dot(dir, u) * inverse,
          cull_dot(dir, v) * inverse,
          scale,
          largest(from)};
}

FASTRT_INLINE PencilMoments moments_of(const PencilFrame& f, const RayBatch& rays, int first,
                                       std::uint32_t live) {
  constexpr int registers = group_size / widest;
  const PacketF zero(0.0F);
  PacketF x[registers], y[registers], s[registers], t[registers];
  PacketF sum_x(0.0F), sum_y(0.0F), sum_s(0.0F), sum_t(0.0F);
  for (int r = 0; r < registers; ++r) {
    const PacketM mask = from_bits<widest>(live >> (r * widest) & register_bits);
    const PencilRays seen = see_rays(f, rays, first + r * widest);
    s[r] = select(mask, seen.slope_x, zero);
    t[r] = select(mask, seen.slope_y, zero);
    x[r] = select(mask, cull_less(seen.begin, seen.slope_x, seen.begin_x), zero);
    y[r] = select(mask, cull_less(seen.begin, seen.slope_y, seen.begin_y), zero);
    sum_x = sum_x + x[r];
    sum_y = sum_y + y[r];
    sum_s = sum_s + s[r];
    sum_t = sum_t + t[r];
  }
  const float share = 1.0F / static_cast<float>(__builtin_popcount(live));
  PencilMoments m{};
  m.x = simd::hadd(sum_x) * share;
  m.y = simd::hadd(sum_y) * share;
  m.s = simd::hadd(sum_s) * share;
  m.t = simd::hadd(sum_t) * share;
  PacketF xx(0.0F), xy(0.0F), yy(0.0F), sx(0.0F), sy(0.0F), tx(0.0F), ty(0.0F);
  for (int r = 0; r < registers; ++r) {
    const PacketM mask = from_bits<widest>(live >> (r * widest) & register_bits);
    const PacketF dx = select(mask, x[r] - PacketF(m.x), zero), dy = select(mask, y[r] - PacketF(m.y), zero);
    const PacketF ds = s[r] - PacketF(m.s), dt = t[r] - PacketF(m.t);
    xx = cull_mul_add(dx, dx, xx);
    xy = cull_mul_add(dx, dy, xy);
    yy = cull_mul_add(dy, dy, yy);
    sx = cull_mul_add(ds, dx, sx);
    sy = cull_mul_add(ds, dy, sy);
    tx = cull_mul_add(dt, dx, tx);
    ty = cull_mul_add(dt, dy, ty);
  }
  m.xx = simd::hadd(xx);
  m.xy = simd::hadd(xy);
  m.yy = simd::hadd(yy);
  m.sx = simd::hadd(sx);
  m.sy = simd::hadd(sy);
  m.tx = simd::hadd(tx);
  m.ty = simd::hadd(ty);
  return m;
}

FASTRT_INLINE V3<float> combined(float a, const V3<float>& x, float b, const V3<float>& y) {
  return {a * x.x + b * y.x, a * x.y + b * y.y, a * x.z + b * y.z};
}

// Turns u and v to the pencil's own directions and leans them so that its middle ray stays at one place.
// False where the rays lie in a line and so don't tell.
FASTRT_INLINE bool fit_frame(const PencilMoments& m, int rays, PencilFrame& f) {
  // Slopes as a linear function of the position, by least squares: symmetric, for rays that one eye sees.
  const float det = m.xx * m.yy - m.xy * m.xy, all = m.xx + m.yy;
  if (!(det > 1e-6F * (all * all))) return false;
  const float inverse = 1.0F / det;
  const float a = (m.sx * m.yy - m.sy * m.xy) * inverse, d = (m.ty * m.xx - m.tx * m.xy) * inverse;
  const float b = 0.5F * (((m.sy * m.xx - m.sx * m.xy) + (m.tx * m.yy - m.ty * m.xy)) * inverse);
  const float half = 0.5F * (a - d), radius = __builtin_sqrtf(half * half + b * b), middle = 0.5F * (a + d);
  float x = half >= 0.0F ? half + radius : b, y = half >= 0.0F ? b : radius - half;
  const float length2 = x * x + y * y;
  const float share = length2 > 0.0F ? 1.0F / __builtin_sqrtf(length2) : 0.0F;
  x = length2 > 0.0F ? x * share : 1.0F;
  y *= share;
  const V3<float> u = combined(x, f.u, y, f.v), v = combined(x, f.v, -y, f.u);
  f.spread_u = middle + radius;
  f.spread_v = middle - radius;
  const float lean_u = f.spread_u * (x * m.x + y * m.y) - (x * m.s + y * m.t),
              lean_v = f.spread_v * (x * m.y - y * m.x) - (x * m.t - y * m.s);
  f.u = combined(1.0F, u, lean_u, f.w);
  f.v = combined(1.0F, v, lean_v, f.w);
  f.length_u = __builtin_sqrtf(1.0F + lean_u * lean_u);
  f.length_v = __builtin_sqrtf(1.0F + lean_v * lean_v);
  const float n = pencil_stray * pencil_stray / static_cast<float>(rays);
  f.stray_x = __builtin_sqrtf(((x * x * m.xx + y * y * m.yy) + 2.0F * (x * y * m.xy)) * n);
  f.stray_y = __builtin_sqrtf(((y * y * m.xx + x * x * m.yy) - 2.0F * (x * y * m.xy)) * n);
  return true;
}

// The depth at which the scene ends.
FASTRT_INLINE float end_of_scene(const GeometryView& scene, const PencilFrame& f) {
  if (is_leaf(scene.root)) return 4.0F * f.size;
  using N = Floats<node_lanes>;
  const ExtentAxis axis = extent_axis(f, f.w);
  N end(0.0F);
  for (int half = 0; half < wide_children; half += node_lanes)
    end = max(box_extent(axis, scene.nodes[scene.root].lower_x + half, N(f.padding)).high, end);
  return reduce_max(end);
}

// Fits a pencil to the rays of one group; false if there is none that boxes and rays could be seen in.
FASTRT_INLINE bool fit_pencil(const GeometryView& scene, const RayBatch& rays, int group, std::uint32_t live,
                              PencilFrame& f) {
  const int first = group * group_size;
  aim_pencil(rays, first, live, f);
  if (!fit_frame(moments_of(f, rays, first, live), __builtin_popcount(live), f)) return false;
  f.padding = 4.0F * box_padding * f.size;
  f.end = end_of_scene(scene, f);
  // Depths are known to within the padding, widths so to within a share of themselves.
  const float most = larger(magnitude(f.spread_u), magnitude(f.spread_v));
  return most * f.padding < 0x1p-10F && 1.0F + f.spread_u * f.end > least_width &&
         1.0F + f.spread_v * f.end > least_width;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
