// SPDX-License-Identifier: Apache-2.0
#include "src/trace/point_media.hpp"

#include "src/scene/media_probe.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <vector>

namespace fastrt {
namespace {

using MediaList = std::array<std::int32_t, max_media>; // innermost first

// The materials of the media whose surfaces are met on the way from a point, in order, per probe.
using Crossings = std::array<std::vector<std::int32_t>, media_probes>;

void aim_probes(const Vec3& point, RayBatch& rays) {
  rays.count = media_probes;
  rays.shape = BatchShape::any;
  for (int i = 0; i < media_probes; ++i) {
    rays.origin_x[i] = point.x;
    rays.origin_y[i] = point.y;
    rays.origin_z[i] = point.z;
    rays.dir_x[i] = media_probe[i].x;
    rays.dir_y[i] = media_probe[i].y;
    rays.dir_z[i] = media_probe[i].z;
    rays.t_min[i] = 0.0F;
    rays.t_max[i] = std::numeric_limits<float>::infinity();
    rays.exclude[i] = no_primitive;
  }
}

std::uint32_t material_of_hit(const Tracer::Parts& parts, const HitBatch& hits, int i) {
  const std::int32_t instance = hits.primitive[i] - parts.view.geometry.shapes.first_instance;
  const bool shown = instance >= 0 && parts.scene.instance_count() != 0;
  return parts.scene.material_of(static_cast<std::uint32_t>(shown ? hits.inner[i] : hits.primitive[i]),
                                 shown ? instance : no_instance);
}

Crossings find_crossings(const Tracer::Parts& parts, const Vec3& point) {
  Crossings crossings;
  RayBatch rays{};
  HitBatch hits{};
  aim_probes(point, rays);
  for (bool going_on = true; going_on;) {
    parts.kernels->closest_hits(parts.view.geometry, rays, hits);
    going_on = false;
    for (int i = 0; i < media_probes; ++i) {
      if (hits.primitive[i] < 0) {
        rays.t_max[i] = rays.t_min[i]; // done
        continue;
      }
      const std::uint32_t material = material_of_hit(parts, hits, i);
      const MaterialRow& row = parts.materials[material];
      if (row.has_transmit != 0 && row.thin == 0)
        crossings[static_cast<std::size_t>(i)].push_back(static_cast<std::int32_t>(material));
      rays.t_min[i] = hits.t[i];
      going_on = true;
    }
  }
  return crossings;
}

// In from infinity: the last crossing comes first.
MediaList list_after(const std::vector<std::int32_t>& crossings) {
  MediaList list;
  list.fill(-1);
  for (std::size_t i = crossings.size(); i-- != 0;) {
    const auto held = std::find(list.begin(), list.end(), crossings[i]);
    if (held != list.end()) {
      std::copy(std::next(held), list.end(), held);
      list.back() = -1;
    } else {
      std::copy_backward(list.begin(), std::prev(list.end()), list.end());
      list.front() = crossings[i];
    }
  }
  return list;
}

} // namespace

void media_around(const Tracer::Parts& parts, const Vec3& point, std::int32_t (&media)[max_media]) {
  std::fill(std::begin(media), std::end(media), -1);
  if (parts.kernels == nullptr || parts.view.shading.has_transmission == 0) return;
  const Crossings crossings = find_crossings(parts, point);
  const MediaList a = list_after(crossings[0]), b = list_after(crossings[1]), c = list_after(crossings[2]);
  if (a == b || a == c)
    std::copy(a.begin(), a.end(), media);
  else if (b == c)
    std::copy(b.begin(), b.end(), media);
}

void media_around(const Tracer::Parts& parts, const CameraFrame& camera, int width, int height,
                  std::int32_t (&media)[max_media]) {
  const float px = 0.5F * static_cast<float>(width), py = 0.5F * static_cast<float>(height);
  const Vec3 middle = (camera.corner + px * camera.du) + py * camera.dv;
  media_around(parts, camera.orthographic ? middle : camera.eye, media);
}

void place_lights_in_media(Tracer::Parts& parts) {
  for (LightRow& row : parts.lights) {
    std::fill(std::begin(row.media), std::end(row.media), -1);
    if (row.directional == 0)
      media_around(parts, {row.position[0], row.position[1], row.position[2]}, row.media);
  }
}

} // namespace fastrt
