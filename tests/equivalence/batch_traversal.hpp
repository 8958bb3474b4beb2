// SPDX-License-Identifier: Apache-2.0
// Batches through the kernels of every ISA against brute force over the reference's primitives: equal bits.
#pragma once

#include "tests/equivalence/answers.hpp"
#include "tests/equivalence/geometry_scenes.hpp"
#include "tests/equivalence/ray_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

namespace fastrt::test {

struct Tally {
  std::size_t rays = 0, hits = 0;
};

class BatchTraversal : public testing::TestWithParam<NamedScene> {
protected:
  BatchTraversal() : tracers_(simd_tracers(GetParam().scene)) {}

  const Scene& scene() const { return GetParam().scene; }

  // The batch, cut to `count` rays, as every shape in `shapes` on every ISA.
  void expect_same(const RayRun& run, std::size_t count, std::initializer_list<BatchShape> shapes) {
    const std::span<const Ray> rays(run.data(), count);
    const std::vector<Hit> answers = answers_of(reference::BruteForce(scene()), rays);
    tally_.rays += count;
    for (const Hit& answer : answers) tally_.hits += answer.found() ? 1U : 0U;
    for (const Tracer& tracer : tracers_)
      for (const BatchShape shape : shapes) expect_same(rays, answers, tracer, shape);
  }

  void expect_same(std::span<const Ray> rays, const std::vector<Hit>& answers, const Tracer& tracer,
                   BatchShape shape) {
    if (failures_ > 5) return;
    const std::vector<Hit> closest = query_.closest(tracer, rays, shape);
    const std::vector<bool> any = query_.any(tracer, rays, shape);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (same(closest[i], answers[i]) && any[i] == answers[i].found()) continue;
      ++failures_;
      ADD_FAILURE() << isa_word(tracer.isa()) << ", shape " << static_cast<int>(shape) << ", row " << i
                    << " of " << rays.size() << ", any " << any[i] << ": "
                    << words(rays[i], answers[i], closest[i]);
      return;
    }
  }

  // Batches to try: fewer where brute force takes long.
  int rounds(int most) const {
    return effort(std::min(most, 20000 / (static_cast<int>(scene().primitive_count()) + 20)));
  }

  void expect_hits(double share) const {
    if (slow_build || scene().primitive_count() == 0) return;
    EXPECT_GT(static_cast<double>(tally_.hits), share * static_cast<double>(tally_.rays));
  }

  std::vector<Tracer> tracers_;
  KernelQuery query_;
  Tally tally_;
  int failures_ = 0;
};

// Mostly whole batches, and every number that could end in the middle of something.
inline std::size_t any_count(Random& random) {
  constexpr std::size_t counts[] = {1, 3, 4, 15, 16, 17, 33, 100, 240, 255};
  return random.below(3) != 0 ? batch_size : counts[random.below(10)];
}

// Every group of 16 has rays of the first and of the second run, and some of the third one.
inline RayRun across_edges(const RayRun& first, const RayRun& second, const RayRun& third, Random& random) {
  RayRun run = first;
  const std::uint32_t share = random.below(8), edge = 1 + random.below(15);
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (i % 16 >= edge) run[i] = second[i];
    if (random.below(64) < share) run[i] = third[i];
  }
  return run;
}

} // namespace fastrt::test
