// SPDX-License-Identifier: Apache-2.0
#include "src/load/warn.hpp"

#include "src/scene/row_counts.hpp"

#include <fastrt/error.hpp>

#include <cstddef>

namespace fastrt {

namespace {

// Those of prototypes are seen in instances alone.
bool has_primitives(const SceneDesc& desc) {
  if (desc.planes.size() != 0 || desc.instances.size() != 0) return true;
  auto rows = checked_row_counts(desc);
  for (const Prototype& prototype : desc.prototypes)
    for (std::size_t kind = 0; kind < rows.size(); ++kind)
      rows[kind] -= prototype.end[kind] - prototype.begin[kind];
  for (const std::uint32_t count : rows)
    if (count != 0) return true;
  return false;
}

} // namespace

void warn(const char* kind, const std::string& message, bool strict, Diagnostics& diagnostics) {
  if (strict) throw InputError(message);
  diagnostics.warn(kind, message);
}

void warn_without_primitives(const SceneDesc& desc, const std::string& name, bool strict,
                             Diagnostics& diagnostics) {
  if (!has_primitives(desc)) warn("no primitives", name + ": no primitives", strict, diagnostics);
}

} // namespace fastrt
