// SPDX-License-Identifier: Apache-2.0
// pow and exp, written once for a float and for a batch of floats: the only arithmetic that the SIMD path and
// its scalar twin share, because library functions differ between instruction sets and versions. Only + - * /
// compare, select and bit operations, so both run the same steps. Relative error below 3e-6 * max(1,
// |exponent of the result|).
//
// Ops names the types and what C++ has no common spelling for: F (floats), I (32-bit integers), and the
// static functions bits(F), from_bits(I), to_float(I), to_int(F) (truncates) and select(mask, F, F).
#pragma once

#include <cstdint>
#include <cstring>

#ifndef FASTRT_ISA_NAMESPACE
#define FASTRT_ISA_NAMESPACE baseline
#endif

namespace fastrt::FASTRT_ISA_NAMESPACE {

// 2^x; 0 below -126, 2^127 at most.
template <class Ops>
[[gnu::always_inline]] inline typename Ops::F shared_exp2(typename Ops::F x) {
  using F = typename Ops::F;
  using I = typename Ops::I;
  const F low = F(-126.0F);
  const F high = F(127.0F);
  const auto underflow = x < low;
  const F clamped = Ops::select(x > low, Ops::select(x < high, x, high), low);
  const I truncated = Ops::to_int(clamped);
  const auto above = Ops::to_float(truncated) > clamped;
  const F floor = Ops::select(above, Ops::to_float(truncated) - F(1.0F), Ops::to_float(truncated));
  // 2^fraction = sqrt(2) * exp(s), |s| <= ln(2) / 2, by its Taylor series.
  const F s = ((clamped - floor) - F(0.5F)) * F(0.693147181F);
  F sum = F(1.0F / 5040.0F);
  sum = sum * s + F(1.0F / 720.0F);
  sum = sum * s + F(1.0F / 120.0F);
  sum = sum * s + F(1.0F / 24.0F);
  sum = sum * s + F(1.0F / 6.0F);
  sum = sum * s + F(0.5F);
  sum = sum * s + F(1.0F);
  sum = sum * s + F(1.0F);
  const F scale = Ops::from_bits((Ops::to_int(floor) + I(127)) << 23);
  return Ops::select(underflow, F(0.0F), (sum * F(1.41421356F)) * scale);
}

// log2 of a positive, normal number.
template <class Ops>
[[gnu::always_inline]] inline typename Ops::F shared_log2(typename Ops::F x) {
  using F = typename Ops::F;
  using I = typename Ops::I;
  // x = 2^exponent * mantissa, mantissa in [sqrt(1/2), sqrt(2)).
  const I x_bits = Ops::bits(x);
  const I shifted = x_bits - I(0x3F3504F3);
  const I exponent = shifted >> 23;
  const F mantissa = Ops::from_bits(x_bits - (exponent << 23));
  // ln(mantissa) = 2 * artanh(s).
  const F s = (mantissa - F(1.0F)) / (mantissa + F(1.0F));
  const F s2 = s * s;
  F sum = F(1.0F / 9.0F);
  sum = sum * s2 + F(1.0F / 7.0F);
  sum = sum * s2 + F(1.0F / 5.0F);
  sum = sum * s2 + F(1.0F / 3.0F);
  sum = sum * s2 + F(1.0F);
  return Ops::to_float(exponent) + (s * sum) * F(2.88539008F);
}

// x^y for x > 0. Callers mask x <= 0 out.
template <class Ops>
[[gnu::always_inline]] inline typename Ops::F shared_pow(typename Ops::F x, typename Ops::F y) {
  return shared_exp2<Ops>(y * shared_log2<Ops>(x));
}

template <class Ops>
[[gnu::always_inline]] inline typename Ops::F shared_exp(typename Ops::F x) {
  return shared_exp2<Ops>(x * typename Ops::F(1.44269504F));
}

// Ops for one float: what the scalar twin uses.
struct ScalarOps {
  using F = float;
  using I = std::int32_t;
  [[gnu::always_inline]] static I bits(F x) {
    I result;
    std::memcpy(&result, &x, sizeof result);
    return result;
  }
  [[gnu::always_inline]] static F from_bits(I x) {
    F result;
    std::memcpy(&result, &x, sizeof result);
    return result;
  }
  [[gnu::always_inline]] static F to_float(I x) { return static_cast<F>(x); }
  [[gnu::always_inline]] static I to_int(F x) { return static_cast<I>(x); }
  [[gnu::always_inline]] static F select(bool mask, F yes, F no) { return mask ? yes : no; }
};

} // namespace fastrt::FASTRT_ISA_NAMESPACE
