// SPDX-License-Identifier: Apache-2.0
#include "src/trace/tracer_parts.hpp"
#include "tests/equivalence/isas.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <fastrt/error.hpp>
#include <fastrt/tracer.hpp>

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

// Two squares at z = 0 and z = -1, two triangles each, and a ball of radius 1 at z = -5.
Scene squares_and_ball() {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  for (const float z : {0.0F, -1.0F}) add(builder, grid(1, {-1, -1, z}, {2, 0, 0}, {0, 2, 0}), material);
  builder.add_sphere({0, 0, -5}, 1, material);
  return builder.build();
}

struct OneRay {
  float ox = 0, oy = 0, oz = 0, dx = 0, dy = 0, dz = -1;
  float t_min = 0, t_max = infinity;
  RayArrays arrays() const { return {&ox, &oy, &oz, &dx, &dy, &dz, &t_min, &t_max, 1}; }
  RayArrays without_limits() const { return {&ox, &oy, &oz, &dx, &dy, &dz, nullptr, nullptr, 1}; }
};

reference::Hit closest(const Tracer& tracer, const RayArrays& ray) {
  reference::Hit hit;
  tracer.closest_hit(ray, {&hit.t, &hit.u, &hit.v, &hit.primitive});
  return hit;
}
bool any(const Tracer& tracer, const RayArrays& ray) {
  std::uint8_t hit = 9;
  tracer.any_hit(ray, &hit);
  EXPECT_LE(hit, 1);
  return hit == 1;
}

class TracerOf : public testing::TestWithParam<Isa> {
protected:
  static Tracer tracer(Scene scene) {
    TracerSettings settings;
    settings.isa = GetParam();
    settings.threads = 1;
    return Tracer(std::move(scene), settings);
  }
};

TEST_P(TracerOf, FindsTheNearestInFrontOfTheRay) {
  const Tracer tracer = TracerOf::tracer(squares_and_ball());
  OneRay ray;
  ray.ox = 0.5F;
  ray.oz = 2;
  const reference::Hit hit = closest(tracer, ray.arrays());
  EXPECT_EQ(hit.primitive, 0);
  EXPECT_EQ(hit.t, 2.0F);
  EXPECT_EQ(hit.u, 0.25F); // of the corners (-1, -1), (1, -1) and (1, 1)
  EXPECT_EQ(hit.v, 0.5F);
}

TEST_P(TracerOf, MeasuresInLengthsOfTheDirection) {
  const Tracer tracer = TracerOf::tracer(squares_and_ball());
  OneRay ray;
  ray.ox = 0.5F;
  ray.oz = 2;
  ray.dz = -4;
  EXPECT_EQ(closest(tracer, ray.arrays()).t, 0.5F);
}

TEST_P(TracerOf, GoesOnBehindTMinUpToTMax) {
  const Tracer tracer = TracerOf::tracer(squares_and_ball());
  OneRay ray;
  ray.ox = 0.5F;
  ray.oz = 2;
  ray.t_min = 2; // the first square's t: both ends are outside
  EXPECT_EQ(closest(tracer, ray.arrays()).primitive, 2);
  ray.t_max = 3;
  EXPECT_EQ(closest(tracer, ray.arrays()).primitive, no_primitive);
  EXPECT_EQ(closest(tracer, ray.arrays()).t, 3.0F);
  EXPECT_FALSE(any(tracer, ray.arrays()));
  ray.t_max = std::nextafter(3.0F, 4.0F);
  EXPECT_EQ(closest(tracer, ray.arrays()).primitive, 2);
  EXPECT_TRUE(any(tracer, ray.arrays()));
}

TEST_P(TracerOf, FindsSpheresByTheIdsAfterTheTriangles) {
  const Tracer tracer = TracerOf::tracer(squares_and_ball());
  OneRay ray;
  ray.oz = -3;
  const reference::Hit hit = closest(tracer, ray.arrays());
  EXPECT_EQ(hit.primitive, 4);
  EXPECT_EQ(hit.t, 1.0F);
  EXPECT_EQ(hit.u, 0.75F); // three quarters around, half-way up
  EXPECT_EQ(hit.v, 0.5F);
}

TEST_P(TracerOf, SaysWhatAMissIs) {
  const Tracer tracer = TracerOf::tracer(squares_and_ball());
  OneRay ray;
  ray.oz = 2;
  ray.dz = 1;
  ray.t_max = 77;
  reference::Hit hit = closest(tracer, ray.arrays());
  EXPECT_EQ(hit.primitive, no_primitive);
  EXPECT_EQ(hit.t, 77.0F);
  EXPECT_EQ(hit.u, 0.0F);
  EXPECT_EQ(hit.v, 0.0F);
  hit = closest(tracer, ray.without_limits());
  EXPECT_EQ(hit.t, infinity);
  EXPECT_FALSE(any(tracer, ray.without_limits()));
}

TEST_P(TracerOf, ServesRaysWithoutLimitsAndHitsWithoutWeights) {
  const Tracer tracer = TracerOf::tracer(squares_and_ball());
  OneRay ray;
  ray.ox = 0.5F;
  ray.oz = 2;
  float t = 0;
  std::int32_t primitive = 99;
  tracer.closest_hit(ray.without_limits(), {&t, nullptr, nullptr, &primitive});
  EXPECT_EQ(t, 2.0F);
  EXPECT_EQ(primitive, 0);
  EXPECT_TRUE(any(tracer, ray.without_limits()));
}

TEST_P(TracerOf, TakesTheSmallestIdOfEqualHits) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  for (int i = 0; i < 50; ++i) add(builder, grid(1, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material);
  const Tracer tracer = TracerOf::tracer(builder.build());
  OneRay ray;
  ray.oz = 1;
  for (const float x : {-0.5F, 0.0F, 0.5F}) {
    ray.ox = x;
    EXPECT_EQ(closest(tracer, ray.arrays()).primitive, x < 0 ? 1 : 0);
  }
}

TEST_P(TracerOf, AnEmptySceneHitsNothing) {
  const Tracer tracer = TracerOf::tracer(SceneBuilder().build());
  EXPECT_EQ(closest(tracer, OneRay().arrays()).primitive, no_primitive);
  EXPECT_FALSE(any(tracer, OneRay().arrays()));
  EXPECT_EQ(tracer.bvh_stats().block_count, 0U);
}

TEST_P(TracerOf, NoRaysAreNoTrouble) {
  const Tracer tracer = TracerOf::tracer(squares_and_ball());
  tracer.closest_hit({}, {});
  tracer.any_hit({}, nullptr);
}

// Writes no further than the rays go.
TEST_P(TracerOf, LeavesWhatIsBehindTheRaysAlone) {
  const Tracer tracer = TracerOf::tracer(squares_and_ball());
  std::vector<float> zeros(17, 0.0F);
  std::vector<float> down(17, -1.0F);
  std::vector<float> high(17, 2.0F);
  std::vector<float> t(18, -3.0F);
  std::vector<float> u(18, -3.0F);
  std::vector<float> v(18, -3.0F);
  std::vector<std::int32_t> primitive(18, -3);
  std::vector<std::uint8_t> hit(18, 77);
  const RayArrays rays{zeros.data(), zeros.data(), high.data(), zeros.data(), zeros.data(), down.data(),
                       nullptr,      nullptr,      17};
  tracer.closest_hit(rays, {t.data(), u.data(), v.data(), primitive.data()});
  tracer.any_hit(rays, hit.data());
  EXPECT_EQ(primitive[16], 0);
  EXPECT_EQ(hit[16], 1);
  EXPECT_EQ(t[17], -3.0F);
  EXPECT_EQ(u[17], -3.0F);
  EXPECT_EQ(v[17], -3.0F);
  EXPECT_EQ(primitive[17], -3);
  EXPECT_EQ(hit[17], 77);
}

TEST_P(TracerOf, CanBeMoved) {
  Tracer first = tracer(squares_and_ball());
  Tracer second = std::move(first);
  OneRay ray;
  ray.oz = -3;
  EXPECT_EQ(closest(second, ray.arrays()).primitive, 4);
  first = tracer(SceneBuilder().build());
  second = std::move(first);
  EXPECT_EQ(closest(second, ray.arrays()).primitive, no_primitive);
  EXPECT_EQ(second.isa(), GetParam());
}

Scene rough_ball() {
  Random random(1);
  SceneBuilder builder;
  add(builder, jittered(icosphere(3), 0.01F, random), builder.add_material({}));
  return builder.build();
}

TEST_P(TracerOf, KnowsItsTree) {
  const Tracer tracer = TracerOf::tracer(rough_ball());
  const BvhStats& stats = tracer.bvh_stats();
  EXPECT_EQ(tracer.scene().primitive_count(), 1280U);
  if (GetParam() == Isa::scalar)
    EXPECT_EQ(stats.block_count, 0U);
  else
    EXPECT_GE(stats.block_count, 320U);
  EXPECT_GE(stats.leaf_count, 1280U / 16);
  EXPECT_GT(stats.node_count, 10U);
  EXPECT_GT(stats.depth, 1);
  EXPECT_GT(stats.sah_cost, 1.0);
  EXPECT_GT(stats.bytes_per_primitive, GetParam() == Isa::scalar ? 10.0 : 40.0);
  EXPECT_LT(stats.bytes_per_primitive, 400.0);
  EXPECT_GT(stats.build_seconds, 0.0);
}

// A tree of instances stands on the trees of what they show.
TEST_P(TracerOf, CountsTheLevelsOfPrototypesToo) {
  const auto built = [](bool shown) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add_material({});
    if (shown) builder.begin_prototype();
    add(builder, icosphere(3), material);
    if (shown) builder.add_instance(builder.end_prototype(), Affine{});
    return builder.build();
  };
  const BvhStats alone = TracerOf::tracer(built(false)).bvh_stats();
  const BvhStats once = TracerOf::tracer(built(true)).bvh_stats();
  EXPECT_GE(once.depth, alone.depth);
  EXPECT_GE(once.node_count, alone.node_count);
  EXPECT_GE(once.leaf_count, alone.leaf_count);
  EXPECT_GE(once.sah_cost, alone.sah_cost);
}

INSTANTIATE_TEST_SUITE_P(Isas, TracerOf, testing::ValuesIn(available_isas()), IsaWord());

TEST(ScalarTracer, ReportsTheTreeThatItTraces) {
  TracerSettings settings;
  settings.isa = Isa::scalar;
  Random random(2);
  SceneBuilder builder;
  add(builder, soup(2000, 0.3F, random), builder.add_material({}));
  const Scene scene = builder.build();
  const Tracer standard(scene, settings);
  settings.quality = BvhQuality::high;
  const Tracer high(scene, settings);
  for (const Tracer* tracer : {&standard, &high}) {
    const BinaryTree& tree = tracer->parts().scalar_bvh->tree();
    EXPECT_EQ(tracer->bvh_stats().node_count, tree.nodes.size());
    EXPECT_EQ(tracer->bvh_stats().leaf_count, (tree.nodes.size() + 1) / 2);
    EXPECT_EQ(tracer->bvh_stats().sah_cost, sah_cost(tree));
    EXPECT_TRUE(tracer->parts().nodes.empty());
  }
  EXPECT_LT(high.bvh_stats().sah_cost, standard.bvh_stats().sah_cost);
}

TEST(TracerSettings, TakeTheWidestIsaByThemselves) {
  EXPECT_EQ(TracerSettings().isa, available_isas().front());
  EXPECT_EQ(Tracer(SceneBuilder().build()).isa(), available_isas().front());
}

TEST(TracerRows, AreNoMoreThanKernelsReach) {
  // Nineteen words each: the last place of the last row is below 2^31.
  EXPECT_NO_THROW(check_row_count<ConeRow>(113'025'455, "cones"));
  EXPECT_THROW(check_row_count<ConeRow>(113'025'456, "cones"), LimitError);
}

} // namespace
} // namespace fastrt::test
