// SPDX-License-Identifier: Apache-2.0
// What the tests of the kernels share: which instruction sets run here, how hard to try, and equality of
// bits.
#pragma once

#include "src/kernels/kernel_table.hpp"
#include "src/reference/ray.hpp"

#include <fastrt/isa.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace fastrt::test {

// Builds with sanitizers or without optimisation try fewer numbers: they look for other faults.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
inline constexpr bool slow_build = true;
#else
inline constexpr bool slow_build = false;
#endif
constexpr int effort(int full) { return slow_build ? (full + 19) / 20 : full; }

// Those with kernels: all that run here but the scalar one.
inline std::vector<Isa> simd_isas() {
  std::vector<Isa> isas;
  for (const Isa isa : available_isas())
    if (isa != Isa::scalar) isas.push_back(isa);
  return isas;
}

inline const KernelTable& kernels_of(Isa isa) {
  switch (isa) {
  case Isa::avx512:
    return avx512::kernel_table();
  case Isa::avx2:
    return avx2::kernel_table();
  default:
    return sse42::kernel_table();
  }
}

// "sse42": test names hold no dots.
inline std::string isa_word(Isa isa) {
  std::string word;
  for (const char* c = isa_name(isa); *c != '\0'; ++c)
    if (*c != '.') word += *c;
  return word;
}
struct IsaWord {
  std::string operator()(const testing::TestParamInfo<Isa>& info) const { return isa_word(info.param); }
};

inline std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
// NaNs are all the same: their payload depends on the order of operands of one addition.
inline bool same(float a, float b) { return bits(a) == bits(b) || (std::isnan(a) && std::isnan(b)); }
// A weight of 0 may have either sign: it depends on whether an edge's normal or the dot product with it was
// negated, and means nothing.
inline bool same_weight(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }
inline bool same(const reference::Hit& a, const reference::Hit& b) {
  return a.primitive == b.primitive && a.instance == b.instance && same(a.t, b.t) && same_weight(a.u, b.u) &&
         same_weight(a.v, b.v);
}

} // namespace fastrt::test
