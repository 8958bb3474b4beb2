// SPDX-License-Identifier: Apache-2.0
// Ray against sphere (docs/numerics.md, "Sphere").
#pragma once

#include "src/kernels/vec3.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

template <class F>
struct SphereLanes {
  MaskOf<F> hit;
  F t; // meaningful where `hit`; > t_min there unless it is NaN
};

// The first point of the sphere beyond t_min on the line, for the lanes in `asked` (bits); others may be
// missing. The caller checks t < t_max.
template <class F>
FASTRT_INLINE SphereLanes<F> intersect_sphere(const V3<F>& center, const F& radius, const V3<F>& origin,
                                              const V3<F>& dir, const F& t_min, std::uint32_t asked = ~0U) {
  const V3<F> f = origin - center;
  const F a = dot(dir, dir);
  const F b = negate(dot(f, dir));
  const V3<F> l = f + dir * (b / a);
  const F q2 = radius * radius - dot(l, l);
  const MaskOf<F> meets = q2 >= F(0.0F);
  if ((to_bits(meets) & asked) == 0) return {from_bits<width_of<F>>(0), F(0.0F)};
  const F c = dot(f, f) - radius * radius;
  // The root of a * q2 would overflow for a large sphere and a distant light.
  const F q = b + flip(sqrt(a) * sqrt(q2), sign_bit(b));
  const F t0 = c / q;
  const F t1 = q / a;
  const F nearer = min(t0, t1);
  const F farther = max(t0, t1);
  const F t = select(nearer > t_min, nearer, farther);
  return {meets & (t > t_min), t};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
