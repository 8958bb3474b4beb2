// SPDX-License-Identifier: Apache-2.0
// Rays that graze cylinders, or run almost along them, of any size and from far away: what the kernels' quick
// look at the distance from the axis leaves out must be what the exact test misses.
#include "tests/equivalence/batch_traversal.hpp"

namespace fastrt::test {
namespace {

struct Cylinder {
  Vec3 middle, axis; // axis: unit
  float half_height, radius;
};

Cylinder any_cylinder(Random& random) {
  const float size = any_size(random, -8, 8);
  const Vec3 axis = random.below(3) == 0 ? axis_direction(random) : random.direction();
  const Vec3 offset = random.below(2) == 0 ? Vec3(0.0F) : any_size(random, -2, 5) * random.in_cube();
  return {size * offset, axis, size, size * any_size(random, -6, 1)};
}

Scene scene_of(const Cylinder& c, Random& random) {
  SceneBuilder builder;
  const Vec3 half = c.half_height * c.axis;
  builder.add_cylinder(c.middle - half, c.middle + half, c.radius, builder.add_material({}),
                       random.below(2) == 0);
  return builder.build();
}

float any_sign(Random& random) { return random.below(2) == 0 ? -1.0F : 1.0F; }

// A line that passes the axis at the radius or close to it, almost along the axis now and then.
Ray grazing(const Cylinder& c, Random& random) {
  const Axes axes = axes_along(c.axis, random);
  const float beyond = random.below(4) == 0 ? 0.0F : any_sign(random) * any_size(random, -18, -2);
  const float steep =
      random.below(2) == 0 ? random.uniform(-2, 2) : any_sign(random) * any_size(random, 2, 18);
  const Vec3 touched = (c.middle + (1.0F + beyond) * c.radius * axes.right) +
                       c.half_height * random.uniform(-1.1F, 1.1F) * c.axis;
  const Vec3 way = glm::normalize(axes.up + steep * c.axis);
  Ray ray;
  ray.direction = any_size(random, -12, 12) * way;
  ray.origin = touched - c.half_height * any_size(random, -3, 9) * way;
  return ray;
}

TEST(CylinderSieve, LeavesOutWhatTheTestMisses) {
  Random random(81);
  KernelQuery query;
  std::size_t hits = 0, rays = 0;
  for (int i = 0; i < effort(1500); ++i) {
    const Cylinder cylinder = any_cylinder(random);
    const Scene scene = scene_of(cylinder, random);
    RayRun run(batch_size);
    for (Ray& ray : run) ray = grazing(cylinder, random);
    const std::vector<Hit> answers = answers_of(reference::BruteForce(scene), run);
    rays += run.size();
    for (const Hit& answer : answers) hits += answer.found() ? 1U : 0U;
    for (const Tracer& tracer : simd_tracers(scene))
      for (const BatchShape shape : {BatchShape::any, BatchShape::coherent}) {
        const std::vector<Hit> found = query.closest(tracer, run, shape);
        for (std::size_t k = 0; k < run.size(); ++k)
          ASSERT_TRUE(same(found[k], answers[k]))
              << isa_word(tracer.isa()) << ", shape " << static_cast<int>(shape) << ": "
              << words(run[k], answers[k], found[k]);
      }
  }
  EXPECT_GT(hits, rays / 5);
  EXPECT_LT(hits, rays - rays / 5);
}

} // namespace
} // namespace fastrt::test
