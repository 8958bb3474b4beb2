// SPDX-License-Identifier: Apache-2.0
// Hits on instances, a lane each: rays to object space, surfaces back to the world (docs/numerics.md,
// "Instances").
#pragma once

#include "src/kernels/instances.hpp"
#include "src/trace/surface_lanes.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

inline constexpr std::uint32_t no_override = 0xFFFFFFFFU;

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
  alignas(64) float to_object[4][3][widest], to_world[4][3][widest], growth[widest];
  alignas(64) std::int32_t primitive[widest]; // of all lanes: what is shown
  std::uint32_t bits;                         // lanes that hit instances
};

FASTRT_INLINE void gather_instances(const ShapeView& shapes, const HitBatch& hits, int i, int count,
                                    InstanceLanes& lanes) {
  for (int lane = 0; lane < count; ++lane) {
    lanes.primitive[lane] = hits.primitive[i + lane];
    lanes.growth[lane] = 1.0F;
    const InstanceRow* row = instance_of(shapes, hits.primitive[i + lane]);
    if (row == nullptr) continue;
    lanes.bits |= 1U << lane;
    lanes.primitive[lane] = hits.inner[i + lane];
    lanes.growth[lane] = row->growth;
    for (int column = 0; column < 4; ++column)
      for (int c = 0; c < 3; ++c) {
        lanes.to_object[column][c][lane] = row->to_object[column][c];
        lanes.to_world[column][c][lane] = row->to_world[column][c];
      }
  }
}

FASTRT_INLINE PathV map_column(const float (&map)[4][3][widest], int column) {
  return {PathF::load_aligned(map[column][0]), PathF::load_aligned(map[column][1]),
          PathF::load_aligned(map[column][2])};
}
FASTRT_INLINE PathV map_vector(const float (&map)[4][3][widest], const PathV& v) {
  return (map_column(map, 0) * v.x + map_column(map, 1) * v.y) + map_column(map, 2) * v.z;
}
FASTRT_INLINE PathV map_point(const float (&map)[4][3][widest], const PathV& p) {
  return map_vector(map, p) + map_column(map, 3);
}

// By the transpose of the inverse.
FASTRT_INLINE PathV map_normal(const float (&inverse)[4][3][widest], const PathV& n) {
  const PathV mapped{dot(map_column(inverse, 0), n), dot(map_column(inverse, 1), n),
                     dot(map_column(inverse, 2), n)};
  return normalize(mapped / largest(mapped));
}

FASTRT_INLINE PathV magnitudes(const PathV& v) { return {abs(v.x), abs(v.y), abs(v.z)}; }

FASTRT_INLINE PathF map_magnitude(const float (&map)[4][3][widest], const PathF& magnitude) {
  const PathV sum =
      (magnitudes(map_column(map, 0)) + magnitudes(map_column(map, 1))) + magnitudes(map_column(map, 2));
  return largest(sum * magnitude + magnitudes(map_column(map, 3)));
}

// The rays that hit instances in object space, the others as they are.
FASTRT_INLINE void rays_to_objects(const InstanceLanes& lanes, PathV& origin, PathV& dir) {
  const PathM mask = from_bits<widest>(lanes.bits);
  origin = select(mask, map_point(lanes.to_object, origin), origin);
  dir = select(mask, map_vector(lanes.to_object, dir), dir);
}

// The surfaces of instances in the world, the others as they are.
FASTRT_INLINE void surfaces_to_world(const InstanceLanes& lanes, Surface& s) {
  const PathF growth = PathF::load_aligned(lanes.growth);
  const Surface mapped{map_point(lanes.to_world, s.point), map_normal(lanes.to_object, s.geometric),
                       map_normal(lanes.to_object, s.shading),
                       map_magnitude(lanes.to_world, s.magnitude) * growth};
  s = select(from_bits<widest>(lanes.bits), mapped, s);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
