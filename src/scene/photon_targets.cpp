// SPDX-License-Identifier: Apache-2.0
#include "src/scene/photon_targets.hpp"

#include "src/scene/shapes.hpp"

#include <algorithm>
#include <cstdint>

namespace fastrt {
namespace {

using DVec3 = glm::dvec3;

// More targets than this become one.
constexpr std::size_t most_balls = 1024;

bool is_specular(const Material& m) {
  if (m.unlit) return false;
  const bool mirrors = m.mirror != Vec3(0.0F) || m.fresnel == Fresnel::schlick;
  const bool bends = !m.thin && (m.opacity < 1.0F || m.opacity_texture != no_texture);
  return mirrors || bends;
}

template <class Use>
void cover(const Aabb& box, const Use& use) {
  const DVec3 low(box.lower), high(box.upper);
  for (int i = 0; i < 8; ++i)
    use(DVec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z),
        0.0);
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
    cover(box_of_shape(scene.shapes(), kind, row), use);
  }
}

// Which of the scene's things reflect or bend light.
class Speculars {
public:
  explicit Speculars(const Scene& scene) : scene_(scene) {
    for (const Material& material : scene.materials()) materials_.push_back(is_specular(material));
    for (const Prototype& prototype : scene.desc().prototypes) prototypes_.push_back(has_some(prototype));
  }

  bool primitive(std::uint32_t id) const { return materials_[scene_.material_of(id)]; }
  // Some of it is enough.
  bool instance(std::size_t index) const {
    const InstanceColumns& instances = scene_.desc().instances;
    const std::uint32_t own = instances.material[index];
    return own != no_index ? materials_[own] : prototypes_[instances.prototype[index]];
  }

private:
  bool has_some(const Prototype& prototype) const {
    for (std::size_t kind = 0; kind < prototype.begin.size(); ++kind) {
      const std::uint32_t first = scene_.first_of(static_cast<PrimitiveKind>(kind));
      for (std::uint32_t row = prototype.begin[kind]; row < prototype.end[kind]; ++row)
        if (primitive(first + row)) return true;
    }
    return false;
  }

  const Scene& scene_;
  std::vector<bool> materials_, prototypes_;
};

// Balls around the boxes of objects and of instances, grown until they hold all that is specular.
class BallMaker {
public:
  explicit BallMaker(const Scene& scene)
      : scene_(scene), speculars_(scene),
        objects_(std::max<std::size_t>(scene.desc().object_names.size(), 1)) {
    const std::size_t count = objects_ + scene.instance_count();
    low_.assign(count, DVec3(INFINITY));
    high_.assign(count, DVec3(-INFINITY));
    radius_.assign(count, 0.0);
  }

  std::vector<PhotonTargets::Ball> make() {
    each([&](std::size_t thing, const DVec3& point, double radius) {
      low_[thing] = glm::min(low_[thing], point - radius);
      high_[thing] = glm::max(high_[thing], point + radius);
    });
    each([&](std::size_t thing, const DVec3& point, double radius) {
      radius_[thing] = std::max(radius_[thing], glm::length(point - middle(thing)) + radius);
    });
    std::vector<PhotonTargets::Ball> balls;
    for (std::size_t i = 0; i < low_.size(); ++i)
      if (low_[i].x <= high_[i].x) balls.push_back({middle(i), radius_[i]});
    return balls;
  }

private:
  DVec3 middle(std::size_t thing) const { return 0.5 * (low_[thing] + high_[thing]); }

  // Calls use(thing, point, radius). Prototypes are where instances show them alone.
  template <class Use>
  void each(const Use& use) const {
    const KindRanges& world = scene_.shapes().world;
    for (std::size_t kind = 0; kind < world.size(); ++kind) {
      const std::uint32_t first = scene_.first_of(static_cast<PrimitiveKind>(kind));
      for (const RowRange& rows : world[kind])
        for (std::uint32_t id = first + rows.begin; id < first + rows.end; ++id) {
          if (!speculars_.primitive(id)) continue;
          const std::size_t object = scene_.object_of(id);
          cover(scene_, id, [&](const DVec3& point, double radius) { use(object, point, radius); });
        }
    }
    const std::vector<InstanceShape>& instances = scene_.shapes().instances;
    for (std::size_t i = 0; i < instances.size(); ++i)
      if (!instances[i].box.empty() && speculars_.instance(i))
        cover(instances[i].box, [&](const DVec3& point, double radius) { use(objects_ + i, point, radius); });
  }

  const Scene& scene_;
  Speculars speculars_;
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

Aabb caustic_reach(const Scene& scene) {
  const Aabb& box = scene.bounds();
  if (box.empty()) return {Vec3(-infinity), Vec3(infinity)};
  const Vec3 extent = box.extent();
  const Vec3 around(4.0F * std::max(extent.x, std::max(extent.y, extent.z)));
  return {box.lower - around, box.upper + around};
}

PhotonTargets specular_objects(const Scene& scene) {
  PhotonTargets targets;
  for (std::uint32_t id = scene.first_of(PrimitiveKind::plane); id < scene.primitive_count(); ++id)
    if (is_specular(scene.materials()[scene.material_of(id)])) targets.everywhere = true;
  targets.balls = BallMaker(scene).make();
  if (targets.balls.size() > most_balls) targets.balls = {ball_around(targets)};
  return targets;
}

} // namespace fastrt
