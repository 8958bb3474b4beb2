// SPDX-License-Identifier: Apache-2.0
// Compiled once per ISA, by fastrt_kernels() in cmake/FastrtTargets.cmake.
#include "src/kernels/kernel_table.hpp"

#include "src/kernels/pair_kernels.hpp"
#include "src/trace/hit_weights.hpp"
#include "src/trace/photons.hpp"
#include "src/trace/render_tile.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

const KernelTable& kernel_table() noexcept {
  static constexpr KernelTable table{
      find_closest_hits, find_any_hits, hit_weights, render_tile, trace_photons,
      meet_triangles,    meet_spheres,  meet_boxes,  powers,      exponentials};
  return table;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
