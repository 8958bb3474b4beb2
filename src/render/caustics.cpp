// SPDX-License-Identifier: Apache-2.0
#include "src/render/caustics.hpp"

#include "src/scene/photon_targets.hpp"

namespace fastrt {
namespace {

PhotonLevelView view_of(const PhotonLevel& level) {
  PhotonLevelView view{{level.x.data(), level.y.data(), level.z.data()},
                       {level.normal_x.data(), level.normal_y.data(), level.normal_z.data()},
                       {level.r.data(), level.g.data(), level.b.data()},
                       level.cell_x.data(),
                       level.row_begin.data(),
                       {level.size_x, level.size_y, level.size_z},
                       {},
                       {},
                       level.inverse_side,
                       level.radius,
                       level.radius2,
                       level.inverse_radius2,
                       level.height2};
  for (int axis = 0; axis < 3; ++axis) {
    view.low[axis] = level.bounds.lower[axis];
    view.high[axis] = level.bounds.upper[axis];
  }
  return view;
}

} // namespace

Caustics::Caustics(const Tracer::Parts& parts, const RenderSettings& settings)
    : scene_(parts), plan_(plan_caustic_photons(parts.scene, settings.caustic_photons)),
      chunks_(photon_chunks(plan_)), pass_(make_photon_pass(parts, scene_, plan_, chunks_, settings)),
      radius_(settings.caustic_radius), reach_(caustic_reach(parts.scene)) {}

void Caustics::trace(FrameProgress& progress) {
  map_ = make_photon_map(trace_photons(pass_, progress), plan_.count, radius_, reach_);
  for (const PhotonLevel& level : map_.levels) levels_.push_back(view_of(level));
  view_ = {levels_.data(), static_cast<int>(levels_.size())};
}

} // namespace fastrt
