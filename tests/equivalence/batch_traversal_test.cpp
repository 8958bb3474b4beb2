// SPDX-License-Identifier: Apache-2.0
// Batches of every shape through the kernels of every ISA against brute force over the reference's
// primitives: equal bits. A shape decides how a batch is traced, never what it hits.
#include "tests/equivalence/batch_traversal.hpp"

#include <cmath>

namespace fastrt::test {
namespace {

TEST_P(BatchTraversal, OfOneOriginFindsWhatBruteForceFinds) {
  Random random(51);
  for (int i = 0; i < rounds(200); ++i) {
    RayRun run = origin_run(scene(), random);
    vary(run, scene(), true, random);
    expect_same(
        run, any_count(random),
        {BatchShape::common_origin, BatchShape::scattered_origin, BatchShape::coherent, BatchShape::any});
  }
  expect_hits(0.05);
}

TEST_P(BatchTraversal, OfOneDirectionFindsWhatBruteForceFinds) {
  Random random(52);
  for (int i = 0; i < rounds(200); ++i) {
    RayRun run = parallel_run(scene(), random);
    vary(run, scene(), false, random);
    expect_same(
        run, any_count(random),
        {BatchShape::parallel, BatchShape::scattered_parallel, BatchShape::coherent, BatchShape::any});
  }
  expect_hits(0.05);
}

TEST_P(BatchTraversal, OfAnyRaysFindsWhatBruteForceFinds) {
  Random random(53);
  for (int i = 0; i < rounds(60); ++i) {
    RayRun run(batch_size);
    for (Ray& ray : run) ray = any_ray(scene(), random);
    vary(run, scene(), true, random);
    for (Ray& ray : run)
      if (ray.t_min == 0.0F && random.below(2) == 0) ray.t_min = -0.0F;
    expect_same(run, any_count(random), {BatchShape::coherent, BatchShape::any});
  }
  expect_hits(0.05);
}

// What a batch of one origin or one direction may be traced as, as a tile or perhaps as one.
BatchShape tile_shape(bool one_origin) {
  return one_origin ? BatchShape::common_origin : BatchShape::parallel;
}
BatchShape scattered_shape(bool one_origin) {
  return one_origin ? BatchShape::scattered_origin : BatchShape::scattered_parallel;
}

// Most rays of some batches, and few of others, look for nothing: those of a surface that turns away from a
// light.
void make_gaps(RayRun& run, Random& random) {
  const std::uint32_t left = 1 + random.below(15);
  for (Ray& ray : run)
    if (random.below(16) >= left) ray.t_max = random.below(2) == 0 ? ray.t_min : -1.0F;
}

TEST_P(BatchTraversal, WithGapsFindsWhatBruteForceFinds) {
  Random random(54);
  for (int i = 0; i < rounds(60); ++i) {
    const bool one_origin = i % 2 == 0;
    RayRun run = one_origin ? origin_run(scene(), random) : parallel_run(scene(), random);
    vary(run, scene(), one_origin, random);
    make_gaps(run, random);
    expect_same(run, any_count(random),
                {tile_shape(one_origin), scattered_shape(one_origin), BatchShape::coherent});
  }
  expect_hits(0.02);
}

// Rays of one origin that go to a small patch of the scene.
RayRun fan_to_patch(const Scene& scene, const Vec3& origin, Random& random) {
  Vec3 forward = target_on(scene, random) - origin;
  if (!(glm::dot(forward, forward) > 0.0F)) forward = random.direction();
  forward = glm::normalize(forward / reference::largest_magnitude(forward));
  return camera_fan(origin, axes_along(forward, random), any_size(random, -12, -2));
}

// Parallel rays that go to a small patch of the scene.
RayRun beam_to_patch(const Scene& scene, const Vec3& direction, Random& random) {
  const Axes axes = axes_along(direction, random);
  const float radius = extent_of(scene).radius, size = radius * any_size(random, -12, -2);
  const Vec3 middle = target_on(scene, random) - radius * random.uniform(-0.5F, 3) * axes.forward;
  RayRun run(batch_size);
  for (int i = 0; i < batch_size; ++i) {
    const Vec2 at = size * tile_point(i);
    run[static_cast<std::size_t>(i)].direction = direction;
    run[static_cast<std::size_t>(i)].origin = middle + at.x * axes.right + at.y * axes.up;
  }
  return run;
}

TEST_P(BatchTraversal, AcrossEdgesFindsWhatBruteForceFinds) {
  Random random(55);
  for (int i = 0; i < rounds(60); ++i) {
    const bool one_origin = i % 2 == 0;
    const Vec3 origin = origin_at(scene(), random), direction = random.direction();
    const auto to_patch = [&] {
      return one_origin ? fan_to_patch(scene(), origin, random) : beam_to_patch(scene(), direction, random);
    };
    const RayRun first = to_patch(), second = to_patch(), third = to_patch();
    RayRun run = across_edges(first, second, third, random);
    vary(run, scene(), one_origin, random);
    expect_same(run, any_count(random), {tile_shape(one_origin), scattered_shape(one_origin)});
  }
  expect_hits(0.02);
}

// Close to 1, or next to it.
float almost_one(Random& random) {
  const float step = any_size(random, -24, -3);
  return random.below(2) == 0 ? 1.0F + step : 1.0F - step;
}

// Rays of one origin end where they meet something, parallel ones begin there, or almost.
TEST_P(BatchTraversal, UpToSurfacesFindsWhatBruteForceFinds) {
  Random random(57);
  const reference::BruteForce finder(scene());
  for (int i = 0; i < rounds(100); ++i) {
    const bool one_origin = i % 2 == 0;
    RayRun run = one_origin ? fan_to_patch(scene(), origin_at(scene(), random), random)
                            : beam_to_patch(scene(), random.direction(), random);
    for (Ray& ray : run) {
      const Hit hit = finder.closest(ray);
      if (!hit.found()) continue;
      const float t = random.below(4) == 0 ? hit.t : hit.t * almost_one(random);
      if (one_origin)
        ray.t_max = random.below(4) == 0 ? std::nextafter(t, infinity) : t;
      else
        ray.origin += t * ray.direction;
    }
    expect_same(run, batch_size, {tile_shape(one_origin), scattered_shape(one_origin)});
  }
  expect_hits(0.02);
}

// Neighbours that go two to six ways, in any mixture.
TEST_P(BatchTraversal, OfSeveralWaysFindsWhatBruteForceFinds) {
  Random random(56);
  for (int i = 0; i < rounds(60); ++i) {
    const std::uint32_t ways = 2 + random.below(5), first = random.below(16);
    std::vector<RayRun> runs;
    for (std::uint32_t way = 0; way < ways; ++way)
      runs.push_back(random.below(2) == 0 ? fan_to_patch(scene(), origin_at(scene(), random), random)
                                          : beam_to_patch(scene(), random.direction(), random));
    RayRun run(batch_size);
    for (std::size_t ray = 0; ray < run.size(); ++ray)
      run[ray] = runs[random.below(16) < first ? 0 : random.below(ways)][ray];
    vary(run, scene(), true, random);
    expect_same(run, any_count(random), {BatchShape::coherent});
  }
  expect_hits(0.02);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BatchTraversal, testing::ValuesIn(geometry_scenes()), SceneName());

} // namespace
} // namespace fastrt::test
