// SPDX-License-Identifier: Apache-2.0
// Packets of rays that have nothing in common, among so many small spheres that each of them is left alone in
// more subtrees than can be put off.
#include "src/trace/scalar_bvh.hpp"
#include "tests/equivalence/answers.hpp"
#include "tests/equivalence/ray_runs.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

Scene cloud(float radius, Random& random) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  for (int i = 0; i < 200000; ++i) builder.add_sphere(random.in_cube(), radius, material);
  return builder.build();
}

TEST(ApartPackets, FindWhatTheScalarTreeFinds) {
  Random random(93);
  KernelQuery query;
  std::size_t rays = 0, hits = 0;
  for (const float radius : {0.0005F, 0.001F, 0.002F}) {
    const Scene scene = cloud(radius, random);
    const std::vector<Tracer> tracers = simd_tracers(scene);
    const ScalarBvh bvh(scene, {1});
    for (int i = 0; i < effort(20); ++i) {
      RayRun run(batch_size);
      for (Ray& ray : run) ray = aimed(2.0F * random.in_cube(), random.in_cube(), random);
      const std::vector<Hit> answers = answers_of(bvh, run);
      rays += run.size();
      for (const Hit& answer : answers) hits += answer.found() ? 1U : 0U;
      for (const Tracer& tracer : tracers) {
        const std::vector<Hit> closest = query.closest(tracer, run, BatchShape::coherent);
        const std::vector<bool> any = query.any(tracer, run, BatchShape::coherent);
        for (std::size_t k = 0; k < run.size(); ++k)
          ASSERT_TRUE(same(closest[k], answers[k]) && any[k] == answers[k].found())
              << isa_word(tracer.isa()) << ", any " << any[k] << ": "
              << words(run[k], answers[k], closest[k]);
      }
    }
  }
  EXPECT_GT(hits, rays / 5);
  EXPECT_LT(hits, rays - rays / 5);
}

} // namespace
} // namespace fastrt::test
