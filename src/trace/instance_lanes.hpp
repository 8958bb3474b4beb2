// SPDX-License-Identifier: Apache-2.0
// Hits on instances, a lane each: rays to object space, surfaces back to the world (docs/numerics.md,
// "Instances").
#pragma once

#include "src/kernels/instances.hpp"
#include "src/trace/surface_lanes.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

inline constexpr std::uint32_t no_override = no_row;

// The instance that a hit's id stands for, or null for a primitive.
FASTRT_INLINE const InstanceRow* instance_of(const ShapeView& shapes, std::int32_t id) {
  if (shapes.instance_count == 0 || id < shapes.first_instance) return nullptr;
  return shapes.instances + (id - shapes.first_instance);
}

// The primitive that hit i of a batch shows, in an instance or not; -1 for a miss.
FASTRT_INLINE std::int32_t shown_primitive(const ShapeView& shapes, const HitBatch& hits, int i) {
  return instance_of(shapes, hits.primitive[i]) != nullptr ? hits.inner[i] : hits.primitive[i];
}

// The maps of the instances that rays hit.
struct InstanceLanes {
  PathV to_object[4], to_world[4];
  PathF growth;                               // 1 in the other lanes
  alignas(64) std::int32_t primitive[widest]; // of all lanes: what is shown
  PathI rows;                                 // words from one instance's row to this one's
  std::uint32_t bits;                         // lanes that hit instances
};

inline constexpr std::int32_t instance_words = sizeof(InstanceRow) / sizeof(float);

// word(row): a number of an instance's row, for the lanes that hit instances; where all hit one, it is read
// once.
template <class Word>
FASTRT_INLINE PathF gather_word(const ShapeView& shapes, const InstanceLanes& lanes, const InstanceRow* only,
                                const Word& word) {
  return only != nullptr ? PathF(*word(*only)) : gather(word(*shapes.instances), lanes.rows, lanes.bits);
}

FASTRT_INLINE void gather_map(const ShapeView& shapes, const InstanceLanes& lanes, const InstanceRow* only,
                              float (InstanceRow::*map)[4][3], PathV (&out)[4]) {
  for (int column = 0; column < 4; ++column) {
    const auto axis = [&](int c) {
      return gather_word(shapes, lanes, only, [&](const InstanceRow& row) { return &(row.*map)[column][c]; });
    };
    out[column] = {axis(0), axis(1), axis(2)};
  }
}

FASTRT_INLINE void gather_instances(const ShapeView& shapes, const HitBatch& hits, int i, int count,
                                    InstanceLanes& lanes) {
  const PathI ids = PathI::load_aligned(hits.primitive + i), places = ids - PathI(shapes.first_instance);
  lanes.bits = 0;
  lanes.growth = PathF(1.0F);
  ids.store_aligned(lanes.primitive);
  if (shapes.instance_count == 0) return;
  const PathM mask = simd::bool_cast(places >= PathI(0));
  lanes.bits = to_bits(mask) & lanes_in(count);
  if (lanes.bits == 0) return;
  select_ints<PathF>(mask, PathI::load_aligned(hits.inner + i), ids).store_aligned(lanes.primitive);
  lanes.rows = places * PathI(instance_words);
  const std::int32_t first = hits.primitive[i + __builtin_ctz(lanes.bits)];
  const bool is_one = (to_bits(simd::bool_cast(ids == PathI(first))) & lanes.bits) == lanes.bits;
  const InstanceRow* const only = is_one ? shapes.instances + (first - shapes.first_instance) : nullptr;
  gather_map(shapes, lanes, only, &InstanceRow::to_object, lanes.to_object);
  gather_map(shapes, lanes, only, &InstanceRow::to_world, lanes.to_world);
  const PathF growth = gather_word(shapes, lanes, only, [](const InstanceRow& row) { return &row.growth; });
  lanes.growth = simd::select(from_bits<widest>(lanes.bits), growth, lanes.growth);
}

FASTRT_INLINE PathV map_vector(const PathV (&map)[4], const PathV& v) {
  return (map[0] * v.x + map[1] * v.y) + map[2] * v.z;
}
FASTRT_INLINE PathV map_point(const PathV (&map)[4], const PathV& p) { return map_vector(map, p) + map[3]; }

// By the transpose of the inverse.
FASTRT_INLINE PathV map_normal(const PathV (&inverse)[4], const PathV& n) {
  const PathV mapped{dot(inverse[0], n), dot(inverse[1], n), dot(inverse[2], n)};
  return normalize(mapped / largest(mapped));
}

FASTRT_INLINE PathV magnitudes(const PathV& v) { return {abs(v.x), abs(v.y), abs(v.z)}; }

FASTRT_INLINE PathF map_magnitude(const PathV (&map)[4], const PathF& magnitude) {
  const PathV sum = (magnitudes(map[0]) + magnitudes(map[1])) + magnitudes(map[2]);
  return largest(sum * magnitude + magnitudes(map[3]));
}

// The rays that hit instances in object space, the others as they are.
FASTRT_INLINE void rays_to_objects(const InstanceLanes& lanes, PathV& origin, PathV& dir) {
  const PathM mask = from_bits<widest>(lanes.bits);
  origin = select(mask, map_point(lanes.to_object, origin), origin);
  dir = select(mask, map_vector(lanes.to_object, dir), dir);
}

// The surfaces of instances in the world, the others as they are.
FASTRT_INLINE void surfaces_to_world(const InstanceLanes& lanes, Surface& s) {
  const Surface mapped{map_point(lanes.to_world, s.point), map_normal(lanes.to_object, s.geometric),
                       map_normal(lanes.to_object, s.shading),
                       map_magnitude(lanes.to_world, s.magnitude) * lanes.growth};
  s = select(from_bits<widest>(lanes.bits), mapped, s);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
