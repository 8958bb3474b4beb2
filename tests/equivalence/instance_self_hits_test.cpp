// SPDX-License-Identifier: Apache-2.0
// Rays that leave the surface of an instance do not meet it again, whatever its map does: turned, stretched
// 100 to 1, sheared, mirrored, large and small.
#include "src/reference/surface.hpp"
#include "tests/equivalence/answers.hpp"
#include "tests/equivalence/geometry_scenes.hpp"
#include "tests/equivalence/next_ray.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

enum class BodyKind { mesh, sphere, cylinder, cone };
enum class Deformation { turned, stretched, stretched_across, sheared };
struct Body {
  BodyKind kind;
  Deformation deformation;
  float scale, offset;
};
void PrintTo(const Body& body, std::ostream* out) {
  constexpr const char* kinds[] = {"mesh", "sphere", "cylinder", "cone"};
  constexpr const char* deformations[] = {"turned", "stretched", "stretched across", "sheared"};
  *out << kinds[static_cast<int>(body.kind)] << ' ' << deformations[static_cast<int>(body.deformation)] << ' '
       << body.scale << " at " << body.offset;
}

Vec3 linear(const Affine& map, const Vec3& v) { return map.x * v.x + map.y * v.y + map.z * v.z; }

Affine map_of(const Body& body, Random& random) {
  Affine map = any_rotation(random);
  if (body.deformation == Deformation::stretched) map.x *= 0.01F;
  if (body.deformation == Deformation::stretched_across) { // along none of the prototype's own axes
    const Affine turn = any_rotation(random);
    map.y *= 0.01F;
    map.z *= -0.3F;
    map = {linear(map, turn.x), linear(map, turn.y), linear(map, turn.z), {}};
  }
  if (body.deformation == Deformation::sheared) map.x += 3.0F * map.y - 2.0F * map.z;
  map.x *= body.scale;
  map.y *= body.scale;
  map.z *= body.scale;
  map.origin = Vec3(body.offset);
  return map;
}

Scene scene_with(const Body& body) {
  Random random(11);
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  builder.begin_prototype();
  const Vec3 half(0.2F, 0.6F, -0.3F);
  if (body.kind == BodyKind::mesh) add(builder, icosphere(2), material);
  if (body.kind == BodyKind::sphere) builder.add_sphere({0.1F, 0.2F, -0.1F}, 1, material);
  if (body.kind == BodyKind::cylinder) builder.add_cylinder(-half, half, 0.6F, material);
  if (body.kind == BodyKind::cone) builder.add_cone(-half, 0.8F, half, 0.1F, material);
  builder.add_instance(builder.end_prototype(), map_of(body, random));
  return builder.build();
}

class InstanceSelfHits : public testing::TestWithParam<Body> {
protected:
  static constexpr int batches = slow_build ? 5 : 30;

  InstanceSelfHits() : scene_(scene_with(GetParam())), tracers_(simd_tracers(scene_)) {}

  // Outside of the body: sheared ones reach farther.
  Vec3 around(float farthest, Random& random) const {
    const float size = GetParam().scale * (GetParam().deformation == Deformation::sheared ? 4.0F : 1.0F);
    return Vec3(GetParam().offset) + size * random.uniform(1.3F, farthest) * random.direction();
  }

  // How many of the next rays hit something.
  int count(const Tracer& tracer, bool shadows) {
    Random random(101);
    KernelQuery query;
    const Vec3 middle = reference::map_point(scene_.desc().instances.to_world[0], {0.1F, 0.2F, -0.1F});
    int hits = 0;
    for (int batch = 0; batch < batches; ++batch) {
      std::vector<Ray> rays(batch_size);
      for (Ray& ray : rays) {
        ray.origin = around(5, random);
        ray.direction = target_on_instance(scene_, 0, random) - ray.origin;
      }
      const Vec3 light = around(9, random);
      const std::vector<Hit> found = query.closest(tracer, rays, BatchShape::any);
      std::vector<Ray> next;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!found[i].found()) continue;
        const reference::Surface surface = reference::surface_at(scene_, rays[i], found[i]);
        // At the very outline a ray may hit a back, and leaves inwards.
        if (glm::dot(surface.geometric_normal, surface.point - middle) < 0.0F) continue;
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

TEST_P(InstanceSelfHits, AreThereNone) {
  for (const Tracer& tracer : tracers()) {
    EXPECT_EQ(count(tracer, false), 0) << isa_word(tracer.isa()) << ", reflected";
    EXPECT_EQ(count(tracer, true), 0) << isa_word(tracer.isa()) << ", shadows";
  }
  EXPECT_GT(traced_, static_cast<std::size_t>(batches) * batch_size * simd_isas().size() / 2);
}

std::vector<Body> bodies() {
  std::vector<Body> bodies;
  for (const BodyKind kind : {BodyKind::mesh, BodyKind::sphere, BodyKind::cylinder, BodyKind::cone})
    for (const Deformation deformation :
         {Deformation::turned, Deformation::stretched, Deformation::stretched_across, Deformation::sheared})
      for (const auto& [scale, offset] : {std::pair{1e-3F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1e2F}, {1e4F, 1e2F}})
        bodies.push_back({kind, deformation, scale, offset});
  return bodies;
}
INSTANTIATE_TEST_SUITE_P(Bodies, InstanceSelfHits, testing::ValuesIn(bodies()));

} // namespace
} // namespace fastrt::test
