// SPDX-License-Identifier: Apache-2.0
#include "src/film/photon_sampling.hpp"
#include "src/reference/photons.hpp"
#include "src/scene/photon_targets.hpp"

#include <array>
#include <mutex>

namespace fastrt::reference {

PhotonMap trace_caustics(const Scene& scene, const HitFinder& finder, const Surroundings& around,
                         const PhotonPlan& plan, const std::vector<PhotonChunk>& chunks,
                         const RenderSettings& settings, FrameProgress& progress) {
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
  trace_photons(scene, finder, around, plan, chunks, settings, false, keep, progress);
  return make_photon_map(std::move(photons), plan.count, settings.caustic_radius, caustic_reach(scene));
}

namespace {

void add_level(const PhotonLevel& level, const Surface& surface, std::array<Vec3, photon_sums>& sums) {
  for (std::size_t i = 0; i < level.size(); ++i) {
    const Vec3 way = Vec3(level.x[i], level.y[i], level.z[i]) - surface.point;
    const float d2 = glm::dot(way, way);
    if (!(d2 < level.radius2)) continue;
    const Vec3 normal(level.normal_x[i], level.normal_y[i], level.normal_z[i]);
    const float height = glm::dot(way, normal);
    if (!(height * height < level.height2)) continue;
    if (!(glm::dot(normal, surface.geometric_normal) > same_surface)) continue;
    Vec3& sum = sums[i % photon_sums];
    sum = sum + Vec3(level.r[i], level.g[i], level.b[i]) * (1.0F - d2 * level.inverse_radius2);
  }
}

} // namespace

Vec3 caustic_light(const PhotonMap& map, const Surface& surface) {
  std::array<Vec3, photon_sums> sums;
  sums.fill(Vec3(0.0F));
  for (const PhotonLevel& level : map.levels) add_level(level, surface, sums);
  Vec3 light = sums[0];
  for (std::size_t i = 1; i < photon_sums; ++i) light = light + sums[i];
  return light;
}

} // namespace fastrt::reference
