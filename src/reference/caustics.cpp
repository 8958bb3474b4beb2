// SPDX-License-Identifier: Apache-2.0
#include "src/film/photon_sampling.hpp"
#include "src/reference/photons.hpp"

#include <mutex>

namespace fastrt::reference {

PhotonMap trace_caustics(const Scene& scene, const HitFinder& finder, const PhotonPlan& plan,
                         const std::vector<PhotonChunk>& chunks, const RenderSettings& settings,
                         FrameProgress& progress) {
  std::vector<Photon> photons;
  std::mutex mutex;
  const auto keep = [&](const Arrival& arrival, RayCounts&) {
    const PhotonNode& photon = arrival.photon;
    if (!photon.bent) return;
    const Vec3 flux = (photon.weight * arrival.strength) * arrival.light->flux;
    const std::lock_guard lock(mutex);
    photons.push_back({arrival.surface.point, arrival.surface.geometric_normal, flux, arrival.row,
                       photon.index, photon.key});
  };
  trace_photons(scene, finder, plan, chunks, settings, false, keep, progress);
  return make_photon_map(std::move(photons), plan.count, settings.caustic_radius);
}

Vec3 caustic_light(const PhotonMap& map, const Surface& surface) {
  Vec3 sum{0.0F};
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Vec3 way = Vec3(map.x[i], map.y[i], map.z[i]) - surface.point;
    const float d2 = glm::dot(way, way);
    if (!(d2 < map.radius2)) continue;
    const Vec3 normal(map.normal_x[i], map.normal_y[i], map.normal_z[i]);
    if (!(glm::dot(normal, surface.geometric_normal) > same_surface)) continue;
    sum = sum + Vec3(map.r[i], map.g[i], map.b[i]) * (1.0F - d2 * map.inverse_radius2);
  }
  return sum * map.scale;
}

} // namespace fastrt::reference
