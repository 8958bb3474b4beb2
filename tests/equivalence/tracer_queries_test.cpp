// SPDX-License-Identifier: Apache-2.0
// A tracer's answers about arrays of any length and any promised coherence, for every ISA, against brute
// force.
#include "tests/equivalence/answers.hpp"
#include "tests/equivalence/geometry_scenes.hpp"
#include "tests/equivalence/ray_runs.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

// Rays as the interface takes them.
class RayColumns {
public:
  explicit RayColumns(const std::vector<Ray>& rays) {
    for (std::vector<float>& column : columns_) column.reserve(rays.size());
    for (const Ray& ray : rays) {
      for (int axis = 0; axis < 3; ++axis) {
        columns_[static_cast<std::size_t>(axis)].push_back(ray.origin[axis]);
        columns_[static_cast<std::size_t>(axis + 3)].push_back(ray.direction[axis]);
      }
      columns_[6].push_back(ray.t_min);
      columns_[7].push_back(ray.t_max);
    }
  }
  RayArrays arrays() const {
    return {columns_[0].data(), columns_[1].data(), columns_[2].data(),
            columns_[3].data(), columns_[4].data(), columns_[5].data(),
            columns_[6].data(), columns_[7].data(), columns_[0].size()};
  }

private:
  std::array<std::vector<float>, 8> columns_;
};

std::vector<Hit> closest_hits(const Tracer& tracer, const RayArrays& rays, Coherence coherence) {
  std::vector<float> t(rays.count);
  std::vector<float> u(rays.count);
  std::vector<float> v(rays.count);
  std::vector<std::int32_t> primitive(rays.count);
  std::vector<std::int32_t> instance(rays.count);
  tracer.closest_hit(rays, {t.data(), u.data(), v.data(), primitive.data(), instance.data()}, coherence);
  std::vector<Hit> hits(rays.count);
  for (std::size_t i = 0; i < rays.count; ++i) hits[i] = {t[i], u[i], v[i], primitive[i], instance[i]};
  return hits;
}

std::vector<std::uint8_t> any_hits(const Tracer& tracer, const RayArrays& rays, Coherence coherence) {
  std::vector<std::uint8_t> hit(rays.count, 7);
  tracer.any_hit(rays, hit.data(), coherence);
  return hit;
}

class TracerQueries : public testing::TestWithParam<NamedScene> {
protected:
  TracerQueries() {
    for (const Isa isa : available_isas()) tracers_.emplace_back(GetParam().scene, with_isa(isa));
  }
  const Scene& scene() const { return GetParam().scene; }

  void expect_same(const std::vector<Ray>& rays) {
    const std::vector<Hit> answers = answers_of(reference::BruteForce(scene()), rays);
    const RayColumns columns(rays);
    for (const Tracer& tracer : tracers_)
      for (const Coherence coherence : {Coherence::unknown, Coherence::coherent, Coherence::tile}) {
        const std::vector<Hit> closest = closest_hits(tracer, columns.arrays(), coherence);
        const std::vector<std::uint8_t> any = any_hits(tracer, columns.arrays(), coherence);
        for (std::size_t i = 0; i < rays.size(); ++i) {
          if (same(closest[i], answers[i]) && any[i] == (answers[i].found() ? 1 : 0)) continue;
          ADD_FAILURE() << isa_word(tracer.isa()) << ", coherence " << static_cast<int>(coherence) << ", ray "
                        << i << ": " << words(rays[i], answers[i], closest[i]);
          return;
        }
      }
  }

  std::vector<Tracer> tracers_;
};

constexpr std::size_t counts[] = {1, 3, 17, 255, 257, 1000};

TEST_P(TracerQueries, OfAnyRaysAndAnyNumberOfThem) {
  Random random(71);
  for (const std::size_t count : counts) {
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) ray = any_ray(scene(), random);
    expect_same(rays);
  }
}

// Whole tiles and the beginning of one more; the promise of one origin is kept, and then broken.
TEST_P(TracerQueries, OfTilesWhetherOrNotTheirOriginIsOne) {
  Random random(72);
  for (const std::size_t count : counts) {
    std::vector<Ray> rays;
    while (rays.size() < count) {
      RayRun run = origin_run(scene(), random);
      vary(run, scene(), true, random);
      for (Ray& ray : run) ray.excluded = ray.excluded_instance = -1;
      rays.insert(rays.end(), run.begin(), run.end());
    }
    rays.resize(count);
    expect_same(rays);
    rays[count / 2].origin += 0.01F * extent_of(scene()).radius * random.in_cube();
    expect_same(rays);
  }
}

TEST_P(TracerQueries, OfTilesOfOneDirection) {
  Random random(73);
  RayRun run = parallel_run(scene(), random);
  run.resize(231);
  expect_same(run);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TracerQueries, testing::ValuesIn(geometry_scenes()), SceneName());

} // namespace
} // namespace fastrt::test
