// SPDX-License-Identifier: Apache-2.0
#include "src/scene/row_counts.hpp"

#include <fastrt/error.hpp>

#include <string>

namespace fastrt {

std::array<std::size_t, 5> row_counts(const SceneDesc& desc) {
  return {desc.triangles.size(), desc.spheres.size(), desc.cones.size(), desc.disks.size(),
          desc.polygons.size()};
}

std::uint32_t checked_size(std::size_t size, const char* what) {
  if (size >= no_index) throw LimitError(std::string("too many ") + what);
  return static_cast<std::uint32_t>(size);
}

std::array<std::uint32_t, 5> checked_row_counts(const SceneDesc& desc) {
  const std::array<std::size_t, 5> sizes = row_counts(desc);
  std::array<std::uint32_t, 5> counts{};
  for (std::size_t kind = 0; kind < counts.size(); ++kind)
    counts[kind] = checked_size(sizes[kind], row_kind_names[kind]);
  return counts;
}

} // namespace fastrt
