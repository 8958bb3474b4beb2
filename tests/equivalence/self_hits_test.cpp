// SPDX-License-Identifier: Apache-2.0
// Rays that leave a surface by the rule of docs/numerics.md ("Offset of secondary rays") do not meet it
// again: on closed convex bodies nothing may be hit by a reflected ray or by a shadow ray that faces its
// light.
#include "src/reference/surface.hpp"
#include "tests/equivalence/answers.hpp"
#include "tests/equivalence/geometry_scenes.hpp"
#include "tests/equivalence/next_ray.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

enum class BodyKind { mesh, sphere, cylinder, cone };
struct Body {
  float scale;
  float offset;
  BodyKind kind;
};
void PrintTo(const Body& body, std::ostream* out) {
  constexpr const char* names[] = {"mesh ", "sphere ", "cylinder ", "cone "};
  *out << names[static_cast<int>(body.kind)] << body.scale << " at " << body.offset;
}

class SelfHits : public testing::TestWithParam<Body> {
protected:
  static constexpr int batches = slow_build ? 10 : 200;

  SelfHits() : scene_(make_scene()), tracers_(simd_tracers(scene_)) {}

  static Scene make_scene() {
    const Body& body = GetParam();
    if (body.kind == BodyKind::mesh) return scene_of(placed(icosphere(2), body.scale, Vec3(body.offset)));
    SceneBuilder builder;
    const std::uint32_t material = builder.add_material({});
    const Vec3 center(body.offset);
    const Vec3 half = body.scale * Vec3(0.2F, 0.6F, -0.3F);
    if (body.kind == BodyKind::sphere)
      builder.add_sphere(center, body.scale, material);
    else if (body.kind == BodyKind::cylinder)
      builder.add_cylinder(center - half, center + half, 0.6F * body.scale, material);
    else
      builder.add_cone(center - half, 0.8F * body.scale, center + half, 0.1F * body.scale, material);
    return builder.build();
  }

  // Rays from around the body onto it.
  std::vector<Ray> rays_onto(Random& random) const {
    const Body& body = GetParam();
    std::vector<Ray> rays(batch_size);
    for (Ray& ray : rays) {
      ray.origin = Vec3(body.offset) + body.scale * random.uniform(1.2F, 5) * random.direction();
      ray.direction = target_on(scene_, random) - ray.origin;
    }
    return rays;
  }

  // How many of the next rays hit something.
  int count(const Tracer& tracer, bool shadows) {
    Random random(101);
    KernelQuery query;
    int hits = 0;
    for (int batch = 0; batch < batches; ++batch) {
      const std::vector<Ray> rays = rays_onto(random);
      const Vec3 light =
          Vec3(GetParam().offset) + GetParam().scale * random.uniform(1.2F, 9) * random.direction();
      const std::vector<Hit> found = query.closest(tracer, rays, BatchShape::any);
      std::vector<Ray> next;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!found[i].found()) continue;
        const reference::Surface surface = reference::surface_at(scene_, rays[i], found[i]);
        // At the very outline a ray may hit a back, and leaves inwards.
        if (glm::dot(surface.geometric_normal, surface.point - Vec3(GetParam().offset)) < 0.0F) continue;
        if (shadows && !(glm::dot(surface.geometric_normal, glm::normalize(light - surface.point)) > 0.0F))
          continue;
        next.push_back(next_ray(surface, shadows ? &light : nullptr, random));
      }
      traced_ += next.size();
      const BatchShape shape = shadows ? BatchShape::common_origin : BatchShape::coherent;
      for (const bool hit : query.any(tracer, next, shape)) hits += hit ? 1 : 0;
    }
    return hits;
  }

  const std::vector<Tracer>& tracers() const { return tracers_; }

  std::size_t traced_ = 0;

private:
  Scene scene_;
  std::vector<Tracer> tracers_;
};

TEST_P(SelfHits, AreThereNone) {
  for (const Tracer& tracer : tracers()) {
    EXPECT_EQ(count(tracer, false), 0) << isa_word(tracer.isa()) << ", reflected";
    EXPECT_EQ(count(tracer, true), 0) << isa_word(tracer.isa()) << ", shadows";
  }
  EXPECT_GT(traced_, static_cast<std::size_t>(batches) * batch_size * simd_isas().size());
}

std::vector<Body> bodies() {
  std::vector<Body> bodies;
  for (const BodyKind kind : {BodyKind::mesh, BodyKind::sphere, BodyKind::cylinder, BodyKind::cone})
    for (const float scale : {1e-3F, 1e-2F, 1.0F, 1e2F, 1e4F})
      for (const float offset : {0.0F, 1e2F})
        if (scale * 1e4F >= offset) bodies.push_back({scale, offset, kind});
  return bodies;
}
INSTANTIATE_TEST_SUITE_P(Bodies, SelfHits, testing::ValuesIn(bodies()));

} // namespace
} // namespace fastrt::test
