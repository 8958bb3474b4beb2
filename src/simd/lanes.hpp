// SPDX-License-Identifier: Apache-2.0
// The floor under the kernels: xsimd's batches by width, and the few operations that xsimd 8.1 lacks.
//
// Every kernel object compiles its own copy of xsimd: the namespace is renamed per ISA, so that no inline
// function of one object can be merged by the linker with the same function compiled for another instruction
// set.
#pragma once

#if !defined(FASTRT_ISA_NAMESPACE) || !defined(FASTRT_XSIMD_NAMESPACE)
#error "kernel files are compiled once per ISA, by fastrt_kernels() in cmake/FastrtTargets.cmake"
#endif

#define xsimd FASTRT_XSIMD_NAMESPACE
#include <xsimd/xsimd.hpp>
#undef xsimd

#include <cstdint>

// In an unnamed namespace or with this on it: nothing of a kernel file may be seen by the linker.
#ifndef FASTRT_INLINE
#define FASTRT_INLINE [[gnu::always_inline]] static inline
#endif

namespace fastrt::FASTRT_ISA_NAMESPACE {

namespace simd = ::FASTRT_XSIMD_NAMESPACE;

// The widest batch that the flags of this object allow, and the architecture tag of each width.
#if defined(__AVX512DQ__)
inline constexpr int widest = 16;
#elif defined(__AVX2__)
inline constexpr int widest = 8;
#else
inline constexpr int widest = 4;
#endif

// All lanes of the widest register, lane 0 lowest.
inline constexpr std::uint32_t register_bits = (1U << (widest - 1)) * 2U - 1U;

// The lanes of a register that are filled where `left` things are left: mostly all.
FASTRT_INLINE std::uint32_t lanes_in(int left) {
  return __builtin_expect(left >= widest, 1) ? register_bits : (1U << left) - 1U;
}

template <int W>
struct ArchOf;
template <>
struct ArchOf<4> {
  using type = simd::sse4_2;
};
#if defined(__AVX2__)
template <>
struct ArchOf<8> {
  using type = simd::avx2;
};
#endif
#if defined(__AVX512DQ__)
template <>
struct ArchOf<16> {
  using type = simd::avx512dq;
};
#endif

// W floats, W ints and their masks.
template <int W>
using Floats = simd::batch<float, typename ArchOf<W>::type>;
template <int W>
using Ints = simd::batch<std::int32_t, typename ArchOf<W>::type>;
template <int W>
using Mask = simd::batch_bool<float, typename ArchOf<W>::type>;

template <class F>
inline constexpr int width_of = static_cast<int>(F::size);
template <class F>
using IntsOf = Ints<width_of<F>>;
template <class F>
using MaskOf = Mask<width_of<F>>;

// One bit per lane, lane 0 lowest.
template <class A>
FASTRT_INLINE std::uint32_t to_bits(const simd::batch_bool<float, A>& mask) {
  constexpr int width = static_cast<int>(simd::batch_bool<float, A>::size);
#if defined(__AVX512DQ__)
  if constexpr (width == 16) return static_cast<std::uint32_t>(static_cast<__mmask16>(mask.data));
#endif
#if defined(__AVX2__)
  if constexpr (width == 8) return static_cast<std::uint32_t>(_mm256_movemask_ps(mask.data));
#endif
  if constexpr (width == 4) return static_cast<std::uint32_t>(_mm_movemask_ps(mask.data));
}

template <int W>
FASTRT_INLINE Mask<W> from_bits(std::uint32_t bits) {
#if defined(__AVX512DQ__)
  if constexpr (W == 16) return Mask<16>(static_cast<__mmask16>(bits));
#endif
#if defined(__AVX2__)
  if constexpr (W == 8) {
    const __m256i lane_bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lane_bit);
    return Mask<8>(_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lane_bit)));
  }
#endif
  if constexpr (W == 4) {
    const __m128i lane_bit = _mm_setr_epi32(1, 2, 4, 8);
    const __m128i set = _mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), lane_bit);
    return Mask<4>(_mm_castsi128_ps(_mm_cmpeq_epi32(set, lane_bit)));
  }
}

template <class F>
FASTRT_INLINE F load(const float* from) {
  return F::load_unaligned(from);
}
template <class I>
FASTRT_INLINE I load(const std::int32_t* from) {
  return I::load_unaligned(from);
}

// Eight floats from two places, or four from the first: what a register of F holds.
template <class F>
FASTRT_INLINE F load_two(const float* low, [[maybe_unused]] const float* high) {
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8)
    return F(_mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1));
#endif
  if constexpr (width_of<F> == 4) return F::load_unaligned(low);
}

// Four floats from each of as many places as fill a register of F.
template <class F>
FASTRT_INLINE F load_quads(const float* const (&from)[width_of<F> / 4]) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) {
    const __m256 low = load_two<Floats<8>>(from[0], from[1]).data;
    const __m256 high = load_two<Floats<8>>(from[2], from[3]).data;
    return F(_mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1));
  }
#endif
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8) return load_two<F>(from[0], from[1]);
#endif
  if constexpr (width_of<F> == 4) return F::load_unaligned(from[0]);
}

// Four words as one; `to` is aligned. What is soon read as a whole must be written as a whole, or the reader
// waits until the parts have reached the cache.
FASTRT_INLINE void store_together(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                                  void* to) {
  _mm_store_si128(static_cast<__m128i*>(to), _mm_setr_epi32(static_cast<int>(a), static_cast<int>(b),
                                                            static_cast<int>(c), static_cast<int>(d)));
}

// min, max, select and abs of batches are xsimd's own, found by argument-dependent lookup. min and max give
// the second operand when one is NaN, like minps; docs/numerics.md builds on it.

// The mask that a comparison of floats gave, over ints.
template <class F>
FASTRT_INLINE IntsOf<F> select_ints(const MaskOf<F>& mask, const IntsOf<F>& yes, const IntsOf<F>& no) {
  return simd::select(simd::bool_cast(mask), yes, no);
}

template <class F>
FASTRT_INLINE F as_floats(const IntsOf<F>& bits) {
  return simd::bitwise_cast<F>(bits);
}
template <class F>
FASTRT_INLINE IntsOf<F> as_ints(const F& value) {
  return simd::bitwise_cast<IntsOf<F>>(value);
}

// The sign bit of `value`, all other bits 0.
template <class F>
FASTRT_INLINE F sign_bit(const F& value) {
  return as_floats<F>(as_ints(value) & IntsOf<F>(static_cast<std::int32_t>(0x80000000U)));
}
// Flips the sign where `sign` (as sign_bit gives it) is set.
template <class F>
FASTRT_INLINE F flip(const F& value, const F& sign) {
  return as_floats<F>(as_ints(value) ^ as_ints(sign));
}
template <class F>
FASTRT_INLINE F negate(const F& value) {
  return flip(value, F(-0.0F));
}

template <class F>
FASTRT_INLINE float reduce_max(const F& value) {
  if constexpr (width_of<F> == 4) {
    __m128 m = value.data;
    m = _mm_max_ps(m, _mm_movehl_ps(m, m));
    m = _mm_max_ss(m, _mm_shuffle_ps(m, m, 1));
    return _mm_cvtss_f32(m);
  }
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8) {
    return reduce_max(
        Floats<4>(_mm_max_ps(_mm256_castps256_ps128(value.data), _mm256_extractf128_ps(value.data, 1))));
  }
#endif
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) {
    return reduce_max(
        Floats<8>(_mm256_max_ps(_mm512_castps512_ps256(value.data), _mm512_extractf32x8_ps(value.data, 1))));
  }
#endif
}
template <class F>
FASTRT_INLINE float reduce_min(const F& value) {
  return -reduce_max(negate(value));
}

// a * b + c, rounded once where the instruction set can: for culling alone, whose margins cover either.
template <class F>
FASTRT_INLINE F cull_mul_add(const F& a, const F& b, const F& c) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) return F(_mm512_fmadd_ps(a.data, b.data, c.data));
#endif
#if defined(__FMA__)
  if constexpr (width_of<F> == 8) return F(_mm256_fmadd_ps(a.data, b.data, c.data));
  if constexpr (width_of<F> == 4) return F(_mm_fmadd_ps(a.data, b.data, c.data));
#else
  return a * b + c;
#endif
}

// c - a * b and a * b - c, likewise.
template <class F>
FASTRT_INLINE F cull_less(const F& a, const F& b, const F& c) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) return F(_mm512_fnmadd_ps(a.data, b.data, c.data));
#endif
#if defined(__FMA__)
  if constexpr (width_of<F> == 8) return F(_mm256_fnmadd_ps(a.data, b.data, c.data));
  if constexpr (width_of<F> == 4) return F(_mm_fnmadd_ps(a.data, b.data, c.data));
#else
  return c - a * b;
#endif
}
template <class F>
FASTRT_INLINE F cull_mul_sub(const F& a, const F& b, const F& c) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) return F(_mm512_fmsub_ps(a.data, b.data, c.data));
#endif
#if defined(__FMA__)
  if constexpr (width_of<F> == 8) return F(_mm256_fmsub_ps(a.data, b.data, c.data));
  if constexpr (width_of<F> == 4) return F(_mm_fmsub_ps(a.data, b.data, c.data));
#else
  return a * b - c;
#endif
}

// About 1 / a, wrong by 2^-11 of it at most: likewise for culling alone.
template <class F>
FASTRT_INLINE F cull_inverse(const F& a) {
#if defined(__AVX512DQ__)
  if constexpr (width_of<F> == 16) return F(_mm512_rcp14_ps(a.data));
#endif
#if defined(__AVX2__)
  if constexpr (width_of<F> == 8) return F(_mm256_rcp_ps(a.data));
#endif
  if constexpr (width_of<F> == 4) return F(_mm_rcp_ps(a.data));
}

// What shared_math.hpp asks of a batch.
template <int W>
struct BatchOps {
  using F = Floats<W>;
  using I = Ints<W>;
  [[gnu::always_inline]] static inline I bits(const F& x) { return as_ints(x); }
  [[gnu::always_inline]] static inline F from_bits(const I& x) { return as_floats<F>(x); }
  [[gnu::always_inline]] static inline F to_float(const I& x) { return simd::to_float(x); }
  [[gnu::always_inline]] static inline I to_int(const F& x) { return simd::to_int(x); }
  [[gnu::always_inline]] static inline F select(const Mask<W>& mask, const F& yes, const F& no) {
    return simd::select(mask, yes, no);
  }
};

// The same value, in a register: compilers would rather read what they have loaded again, at each use, and in
// some loops loads are what runs out first.
template <class F>
FASTRT_INLINE F in_register(F value) {
#if defined(__AVX512DQ__)
  asm("" : "+v"(value.data));
#else
  asm("" : "+x"(value.data));
#endif
  return value;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
