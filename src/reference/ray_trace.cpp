// SPDX-License-Identifier: Apache-2.0
#include "src/reference/arithmetic.hpp"
#include "src/reference/render.hpp"
#include "src/reference/secondary.hpp"
#include "src/reference/shading.hpp"
#include "src/reference/surface.hpp"

#include <vector>

namespace fastrt::reference {
namespace {

// A ray of the tree that grows from one camera ray.
struct Node {
  Ray ray;
  Vec3 weight{1.0F}; // the share of this ray in the picture
  int depth = 0;
  Media media;
};

// The next ray into `direction`, on the side of the surface that `offset` points to.
Node child_of(const Node& parent, const Surface& surface, const Vec3& weight, const Vec3& direction,
              float offset, const Media& media) {
  Node child;
  child.ray.origin = surface.point + offset * surface.geometric_normal;
  child.ray.direction = direction;
  child.ray.excluded = surface.planar;
  child.ray.excluded_instance = surface.instance;
  child.ray.width = surface.width;
  child.ray.spread = parent.ray.spread;
  child.weight = weight;
  child.depth = parent.depth + 1;
  child.media = media;
  return child;
}

} // namespace

// The lecture recurses. A stack gives the same order - the hit, all that its mirror shows, all that shines
// through - and has no limit but memory: what is to be traced first is pushed last.
Vec3 ray_trace(const Scene& scene, const HitFinder& finder, const Ray& ray, const RenderSettings& settings,
               const Surroundings& around, const LightQuestion& question, const PhotonMap* caustics,
               RayCounts& rays, Sight& sight) {
  const auto worth_tracing = [&](const Vec3& weight) {
    return largest(weight) > 0.0F && largest(weight) >= settings.min_contribution;
  };
  Vec3 sum{0.0F};
  Node root;
  root.ray = ray;
  root.media = around.camera;
  std::vector<Node> stack{root};
  while (!stack.empty()) {
    const Node node = stack.back();
    stack.pop_back();
    const Hit hit = finder.closest(node.ray);
    if (node.depth == 0) sight.hit = hit;
    if (node.depth > sight.deepest) sight.deepest = node.depth;
    if (!hit.found()) {
      sum = sum + node.weight * scene.background();
      continue;
    }

    const Surface surface = surface_at(scene, node.ray, hit);
    const Vec3 weight = faded(node.weight, scene.materials(), node.media, surface.distance);
    LightSampling sampling{question, settings.light_samples, node.media, around.lights};
    sampling.question.depth = static_cast<std::uint32_t>(node.depth);
    Vec3 light_left{0.0F};
    sum = sum + weight * shade(scene, finder, surface, sampling, caustics, rays, light_left);
    if (node.depth == 0) {
      sight.surface = surface;
      sight.light_left = light_left;
    }

    if (node.depth >= settings.max_depth || scene.materials()[surface.material].unlit) continue;
    const Secondary next = secondary_rays(scene, surface, node.media);
    const float offset = offset_for(surface.magnitude);
    const Vec3 refracted_weight = weight * next.transmitted_weight;
    if (worth_tracing(refracted_weight)) {
      ++rays.refracted;
      stack.push_back(
          child_of(node, surface, refracted_weight, next.transmitted, -offset, next.transmitted_media));
    }
    const Vec3 reflected_weight = weight * next.mirror_weight;
    if (worth_tracing(reflected_weight)) {
      ++rays.reflected;
      stack.push_back(child_of(node, surface, reflected_weight, next.mirror, offset, node.media));
    }
  }
  return sum;
}

} // namespace fastrt::reference
