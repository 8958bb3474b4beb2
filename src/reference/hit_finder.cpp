// SPDX-License-Identifier: Apache-2.0
#include "src/reference/hit_finder.hpp"

#include "src/reference/intersect.hpp"

namespace fastrt::reference {

Hit BruteForce::closest(const Ray& ray) const {
  Hit best{ray.t_max, 0, 0, no_primitive};
  for (std::uint32_t id = 0; id < scene_->primitive_count(); ++id) {
    if (static_cast<std::int32_t>(id) == ray.excluded) continue;
    keep_closest(best, intersect(ray, *scene_, id), id);
  }
  return best;
}

bool BruteForce::any(const Ray& ray) const {
  for (std::uint32_t id = 0; id < scene_->primitive_count(); ++id) {
    if (static_cast<std::int32_t>(id) == ray.excluded) continue;
    if (intersect(ray, *scene_, id).hit) return true;
  }
  return false;
}

} // namespace fastrt::reference
