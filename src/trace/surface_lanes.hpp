// SPDX-License-Identifier: Apache-2.0
// A surface per lane: what the surfaces of all kinds of primitives have in common.
#pragma once

#include "src/kernels/vec3.hpp"
#include "src/simd/gather.hpp"
#include "src/trace/scene_view.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

using PathF = Floats<widest>;
using PathI = Ints<widest>;
using PathM = Mask<widest>;
using PathV = V3<PathF>;

// What the scene's columns hold in a place per lane.
FASTRT_INLINE PathV gather3(const float* x, const float* y, const float* z, const PathI& places,
                            std::uint32_t bits) {
  return {gather(x, places, bits), gather(y, places, bits), gather(z, places, bits)};
}

// One surface per lane.
struct Surface {
  PathV point, geometric, shading;
  PathF magnitude;
};

FASTRT_INLINE Surface select(const PathM& mask, const Surface& yes, const Surface& no) {
  return {select(mask, yes.point, no.point), select(mask, yes.geometric, no.geometric),
          select(mask, yes.shading, no.shading), simd::select(mask, yes.magnitude, no.magnitude)};
}

// Calls use(row, mask, bits) once for each material among the lanes in `bits`.
template <class Use>
FASTRT_INLINE void for_each_material(const ShadingView& scene, const std::int32_t* materials,
                                     std::uint32_t bits, const Use& use) {
  const PathI ids = load<PathI>(materials);
  while (bits != 0) {
    const std::int32_t id = materials[__builtin_ctz(bits)];
    const std::uint32_t same = to_bits(simd::bool_cast(ids == PathI(id))) & bits;
    use(scene.materials[id], from_bits<widest>(same), same);
    bits &= ~same;
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
