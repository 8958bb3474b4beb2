// SPDX-License-Identifier: Apache-2.0
// Batches in scenes too large for brute force, against the scalar tree: triangles smaller than pixels, tiles
// that see thousands of them, and rays with numbers that are not finite among the others.
#include "src/trace/scalar_bvh.hpp"
#include "tests/equivalence/answers.hpp"
#include "tests/equivalence/geometry_scenes.hpp"
#include "tests/equivalence/ray_runs.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

// A ball of small triangles within a room of large ones, between spheres.
Scene ball_in_room() {
  Random random(61);
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  add(builder, jittered(icosphere(5), 0.002F, random), material);
  add(builder, placed(room(random), 3, Vec3(0.0F)), material);
  for (int i = 0; i < 300; ++i)
    builder.add_sphere(4.0F * random.in_cube(), any_size(random, -6, -1), material);
  return builder.build();
}

std::vector<NamedScene> large_scenes() {
  Random random(62);
  std::vector<NamedScene> scenes;
  scenes.push_back({"ball_in_room", ball_in_room()});
  scenes.push_back({"soup", scene_of(soup(30000, 0.03F, random))});
  scenes.push_back({"mixed_soup", scene_of(mixed_soup(20000, -9, 0, random))});
  scenes.push_back(
      {"fine_grid", scene_of(grid(100, {-0.5F, -0.6F, 0.1F}, {1.3F, 0.4F, -0.7F}, {-0.3F, 1.1F, 0.9F}))});
  return scenes;
}

class LargeTraversal : public testing::TestWithParam<NamedScene> {
protected:
  LargeTraversal() : bvh_(GetParam().scene, {1}), tracers_(simd_tracers(GetParam().scene)) {}

  const Scene& scene() const { return GetParam().scene; }

  // skip: rays whose answers are nobody's promise.
  void expect_same(const RayRun& run, const std::vector<bool>& skip, BatchShape shape) {
    const BatchShape scattered = shape == BatchShape::common_origin ? BatchShape::scattered_origin
                                 : shape == BatchShape::parallel    ? BatchShape::scattered_parallel
                                                                    : shape;
    const std::vector<Hit> expected = answers_of(bvh_, run);
    for (const Hit& hit : expected) hits_ += hit.found() ? 1U : 0U;
    for (const Tracer& tracer : tracers_)
      for (const BatchShape traced_as : {shape, scattered, BatchShape::coherent, BatchShape::any}) {
        const std::vector<Hit> closest = query_.closest(tracer, run, traced_as);
        const std::vector<bool> any = query_.any(tracer, run, traced_as);
        for (std::size_t i = 0; i < run.size() && failures_ < 5; ++i) {
          if (skip[i] || (same(closest[i], expected[i]) && any[i] == expected[i].found())) continue;
          ++failures_;
          ADD_FAILURE() << isa_word(tracer.isa()) << ", shape " << static_cast<int>(traced_as) << ", row "
                        << i << ", any " << any[i] << ": " << words(run[i], expected[i], closest[i]);
        }
      }
  }

  std::size_t hits_ = 0;

private:
  ScalarBvh bvh_;
  std::vector<Tracer> tracers_;
  KernelQuery query_;
  int failures_ = 0;
};

const std::vector<bool> all_count(batch_size, false);

TEST_P(LargeTraversal, OfOneOriginFindsWhatTheScalarTreeFinds) {
  Random random(63);
  for (int i = 0; i < effort(80); ++i) {
    RayRun run = origin_run(scene(), random);
    vary(run, scene(), true, random);
    expect_same(run, all_count, BatchShape::common_origin);
  }
  EXPECT_GT(hits_, 1500U / (slow_build ? 20U : 1U));
}

TEST_P(LargeTraversal, OfOneDirectionFindsWhatTheScalarTreeFinds) {
  Random random(64);
  for (int i = 0; i < effort(80); ++i) {
    RayRun run = parallel_run(scene(), random);
    vary(run, scene(), false, random);
    expect_same(run, all_count, BatchShape::parallel);
  }
  EXPECT_GT(hits_, 1500U / (slow_build ? 20U : 1U));
}

// As mirrors make them: neighbours are alike, but share neither origin nor direction; from inside the scene
// too.
TEST_P(LargeTraversal, OfNeighboursFindsWhatTheScalarTreeFinds) {
  Random random(67);
  for (int i = 0; i < effort(80); ++i) {
    RayRun run = i % 2 == 0 ? origin_run(scene(), random) : parallel_run(scene(), random);
    const float spread = any_size(random, -9, 0);
    const Vec3 shift = i % 3 == 0 ? -0.7F * run[0].origin : Vec3(0.0F);
    for (Ray& ray : run) {
      ray.origin += shift + spread * random.in_cube();
      ray.direction += spread * glm::length(ray.direction) * random.in_cube();
    }
    vary(run, scene(), false, random);
    expect_same(run, all_count, BatchShape::coherent);
  }
  EXPECT_GT(hits_, 1000U / (slow_build ? 20U : 1U));
}

// A picture's tiles as a camera makes them, next to each other.
TEST_P(LargeTraversal, OfAPicturesTilesFindsWhatTheScalarTreeFinds) {
  Random random(65);
  const auto [center, radius] = extent_of(scene());
  const Vec3 eye = center + 1.5F * radius * random.direction();
  const Axes axes = axes_along(glm::normalize(center - eye), random);
  constexpr int side = 6;
  const float tangent = 0.7F / side;
  for (int tile = 0; tile < (slow_build ? 3 * side : side * side); ++tile) {
    Axes at = axes;
    at.forward += tangent * static_cast<float>(2 * (tile % side) - side + 1) * axes.right +
                  tangent * static_cast<float>(2 * (tile / side) - side + 1) * axes.up;
    expect_same(camera_fan(eye, at, tangent), all_count, BatchShape::common_origin);
  }
  EXPECT_GT(hits_, slow_build ? 0U : 200U);
}

// Rays that are not finite hit nothing or anything; those beside them are not harmed.
TEST_P(LargeTraversal, OddRaysDoNoHarm) {
  Random random(66);
  for (int i = 0; i < effort(40); ++i) {
    const bool one_origin = i % 2 == 0;
    RayRun run = one_origin ? origin_run(scene(), random) : parallel_run(scene(), random);
    std::vector<bool> skip(batch_size, false);
    for (std::size_t row = 0; row < batch_size; ++row) {
      if (random.below(4) != 0) continue;
      (one_origin ? run[row].direction : run[row].origin) = odd_vector(random);
      skip[row] = true;
    }
    expect_same(run, skip, one_origin ? BatchShape::common_origin : BatchShape::parallel);
  }
}

// So many triangles lie before each group of a tile's rays that the rays go alone.
class CrowdedTraversal : public LargeTraversal {};

TEST_P(CrowdedTraversal, FindsWhatTheScalarTreeFinds) {
  Random random(68);
  for (int i = 0; i < effort(20); ++i) {
    const bool one_origin = i % 2 == 0;
    RayRun run = one_origin ? origin_run(scene(), random) : parallel_run(scene(), random);
    vary(run, scene(), one_origin, random);
    expect_same(run, all_count, one_origin ? BatchShape::common_origin : BatchShape::parallel);
  }
  EXPECT_GT(hits_, 300U / (slow_build ? 20U : 1U));
}

std::vector<NamedScene> crowded_scenes() {
  Random random(69);
  return {{"dense_soup", scene_of(soup(140000, 0.01F, random))}};
}

INSTANTIATE_TEST_SUITE_P(Scenes, CrowdedTraversal, testing::ValuesIn(crowded_scenes()), SceneName());
INSTANTIATE_TEST_SUITE_P(Scenes, LargeTraversal, testing::ValuesIn(large_scenes()), SceneName());

} // namespace
} // namespace fastrt::test
