// SPDX-License-Identifier: Apache-2.0
// Three batches as a vector. The order of operations is that of docs/numerics.md.
#pragma once

#include "src/simd/lanes.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

template <class F>
struct V3 {
  F x, y, z;
};

template <class F>
FASTRT_INLINE V3<F> operator+(const V3<F>& a, const V3<F>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class F>
FASTRT_INLINE V3<F> operator-(const V3<F>& a, const V3<F>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class F>
FASTRT_INLINE V3<F> operator*(const V3<F>& a, const F& s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class F>
FASTRT_INLINE V3<F> operator*(const V3<F>& a, const V3<F>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class F>
FASTRT_INLINE V3<F> operator/(const V3<F>& a, const F& s) {
  return {a.x / s, a.y / s, a.z / s};
}
template <class F>
FASTRT_INLINE F dot(const V3<F>& a, const V3<F>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class F>
FASTRT_INLINE V3<F> cross(const V3<F>& a, const V3<F>& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
template <class F>
FASTRT_INLINE V3<F> normalize(const V3<F>& a) {
  return a * (F(1.0F) / sqrt(dot(a, a)));
}
template <class F>
FASTRT_INLINE V3<F> negate(const V3<F>& a) {
  return {negate(a.x), negate(a.y), negate(a.z)};
}
template <class F>
FASTRT_INLINE V3<F> flip(const V3<F>& a, const F& sign) {
  return {flip(a.x, sign), flip(a.y, sign), flip(a.z, sign)};
}
template <class F>
FASTRT_INLINE V3<F> select(const MaskOf<F>& mask, const V3<F>& yes, const V3<F>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
template <class F>
FASTRT_INLINE V3<F> broadcast3(float x, float y, float z) {
  return {F(x), F(y), F(z)};
}
template <class F>
FASTRT_INLINE V3<F> broadcast3(const float* v) {
  return {F(v[0]), F(v[1]), F(v[2])};
}
template <class F>
FASTRT_INLINE V3<F> load3(const float* x, const float* y, const float* z) {
  return {load<F>(x), load<F>(y), load<F>(z)};
}
template <class F>
FASTRT_INLINE void store3(const V3<F>& v, float* x, float* y, float* z) {
  v.x.store_unaligned(x);
  v.y.store_unaligned(y);
  v.z.store_unaligned(z);
}
// The largest of |x|, |y|, |z|, as max(|x|, max(|y|, |z|)).
template <class F>
FASTRT_INLINE F largest(const V3<F>& a) {
  return max(abs(a.x), max(abs(a.y), abs(a.z)));
}
template <class F>
FASTRT_INLINE F sum_of_sizes(const V3<F>& a) {
  return (abs(a.x) + abs(a.y)) + abs(a.z);
}

// Lanes whose ray can be traced: its origin is finite, and it has a direction, finite too.
template <class F>
FASTRT_INLINE MaskOf<F> are_finite(const V3<F>& origin) {
  const F zero(0.0F);
  return sum_of_sizes(origin) * zero == zero;
}
template <class F>
FASTRT_INLINE MaskOf<F> have_direction(const V3<F>& dir) {
  const F size = sum_of_sizes(dir);
  return (size > F(0.0F)) & (size < F(__builtin_inff()));
}
template <class F>
FASTRT_INLINE MaskOf<F> are_traceable(const V3<F>& origin, const V3<F>& dir) {
  return are_finite(origin) & have_direction(dir);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
