// SPDX-License-Identifier: Apache-2.0
// The blocks of a leaf as lanes: two blocks fill a register of eight, where there are such.
#pragma once

#include "src/kernels/triangle.hpp"
#include "src/trace/scene_view.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

inline constexpr int leaf_lanes = widest < 2 * block_size ? block_size : 2 * block_size;
inline constexpr std::uint32_t blocks_at_once = leaf_lanes / block_size;
using LeafF = Floats<leaf_lanes>;

// Blocks that are met together. Lanes 0 .. lanes - 1 count; where one block is left, the others repeat it.
template <class Block>
struct BlockRun {
  const Block* low;
  const Block* high;
  int lanes;

  [[gnu::always_inline]] inline const Block& block_of(int lane) const {
    return lane < block_size ? *low : *high;
  }
  [[gnu::always_inline]] inline std::int32_t primitive(int lane) const {
    return block_of(lane).primitive[lane % block_size];
  }
};

// Calls meet(run) for the blocks of a leaf, as many at once as fit.
template <class Block, class Meet>
FASTRT_INLINE void for_each_run(const Block* blocks, std::uint32_t leaf, const Meet& meet) {
  const Block* block = blocks + leaf_first_block(leaf);
  for (std::uint32_t left = leaf_blocks(leaf); left != 0;) {
    const std::uint32_t taken = left < blocks_at_once ? left : blocks_at_once;
    meet(BlockRun<Block>{block, block + (taken - 1), static_cast<int>(taken) * block_size});
    block += taken;
    left -= taken;
  }
}

// The blocks of a leaf that are met first.
template <class Block>
FASTRT_INLINE BlockRun<Block> first_run(const Block* blocks, std::uint32_t leaf) {
  const std::uint32_t left = leaf_blocks(leaf), taken = left < blocks_at_once ? left : blocks_at_once;
  const Block* const block = blocks + leaf_first_block(leaf);
  return {block, block + (taken - 1), static_cast<int>(taken) * block_size};
}

// The primitives of all lanes.
template <class Block>
FASTRT_INLINE IntsOf<LeafF> primitives_of(const BlockRun<Block>& run) {
  return as_ints(load_two<LeafF>(reinterpret_cast<const float*>(run.low->primitive),
                                 reinterpret_cast<const float*>(run.high->primitive)));
}

// Vertex v of the run's triangles.
FASTRT_INLINE V3<LeafF> load_vertices(const BlockRun<TriangleBlock>& run, int v) {
  return {load_two<LeafF>(run.low->x[v], run.high->x[v]), load_two<LeafF>(run.low->y[v], run.high->y[v]),
          load_two<LeafF>(run.low->z[v], run.high->z[v])};
}

// Vertex v of the triangle in one lane of a run, spread over a register.
template <class F, class Run>
FASTRT_INLINE V3<F> spread_vertex(const Run& run, int v, int lane) {
  const TriangleBlock& block = run.block_of(lane);
  const int i = lane % block_size;
  return broadcast3<F>(block.x[v][i], block.y[v][i], block.z[v][i]);
}

FASTRT_INLINE V3<LeafF> load_centers(const BlockRun<SphereBlock>& run) {
  return {load_two<LeafF>(run.low->x, run.high->x), load_two<LeafF>(run.low->y, run.high->y),
          load_two<LeafF>(run.low->z, run.high->z)};
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
