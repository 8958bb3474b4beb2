// SPDX-License-Identifier: Apache-2.0
// Points of lights that are meshes, a register of them at a time.
#pragma once

#include "src/film/light_sampling.hpp"
#include "src/trace/surface_lanes.hpp"
#include "src/trace/tile_job.hpp"

#include <xmmintrin.h>

namespace fastrt::FASTRT_ISA_NAMESPACE {

FASTRT_INLINE MeshShares shares_of(const LightRow& light) {
  return {light.emitter_begin, light.emitter_scale, light.emitter_count};
}

struct SampleNumber {
  std::uint32_t index, count;
};
FASTRT_INLINE LightBits bits_of(const SampleNumber& number, const LightBatch& keys, int i) {
  return light_sample(number.index, number.count, {keys.key_u[i], keys.key_v[i]}, keys.first[i]);
}

// Samples of a batch under way.
struct MeshSamples {
  alignas(64) std::uint32_t u[batch_size], v[batch_size]; // then how far u lies in what chooses the triangle
  std::uint32_t triangle[batch_size];
  alignas(64) float scale[batch_size];
  alignas(64) float a[batch_size], b[batch_size], c[batch_size]; // weights of the corners
};

// Loops of their own: what is written one by one and read as a register soon after makes the reader wait.
FASTRT_INLINE void choose_triangles(const MeshShares& mesh, const SampleNumber& number, int count,
                                    const LightBatch& keys, MeshSamples& samples) {
  for (int i = 0; i < count; ++i) {
    const LightBits bits = bits_of(number, keys, i);
    samples.u[i] = bits.u;
    samples.v[i] = bits.v;
  }
  for (int i = 0; i < count; ++i) {
    const std::uint32_t chosen = choose_triangle(mesh, samples.u[i]);
    samples.u[i] -= mesh.begin[chosen];
    samples.scale[i] = mesh.scale[chosen];
    samples.triangle[i] = chosen;
  }
}

// mesh_place(), a register at a time.
FASTRT_INLINE void weigh_corners(int count, MeshSamples& samples) {
  const PathF one(1.0F);
  for (int i = 0; i < count; i += widest) {
    const auto load_bits = [&](const std::uint32_t* bits) {
      return PathI::load_aligned(reinterpret_cast<const std::int32_t*>(bits + i));
    };
    const PathI left = (load_bits(samples.u) >> 1) & PathI(0x7FFFFFFF);
    const PathI along_bits = (load_bits(samples.v) >> 8) & PathI(0x00FFFFFF);
    const PathF rest = simd::to_float(left) * PathF::load_aligned(samples.scale + i);
    const PathF root = sqrt(min(rest, one)), along = simd::to_float(along_bits) * PathF(0x1p-24F);
    store3(PathV{one - root, root * (one - along), root * along}, samples.a + i, samples.b + i,
           samples.c + i);
  }
}

// Four points (x, y, z and anything) into columns.
FASTRT_INLINE void store_columns(__m128 p, __m128 q, __m128 r, __m128 s, int i, float* x, float* y,
                                 float* z) {
  _MM_TRANSPOSE4_PS(p, q, r, s);
  _mm_store_ps(x + i, p);
  _mm_store_ps(y + i, q);
  _mm_store_ps(z + i, r);
}

static void place_on_mesh(const LightRow& light, const SampleNumber& number, int count,
                          LightBatch& out) noexcept {
  const int end = (count + widest - 1) / widest * widest;
  MeshSamples samples;
  choose_triangles(shares_of(light), number, end, out, samples);
  weigh_corners(end, samples);
  for (int i = 0; i < end; i += 4) {
    const auto row = [&](int k) -> const EmitterRow& { return light.emitters[samples.triangle[i + k]]; };
    const auto point = [&](int k) {
      const auto weighed = [&](int corner, const float* weights) {
        return _mm_mul_ps(_mm_load_ps(row(k).corners[corner]), _mm_set1_ps(weights[i + k]));
      };
      return _mm_add_ps(_mm_add_ps(weighed(0, samples.a), weighed(1, samples.b)), weighed(2, samples.c));
    };
    const auto normal = [&](int k) { return _mm_load_ps(row(k).normal); };
    store_columns(point(0), point(1), point(2), point(3), i, out.position_x, out.position_y, out.position_z);
    store_columns(normal(0), normal(1), normal(2), normal(3), i, out.normal_x, out.normal_y, out.normal_z);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
