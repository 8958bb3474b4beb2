// SPDX-License-Identifier: Apache-2.0
#include "src/reference/media.hpp"

#include "src/reference/shading.hpp"
#include "src/scene/light_meshes.hpp"
#include "src/scene/media_probe.hpp"

namespace fastrt::reference {

Media Media::crossed(std::uint32_t material) const noexcept {
  Media result = *this;
  for (int i = count_ - 1; i >= 0; --i) {
    if (materials_[static_cast<std::size_t>(i)] != material) continue;
    result.erase(i);
    return result;
  }
  if (count_ == capacity) result.erase(0);
  result.materials_[static_cast<std::size_t>(result.count_++)] = material;
  return result;
}

bool operator==(const Media& a, const Media& b) noexcept {
  if (a.count_ != b.count_) return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.count_); ++i)
    if (a.materials_[i] != b.materials_[i]) return false;
  return true;
}

void Media::erase(int index) noexcept {
  --count_;
  for (auto i = static_cast<std::size_t>(index); i < static_cast<std::size_t>(count_); ++i)
    materials_[i] = materials_[i + 1];
}

float ior_of(const std::vector<Material>& materials, const Media& media) {
  return media.empty() ? 1.0F : materials[media.innermost()].ior;
}

Vec3 faded(const Vec3& light, const std::vector<Material>& materials, const Media& media, float distance) {
  if (media.empty()) return light;
  const Vec3& sigma = materials[media.innermost()].absorption;
  if (sigma == Vec3(0.0F)) return light;
  return {light.x * shared_exp(-(sigma.x * distance)), light.y * shared_exp(-(sigma.y * distance)),
          light.z * shared_exp(-(sigma.z * distance))};
}

namespace {

// The media of a ray that has come from infinity to the point, seen from it in `direction`: the surfaces on
// the way, crossed from the last to the first.
Media media_along(const Scene& scene, const HitFinder& finder, const Vec3& point, const Vec3& direction) {
  Ray ray;
  ray.origin = point;
  ray.direction = direction;
  std::vector<std::uint32_t> crossed;
  for (Hit hit = finder.closest(ray); hit.found(); hit = finder.closest(ray)) {
    const std::uint32_t material = scene.material_of(static_cast<std::uint32_t>(hit.primitive), hit.instance);
    if (is_transmissive(scene.materials()[material]) && !scene.materials()[material].thin)
      crossed.push_back(material);
    ray.t_min = hit.t;
  }
  Media media;
  for (auto material = crossed.rbegin(); material != crossed.rend(); ++material)
    media = media.crossed(*material);
  return media;
}

} // namespace

Media media_around(const Scene& scene, const HitFinder& finder, const Vec3& point) {
  if (!scene.has_transmission()) return {};
  std::array<Media, media_probes> seen;
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = media_along(scene, finder, point, media_probe[i]);
  if (seen[0] == seen[1] || seen[0] == seen[2]) return seen[0];
  return seen[1] == seen[2] ? seen[1] : Media();
}

Surroundings surroundings_of(const Scene& scene, const HitFinder& finder, const CameraFrame& camera,
                             int width, int height) {
  Surroundings around;
  const Vec3 middle = (camera.corner + (0.5F * static_cast<float>(width)) * camera.du) +
                      (0.5F * static_cast<float>(height)) * camera.dv;
  around.camera = media_around(scene, finder, camera.orthographic ? middle : camera.eye);
  for (std::size_t i = 0; i < scene.lights().size(); ++i) {
    const Light& light = scene.lights()[i];
    const Vec3 place = light.kind == LightKind::mesh ? scene.light_meshes().lights[i].middle : light.position;
    around.lights.push_back(light.kind == LightKind::directional ? Media()
                                                                 : media_around(scene, finder, place));
  }
  return around;
}

} // namespace fastrt::reference
