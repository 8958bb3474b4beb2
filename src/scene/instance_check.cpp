// SPDX-License-Identifier: Apache-2.0
// Prototypes and instances before anything is traced.
#include "src/scene/finite.hpp"
#include "src/scene/row_counts.hpp"
#include "src/scene/scene_check.hpp"
#include "src/scene/shapes.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace fastrt {
namespace {

[[noreturn]] void refuse(const char* what, std::size_t i, const std::string& why) {
  throw InputError(std::string(what) + " " + std::to_string(i) + ": " + why);
}

void check_ranges(const SceneDesc& desc) {
  const std::array<std::size_t, 5> counts = row_counts(desc);
  for (std::size_t i = 0; i < desc.prototypes.size(); ++i)
    for (std::size_t kind = 0; kind < 5; ++kind) {
      const std::uint32_t begin = desc.prototypes[i].begin[kind], end = desc.prototypes[i].end[kind];
      if (begin <= end && end <= counts[kind]) continue;
      refuse("prototype", i,
             std::string("has the ") + row_kind_names[kind] + " from " + std::to_string(begin) + " to " +
                 std::to_string(end) + ", but there are " + std::to_string(counts[kind]));
    }
}

// No primitive belongs to two prototypes.
void check_apart(const SceneDesc& desc) {
  for (std::size_t kind = 0; kind < 5; ++kind) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < desc.prototypes.size(); ++i)
      if (desc.prototypes[i].begin[kind] != desc.prototypes[i].end[kind]) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return desc.prototypes[a].begin[kind] < desc.prototypes[b].begin[kind];
    });
    for (std::size_t k = 1; k < order.size(); ++k)
      if (desc.prototypes[order[k]].begin[kind] < desc.prototypes[order[k - 1]].end[kind])
        refuse("prototype", std::max(order[k], order[k - 1]),
               std::string("shares ") + row_kind_names[kind] + " with prototype " +
                   std::to_string(std::min(order[k], order[k - 1])));
  }
}

// limit: how many there are of what `index` refers to.
void check_index(std::size_t i, std::uint32_t index, std::size_t limit, bool optional, const char* what) {
  if (index < limit || (optional && index == no_index)) return;
  refuse("instance", i,
         std::string("refers to ") + what + " " + std::to_string(index) + ", but there are " +
             std::to_string(limit));
}

void check_map(std::size_t i, const Affine& map) {
  if (!(is_finite(map.x) && is_finite(map.y) && is_finite(map.z) && is_finite(map.origin)))
    refuse("instance", i, "a number of its map is not finite");
  Affine inverse;
  float growth = 0;
  if (!invert(map, inverse, growth)) refuse("instance", i, "its map can't be inverted: it makes things flat");
}

} // namespace

void check_instances(const SceneDesc& desc) {
  check_ranges(desc);
  check_apart(desc);
  const InstanceColumns& instances = desc.instances;
  const std::size_t count = instances.size();
  if (instances.to_world.size() != count || instances.material.size() != count ||
      instances.object.size() != count)
    throw InputError("the instances' columns differ in length");
  for (std::size_t i = 0; i < count; ++i) {
    check_index(i, instances.prototype[i], desc.prototypes.size(), false, "prototype");
    check_index(i, instances.material[i], desc.materials.size(), true, "material");
    check_index(i, instances.object[i], desc.object_names.size(), true, "object");
    check_map(i, instances.to_world[i]);
  }
}

} // namespace fastrt
