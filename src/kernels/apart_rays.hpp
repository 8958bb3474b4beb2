// SPDX-License-Identifier: Apache-2.0
// Rays of a coherent batch that point too widely apart for the beams of their neighbours, where leaves hold
// triangles alone. Those that follow the same axis of space the same way go as beams of their own, however
// far from each other they lie in the batch; where they are few, each goes alone.
#pragma once

#include "src/kernels/beam_traversal.hpp"
#include "src/kernels/packed_batch.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Fewer rays of one way than this go alone.
inline constexpr int least_way = 24;

// Along x, against it, along y ..
inline constexpr int way_count = 6;
struct RayWays {
  RayBits rays[way_count];
};

// The rays of a batch in `asked` that can hit something, by the axis that they follow most.
FASTRT_INLINE void find_ways(const RayBatch& rays, const RayBits& asked, RayWays& ways) {
  const PacketF zero(0.0F);
  for (int i = 0; i < rays.count; i += widest) {
    const int g = i / group_size, shift = i % group_size;
    std::uint32_t bits = asked.of_group[g] >> shift & register_bits;
    if (bits == 0) continue;
    const V3<PacketF> dir = load_dir(rays, i);
    bits &= to_bits(traceable_lanes(load_origin(rays, i), dir, rays.count - i) &
                    (PacketF::load_aligned(rays.t_min + i) < PacketF::load_aligned(rays.t_max + i)));
    const PacketF x = abs(dir.x), y = abs(dir.y), z = abs(dir.z);
    const std::uint32_t along_x = to_bits((x > y) & (x > z)) & bits,
                        along_y = to_bits((y >= x) & (y > z)) & bits, along_z = bits & ~(along_x | along_y);
    const auto add = [&](int axis, std::uint32_t along, const PacketF& step) {
      const std::uint32_t against = to_bits(step < zero);
      ways.rays[2 * axis].of_group[g] |= (along & ~against) << shift;
      ways.rays[2 * axis + 1].of_group[g] |= (along & against) << shift;
    };
    add(0, along_x, dir.x);
    add(1, along_y, dir.y);
    add(2, along_z, dir.z);
  }
}

FASTRT_INLINE int count_rays(const RayBits& rays) {
  int count = 0;
  for (const std::uint32_t bits : rays.of_group) count += __builtin_popcount(bits);
  return count;
}

// Appends the places in the batch of the rays in `bits`, first .. on.
FASTRT_INLINE int list_rays(std::uint64_t bits, int first, std::uint8_t* which, int count) {
  for (; bits != 0; bits &= bits - 1)
    which[count++] = static_cast<std::uint8_t>(first + __builtin_ctzll(bits));
  return count;
}

// The rays of one way as beams. Returns how many rays there are in `alone`, to which those are appended that
// no beam takes.
template <bool any>
[[gnu::noinline]] static int trace_way(const GeometryView& scene, const RayBatch& rays, const RayBits& way,
                                       HitBatch& hits, std::uint8_t* alone, int count) noexcept {
  PackedBatch packed;
  pack_rays(rays, way, packed);
  clear_hits(packed.rays, packed.hits);
  packed.hits.boxes = packed.hits.primitives = packed.hits.lone = 0;
  LoneColumns columns;
  columns.ready = 0;
  const int end = (packed.rays.count + group_size - 1) / group_size * group_size;
  for (int first = 0; first < end; first += beam_size) {
    const BeamRest rest = trace_beam<any>(scene, packed.rays, packed.hits, columns, first,
                                          end - first < beam_size ? end - first : beam_size);
    for (std::uint64_t left = rest.apart | rest.alone; left != 0; left &= left - 1) {
      const int k = first + __builtin_ctzll(left);
      if (k < packed.rays.count) alone[count++] = static_cast<std::uint8_t>(packed.row[k]);
    }
  }
  unpack_hits(packed, hits);
  return count;
}

// The rays in `apart`, and those of the batch whose places are the first `count` of `alone`.
template <bool any>
[[gnu::noinline]] static void trace_apart(const GeometryView& scene, const RayBatch& rays,
                                          const RayBits& apart, HitBatch& hits, LoneColumns& columns,
                                          std::uint8_t* alone, int count) noexcept {
  RayWays ways{};
  find_ways(rays, apart, ways);
  for (const RayBits& way : ways.rays) {
    const int size = count_rays(way);
    if (size >= least_way) {
      count = trace_way<any>(scene, rays, way, hits, alone, count);
    } else if (size != 0) {
      for (int g = 0; g < batch_groups; ++g) count = list_rays(way.of_group[g], g * group_size, alone, count);
    }
  }
  trace_lone_rays<any>(scene, {rays, hits, columns, scene.root, nullptr, alone, alone + count});
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
