// SPDX-License-Identifier: Apache-2.0
#include "src/scene/photon_targets.hpp"

#include "src/scene/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fastrt {
namespace {

using DVec3 = glm::dvec3;

// More objects than this are one target.
constexpr std::size_t most_objects = 1024;

bool is_specular(const Material& m) {
  if (m.unlit) return false;
  const bool mirrors = m.mirror != Vec3(0.0F) || m.fresnel == Fresnel::schlick;
  const bool bends = !m.thin && (m.opacity < 1.0F || m.opacity_texture != no_texture);
  return mirrors || bends;
}

const Aabb& shape_box(const Scene& scene, PrimitiveKind kind, std::uint32_t row) {
  const SceneShapes& shapes = scene.shapes();
  if (kind == PrimitiveKind::cone) return shapes.cones[row].box;
  if (kind == PrimitiveKind::disk) return shapes.disks[row].box;
  return shapes.polygons[row].box;
}

// Calls use(point, radius) for balls that together hold the primitive. It is no plane.
template <class Use>
void cover(const Scene& scene, std::uint32_t primitive, const Use& use) {
  const PrimitiveKind kind = scene.kind(primitive);
  const std::uint32_t row = primitive - scene.first_of(kind);
  if (kind == PrimitiveKind::triangle) {
    const TriangleColumns& t = scene.triangles();
    for (const std::uint32_t v : {t.v0[row], t.v1[row], t.v2[row]}) use(DVec3(scene.positions()[v]), 0.0);
  } else if (kind == PrimitiveKind::sphere) {
    const SphereColumns& s = scene.spheres();
    use(DVec3(s.x[row], s.y[row], s.z[row]), static_cast<double>(s.radius[row]));
  } else {
    const Aabb& box = shape_box(scene, kind, row);
    const DVec3 low(box.lower), high(box.upper);
    for (int i = 0; i < 8; ++i)
      use(DVec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z),
          0.0);
  }
}

// Balls around the boxes of objects, grown until they hold every primitive that `wanted` lets in.
class BallMaker {
public:
  explicit BallMaker(const Scene& scene)
      : scene_(scene), objects_(std::max<std::size_t>(scene.desc().object_names.size(), 1)) {
    if (objects_ > most_objects) objects_ = 1;
    low_.assign(objects_, DVec3(INFINITY));
    high_.assign(objects_, DVec3(-INFINITY));
    radius_.assign(objects_, 0.0);
  }

  template <class Wanted>
  std::vector<PhotonTargets::Ball> make(const Wanted& wanted) {
    each(wanted, [&](std::size_t object, const DVec3& point, double radius) {
      low_[object] = glm::min(low_[object], point - radius);
      high_[object] = glm::max(high_[object], point + radius);
    });
    each(wanted, [&](std::size_t object, const DVec3& point, double radius) {
      radius_[object] = std::max(radius_[object], glm::length(point - middle(object)) + radius);
    });
    std::vector<PhotonTargets::Ball> balls;
    for (std::size_t i = 0; i < objects_; ++i)
      if (low_[i].x <= high_[i].x) balls.push_back({middle(i), radius_[i]});
    return balls;
  }

private:
  DVec3 middle(std::size_t object) const { return 0.5 * (low_[object] + high_[object]); }

  template <class Wanted, class Use>
  void each(const Wanted& wanted, const Use& use) const {
    for (std::uint32_t id = 0; id < scene_.first_of(PrimitiveKind::plane); ++id) {
      if (!wanted(id)) continue;
      const std::size_t object = objects_ == 1 ? 0 : scene_.object_of(id);
      cover(scene_, id, [&](const DVec3& point, double radius) { use(object, point, radius); });
    }
  }

  const Scene& scene_;
  std::size_t objects_;
  std::vector<DVec3> low_, high_;
  std::vector<double> radius_;
};

} // namespace

PhotonTargets::Ball ball_around(const Aabb& box) {
  const DVec3 low(box.lower), high(box.upper);
  return {0.5 * (low + high), 0.5 * glm::length(high - low)};
}

PhotonTargets::Ball ball_around(const PhotonTargets& targets) {
  DVec3 low(INFINITY), high(-INFINITY);
  for (const PhotonTargets::Ball& ball : targets.balls) {
    low = glm::min(low, ball.center - ball.radius);
    high = glm::max(high, ball.center + ball.radius);
  }
  PhotonTargets::Ball around{0.5 * (low + high), 0};
  for (const PhotonTargets::Ball& ball : targets.balls)
    around.radius = std::max(around.radius, glm::length(ball.center - around.center) + ball.radius);
  return around;
}

PhotonTargets whole_scene(const Scene& scene) {
  PhotonTargets targets;
  targets.everywhere = scene.count_of(PrimitiveKind::plane) != 0;
  if (scene.bounds().empty()) return targets;
  targets.balls.push_back(ball_around(scene.bounds()));
  return targets;
}

PhotonTargets specular_objects(const Scene& scene) {
  PhotonTargets targets;
  const auto wanted = [&](std::uint32_t id) { return is_specular(scene.materials()[scene.material_of(id)]); };
  for (std::uint32_t id = scene.first_of(PrimitiveKind::plane); id < scene.primitive_count(); ++id)
    if (wanted(id)) targets.everywhere = true;
  targets.balls = BallMaker(scene).make(wanted);
  return targets;
}

} // namespace fastrt
