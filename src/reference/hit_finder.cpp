// SPDX-License-Identifier: Apache-2.0
#include "src/reference/hit_finder.hpp"

#include "src/reference/instances.hpp"

namespace fastrt::reference {

// Primitives begin .. end - 1.
template <bool any_will_do>
void BruteForce::meet(const Ray& ray, std::uint32_t begin, std::uint32_t end, Hit& best) const {
  for (std::uint32_t id = begin; id < end; ++id) {
    if (any_will_do && best.found()) return;
    if (static_cast<std::int32_t>(id) == ray.excluded && ray.excluded_instance == no_instance) continue;
    keep_closest(best, intersect(ray, *scene_, id), id);
  }
}

template <bool any_will_do>
Hit BruteForce::meet_prototype(const Ray& ray, const Prototype& prototype) const {
  Hit best{ray.t_max, 0, 0, no_primitive};
  for (std::size_t kind = 0; kind < prototype.begin.size(); ++kind) {
    const std::uint32_t first = scene_->first_of(static_cast<PrimitiveKind>(kind));
    meet<any_will_do>(ray, first + prototype.begin[kind], first + prototype.end[kind], best);
  }
  return best;
}

template <bool any_will_do>
Hit BruteForce::meet_all(const Ray& ray) const {
  Hit best{ray.t_max, 0, 0, no_primitive};
  const KindRanges& world = scene_->shapes().world;
  for (std::size_t kind = 0; kind < world.size(); ++kind) {
    const std::uint32_t first = scene_->first_of(static_cast<PrimitiveKind>(kind));
    for (const RowRange& rows : world[kind])
      meet<any_will_do>(ray, first + rows.begin, first + rows.end, best);
  }
  meet<any_will_do>(ray, scene_->first_of(PrimitiveKind::plane), scene_->primitive_count(), best);
  const SceneDesc& desc = scene_->desc();
  for (std::uint32_t i = 0; i < scene_->instance_count(); ++i) {
    if (any_will_do && best.found()) break;
    const Prototype& prototype = desc.prototypes[desc.instances.prototype[i]];
    meet_instance(*scene_, ray, i, best,
                  [&](const Ray& inner) { return meet_prototype<any_will_do>(inner, prototype); });
  }
  return best;
}

Hit BruteForce::closest(const Ray& ray) const { return meet_all<false>(ray); }
bool BruteForce::any(const Ray& ray) const { return meet_all<true>(ray).found(); }

} // namespace fastrt::reference
