// SPDX-License-Identifier: Apache-2.0
#include "src/render/caustics.hpp"

#include <utility>

namespace fastrt {
namespace {

PhotonMapView view_of(const PhotonMap& map) {
  PhotonMapView view{{map.x.data(), map.y.data(), map.z.data()},
                     {map.normal_x.data(), map.normal_y.data(), map.normal_z.data()},
                     {map.r.data(), map.g.data(), map.b.data()},
                     map.cell_x.data(),
                     map.row_begin.data(),
                     {map.size_x, map.size_y, map.size_z},
                     {},
                     {},
                     map.inverse_side,
                     map.radius,
                     map.radius2,
                     map.inverse_radius2,
                     map.scale};
  for (int axis = 0; axis < 3; ++axis) {
    view.low[axis] = map.bounds.lower[axis];
    view.high[axis] = map.bounds.upper[axis];
  }
  return view;
}

} // namespace

Caustics::Caustics(const Tracer::Parts& parts, const RenderSettings& settings)
    : scene_(parts), plan_(plan_caustic_photons(parts.scene, settings.caustic_photons)),
      chunks_(photon_chunks(plan_)), pass_(make_photon_pass(parts, scene_, plan_, chunks_, settings)),
      radius_(settings.caustic_radius) {}

void Caustics::trace(FrameProgress& progress) {
  map_ = make_photon_map(trace_photons(pass_, progress), plan_.count, radius_);
  view_ = view_of(map_);
}

} // namespace fastrt
