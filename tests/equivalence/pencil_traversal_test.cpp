// SPDX-License-Identifier: Apache-2.0
// Astigmatic pencils, as flat and smoothly curved surfaces make of an eye's rays, through the kernels of
// every ISA against brute force: equal bits. Exact pencils, rough ones, and several in one batch.
#include "tests/equivalence/batch_traversal.hpp"

namespace fastrt::test {
namespace {

class PencilTraversal : public BatchTraversal {
protected:
  // The runs that make(random) gives.
  template <class Make>
  void expect_same_of(std::uint32_t seed, int most, const Make& make) {
    Random random(seed);
    for (int i = 0; i < rounds(most); ++i) {
      RayRun run = make(random);
      vary(run, scene(), true, random);
      expect_same(run, any_count(random), {BatchShape::coherent});
    }
  }
};

// Towards the scene, or along some triangle's plane.
Vec3 way_to(const Scene& scene, const Vec3& origin, Random& random) {
  Vec3 forward = target_on(scene, random) - origin;
  if (random.below(5) == 0) forward = along_triangle(scene, 0, random).direction;
  if (!(glm::dot(forward, forward) > 0.0F)) forward = random.direction();
  return glm::normalize(forward / reference::largest_magnitude(forward));
}

// One over the distance of a focal line behind the rays' origins, or now and then before them.
float any_spread(float radius, Random& random) {
  const float spread = any_size(random, -6, 2) / radius;
  return random.below(6) == 0 ? 0.0F : random.below(6) == 0 ? -0.05F * spread : spread;
}

// Rays that leave a tilted plane. astray: what is wrong with their slopes, as a share of what these differ
// by.
RayRun pencil(const Scene& scene, float astray, Random& random) {
  const float radius = extent_of(scene).radius, size = radius * any_size(random, -10, -1);
  const Vec3 middle = origin_at(scene, random);
  const Axes axes = axes_along(way_to(scene, middle, random), random);
  const bool one_eye = random.below(2) == 0;
  const float spread_x = any_spread(radius, random),
              spread_y = one_eye ? spread_x : any_spread(radius, random);
  const Vec2 tilt(random.uniform(-2, 2), random.uniform(-2, 2));
  const bool from_surfaces = random.below(4) == 0; // of anything, in no order
  const float error = astray * size * (std::fabs(spread_x) + std::fabs(spread_y));
  RayRun run(batch_size);
  for (int i = 0; i < batch_size; ++i) {
    const Vec2 at = size * tile_point(i);
    const float depth = glm::dot(tilt, at);
    const Vec2 slope(spread_x * at.x + error * random.uniform(-1, 1),
                     spread_y * at.y + error * random.uniform(-1, 1));
    Ray& ray = run[static_cast<std::size_t>(i)];
    ray.direction = (axes.forward + slope.x * axes.right) + slope.y * axes.up;
    ray.origin = ((middle + at.x * axes.right) + at.y * axes.up) + depth * ray.direction;
    if (from_surfaces && spread_x == spread_y) {
      const Vec3 target = target_on(scene, random), from = target - middle;
      if (spread_x == 0.0F) ray.origin = target;
      const float along = glm::dot(from, axes.forward);
      if (spread_x != 0.0F && 1.0F + spread_x * along > 0.05F) {
        ray.origin = target;
        ray.direction = axes.forward + spread_x / (1.0F + spread_x * along) * (from - along * axes.forward);
      }
    }
  }
  return run;
}

// What a ball mirrors of an eye's rays: the nearer to its outline, the less of a pencil.
RayRun mirrored_by_ball(const Scene& scene, Random& random) {
  const float scale = extent_of(scene).radius, radius = scale * any_size(random, -4, 1);
  const Vec3 middle = origin_at(scene, random),
             eye = middle + radius * random.uniform(1.5F, 5) * random.direction();
  const Vec3 aim = middle + 0.9F * radius * random.in_cube();
  RayRun run = camera_fan(eye, axes_along(glm::normalize(aim - eye), random), any_size(random, -6, -1));
  for (Ray& ray : run) {
    const Vec3 dir = glm::normalize(ray.direction), from = eye - middle;
    const float b = glm::dot(from, dir), inside = b * b - glm::dot(from, from) + radius * radius;
    if (inside < 0.0F) continue;
    const Vec3 at = from - (b + std::sqrt(inside)) * dir, normal = at / radius;
    ray.origin = middle + at;
    ray.direction = dir - 2.0F * glm::dot(dir, normal) * normal;
  }
  return run;
}

TEST_P(PencilTraversal, OfMirroringBallsFindsWhatBruteForceFinds) {
  expect_same_of(64, 200, [&](Random& random) { return mirrored_by_ball(scene(), random); });
}

TEST_P(PencilTraversal, OfExactPencilsFindsWhatBruteForceFinds) {
  expect_same_of(61, 200, [&](Random& random) { return pencil(scene(), 0.0F, random); });
  expect_hits(0.02);
}

TEST_P(PencilTraversal, OfRoughPencilsFindsWhatBruteForceFinds) {
  expect_same_of(62, 200, [&](Random& random) { return pencil(scene(), any_size(random, -12, -1), random); });
  expect_hits(0.02);
}

TEST_P(PencilTraversal, OfSeveralPencilsFindsWhatBruteForceFinds) {
  expect_same_of(63, 100, [&](Random& random) {
    const RayRun first = pencil(scene(), 0.0F, random), second = pencil(scene(), 0.01F, random),
                 third = pencil(scene(), 0.0F, random);
    RayRun run = across_edges(first, second, third, random);
    // Whole groups of one surface, as tiles have that an edge goes through.
    for (std::size_t k = 0; k < run.size(); ++k)
      if (k / 16 % 3 != 0) run[k] = k / 16 % 3 == 1 ? first[k] : second[k];
    return run;
  });
  expect_hits(0.02);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PencilTraversal, testing::ValuesIn(geometry_scenes()), SceneName());

} // namespace
} // namespace fastrt::test
