// SPDX-License-Identifier: Apache-2.0
// The direction of a vector of the plane as a share of a full turn: one more function that both paths share
// (shared_math.hpp says why and what Ops is).
#pragma once

#include "src/simd/shared_math.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// atan2(y, x) / (2 pi), from -1/2 to 1/2; 0 for (0, 0). Error below 2e-7.
template <class Ops>
[[gnu::always_inline]] inline typename Ops::F shared_turn(typename Ops::F y, typename Ops::F x) {
  using F = typename Ops::F;
  const F zero = F(0.0F);
  const F ax = Ops::select(x < zero, zero - x, x);
  const F ay = Ops::select(y < zero, zero - y, y);
  const auto is_steep = ay > ax;
  const F larger = Ops::select(is_steep, ay, ax);
  const F smaller = Ops::select(is_steep, ax, ay);
  // The tangent of at most an eighth of a turn; of a sixteenth after turning back by one.
  const F tangent = Ops::select(larger > zero, smaller / larger, zero);
  const auto is_wide = tangent > F(0.414213562F);
  const F s = Ops::select(is_wide, (tangent - F(1.0F)) / (tangent + F(1.0F)), tangent);
  const F s2 = s * s;
  F sum = F(1.0F / 13.0F);
  sum = F(-1.0F / 11.0F) + s2 * sum;
  sum = F(1.0F / 9.0F) + s2 * sum;
  sum = F(-1.0F / 7.0F) + s2 * sum;
  sum = F(1.0F / 5.0F) + s2 * sum;
  sum = F(-1.0F / 3.0F) + s2 * sum;
  sum = F(1.0F) + s2 * sum;
  const F part = (s * sum) * F(0.159154943F);
  const F eighth = Ops::select(is_wide, F(0.125F) + part, part);
  const F quarter = Ops::select(is_steep, F(0.25F) - eighth, eighth);
  const F half = Ops::select(x < zero, F(0.5F) - quarter, quarter);
  return Ops::select(y < zero, zero - half, half);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
