// SPDX-License-Identifier: Apache-2.0
// Deformed spheres, cylinders and cones against geometry: outlines and normals in pictures of every path, and
// rays against long double.
#include "src/reference/hit_finder.hpp"
#include "tests/golden/cone_truth.hpp"
#include "tests/golden/pictures.hpp"
#include "tests/unit/instance_scenes.hpp"

#include <cstdlib>

namespace fastrt::test {
namespace {

using DMat3 = glm::dmat3;
using Mat3l = glm::mat<3, 3, long double, glm::defaultp>;

template <class Matrix>
Matrix matrix_of(const Affine& map) {
  using Column = typename Matrix::col_type;
  return {Column(map.x), Column(map.y), Column(map.z)};
}

Camera parallel_camera(const Vec3& towards, const Vec3& look_at, float height) {
  Camera camera;
  camera.look_at = look_at;
  camera.eye = look_at - 10.0F * towards;
  camera.up = axes_across(towards).x;
  camera.projection = Projection::orthographic;
  camera.view_height = height;
  return camera;
}

const AovPlane& plane_of(const Frame& frame, Aov aov) {
  return *std::find_if(frame.aovs.begin(), frame.aovs.end(),
                       [&](const auto& plane) { return plane.aov == aov; });
}
DVec3 vector_at(const AovPlane& plane, std::size_t pixel) {
  return {plane.values[3 * pixel], plane.values[3 * pixel + 1], plane.values[3 * pixel + 2]};
}

class InstancePictures : public Picture {};

// The shadow of the map M of a unit ball along the unit vector w has the area pi |det M| |M^-1 w|.
TEST_P(InstancePictures, EllipsoidsHaveTheRightOutline) {
  Random random(21);
  for (int i = 0; i < 4; ++i) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add_material(glowing(Vec3(1.0F)));
    builder.begin_prototype();
    builder.add_sphere({0, 0, 0}, 1, material);
    const Affine map = any_map(3.0F * random.in_cube(), 1, 0.8F, random);
    builder.add_instance(builder.end_prototype(), map);
    const Vec3 towards = random.direction();
    const RenderSettings settings = settings_of(300, 300);
    const float height = 8;
    const Frame frame = render(builder, parallel_camera(towards, map.origin, height), settings);
    const auto matrix = matrix_of<DMat3>(map);
    const double expected = std::numbers::pi * std::fabs(glm::determinant(matrix)) *
                            glm::length(glm::inverse(matrix) * DVec3(towards));
    const auto seen = std::count(frame.primitive.begin(), frame.primitive.end(), 0);
    const double pixel = height / 300.0 * (height / 300.0);
    EXPECT_NEAR(static_cast<double>(seen) * pixel, expected, 0.004 * expected + 20 * pixel);
  }
}

// The normal of a quadric is its gradient: of |q|^2, of |(x, y)|^2 or of that minus the radius squared, where
// q is the point in object space.
void expect_gradients(const Frame& frame, const Affine& map,
                      const std::function<DVec3(const DVec3&)>& gradient, const Vec3& towards) {
  const auto matrix = matrix_of<DMat3>(map);
  const DMat3 inverse = glm::inverse(matrix);
  const AovPlane &normals = plane_of(frame, Aov::normal), &positions = plane_of(frame, Aov::position);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < frame.primitive.size(); ++i) {
    if (frame.primitive[i] < 0) continue;
    ++seen;
    const DVec3 q = inverse * (vector_at(positions, i) - DVec3(map.origin));
    DVec3 expected = glm::normalize(glm::transpose(inverse) * gradient(q));
    if (glm::dot(expected, DVec3(towards)) > 0) expected = -expected;
    ASSERT_LT(glm::length(vector_at(normals, i) - expected), 2e-4) << i;
  }
  EXPECT_GT(seen, frame.primitive.size() / 100);
}

TEST_P(InstancePictures, NormalsAreTheGradientsOfDeformedQuadrics) {
  Random random(22);
  const std::function<DVec3(const DVec3&)> gradients[] = {
      [](const DVec3& q) { return q; },
      [](const DVec3& q) {
        if (std::fabs(std::fabs(q.z) - 1) < 1e-4) return DVec3(0, 0, 1);
        return DVec3(q.x, q.y, 0);
      },
      [](const DVec3& q) { // the radius falls from 1 at z = -1 to 0 at z = 1
        if (q.z < -1 + 1e-4) return DVec3(0, 0, 1);
        return DVec3(q.x, q.y, 0.25 * (1 - q.z));
      }};
  for (int i = 0; i < 9; ++i) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add_material({});
    builder.begin_prototype();
    if (i % 3 == 0) builder.add_sphere({0, 0, 0}, 1, material);
    if (i % 3 == 1) builder.add_cylinder({0, 0, -1}, {0, 0, 1}, 1, material);
    if (i % 3 == 2) builder.add_cone({0, 0, -1}, 1, {0, 0, 1}, 0, material);
    const Affine map = any_map(2.0F * random.in_cube(), 1, 0.7F, random);
    builder.add_instance(builder.end_prototype(), map);
    const Vec3 towards = random.direction();
    RenderSettings settings = settings_of(60, 60);
    settings.aovs = {Aov::normal, Aov::position};
    expect_gradients(render(builder, parallel_camera(towards, map.origin, 5), settings), map,
                     gradients[i % 3], towards);
  }
}

// A picture of instances is that of the primitives that they stand for, where maps lose nothing: by powers of
// two.
TEST_P(InstancePictures, AreThoseOfWhatTheyStandFor) {
  SceneBuilder instances, primitives;
  for (SceneBuilder* builder : {&instances, &primitives}) {
    builder->add_material(glowing({1, 0.5F, 0.25F}));
    builder->add_material(mirror(0.5F));
    add_quad(*builder, {-8, -2, 8}, {16, 0, 0}, {0, 0, -16}, 1);
  }
  instances.begin_prototype();
  instances.add_sphere({1, 0, 0}, 0.5F, 0);
  const std::uint32_t ball = instances.end_prototype();
  instances.add_instance(ball, scaled(Vec3(2.0F), {-2, 0, 0}));
  instances.add_instance(ball, scaled({-4, 4, 4}, {0, 1, -4}), 1);
  primitives.add_sphere({0, 0, 0}, 1, 0);
  primitives.add_sphere({-4, 1, -4}, 2, 1);
  const Camera camera{{3, 3, 9}, {0, 0, 0}, {0, 1, 0}, 50};
  const RenderSettings settings = settings_of(120, 90);
  const Frame found = render(instances, camera, settings), expected = render(primitives, camera, settings);
  std::size_t different = 0;
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x)
      different += difference(color_at(found, x, y), color_at(expected, x, y)) > 1e-4 ? 1 : 0;
  EXPECT_LE(different, 10U); // at outlines
}

FASTRT_PICTURES(InstancePictures);

// More by hand: FASTRT_RAYS=10000000.
std::size_t ray_count() {
  const char* count = std::getenv("FASTRT_RAYS");
  return count != nullptr ? std::strtoull(count, nullptr, 10) : 100000;
}

struct Deformed {
  Scene scene;
  Vec3l origin;  // of the map
  Mat3l inverse; // exact, of the map as it is
  Affine map;
};

template <class Add>
Deformed deformed(Random& random, const Add& add_primitive) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  builder.begin_prototype();
  add_primitive(builder, material);
  const Affine map = any_map(random.in_cube(), 1, 1.5F, random);
  builder.add_instance(builder.end_prototype(), map);
  return {builder.build(), Vec3l(map.origin), glm::inverse(matrix_of<Mat3l>(map)), map};
}

// Towards the outline of a unit ball, more or less, as the map shows it.
reference::Ray ray_at(const Affine& map, Random& random) {
  const auto there = [&](const Vec3& p) { return ((map.x * p.x + map.y * p.y) + map.z * p.z) + map.origin; };
  reference::Ray ray;
  const Vec3 from = std::exp(random.uniform(0.5F, 6)) * random.direction();
  ray.origin = there(from);
  const Vec3 across = glm::normalize(glm::cross(from, random.direction()));
  ray.direction = there(random.uniform(0, 1.3F) * across) - ray.origin;
  return ray;
}

// Wrong answers are allowed within 1e-6 of the outline, as a share of the distance and the size.
TEST(DeformedSpheres, AreMetWhereGeometrySays) {
  Random random(23);
  const std::size_t count = ray_count();
  std::size_t hits = 0, wrong = 0, near = 0;
  for (std::size_t i = 0; i < count / 50; ++i) {
    const Deformed ball = deformed(random, [](SceneBuilder& builder, std::uint32_t material) {
      builder.add_sphere({0, 0, 0}, 1, material);
    });
    const reference::BruteForce finder(ball.scene);
    for (int k = 0; k < 50; ++k) {
      const reference::Ray ray = ray_at(ball.map, random);
      const reference::Hit found = finder.closest(ray);
      const Vec3l o = ball.inverse * (Vec3l(ray.origin) - ball.origin),
                  d = ball.inverse * Vec3l(ray.direction);
      const Real middle = -glm::dot(o, d) / glm::dot(d, d);
      const Real gap = glm::length(o + middle * d) - 1, slack = outline_tolerance * (glm::length(o) + 1);
      hits += found.found() ? 1U : 0U;
      near += std::fabs(gap) < slack ? 1U : 0U;
      if (std::fabs(gap) < slack) continue;
      bool right = found.found() == (gap < 0);
      if (right && found.found()) {
        const Real half = std::sqrt(1 - (gap + 1) * (gap + 1)); // of the chord: also the cosine
        const Real t = middle - half / glm::length(d);
        right = std::fabs(Real(found.t) - t) * glm::length(d) * half < 4 * slack;
      }
      wrong += right ? 0U : 1U;
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(hits, count / 2);
  EXPECT_LT(near, count / 1000);
  RecordProperty("hits", static_cast<int>(hits));
  RecordProperty("near", static_cast<int>(near));
}

TEST(DeformedCones, AreMetWhereGeometrySays) {
  Random random(24);
  const std::size_t count = ray_count();
  std::size_t hits = 0, wrong = 0;
  for (std::size_t i = 0; i < count / 50; ++i) {
    const Deformed made = deformed(random, [&](SceneBuilder& builder, std::uint32_t material) {
      add_any_cone(builder, material, Vec3(0.0F), 0.7F, random);
    });
    const ConeColumns& c = made.scene.desc().cones;
    const Cone cone{Vec3l(c.base[0]), Vec3l(c.apex[0]), c.base_radius[0], c.apex_radius[0], c.capped[0] != 0};
    const reference::BruteForce finder(made.scene);
    for (int k = 0; k < 50; ++k) {
      const reference::Ray ray = ray_at(made.map, random);
      const reference::Hit found = finder.closest(ray);
      const Vec3l o = made.inverse * (Vec3l(ray.origin) - made.origin),
                  d = made.inverse * Vec3l(ray.direction);
      const Judgement judged = judge(cone, o, d, {found.found(), found.t});
      hits += judged.hit ? 1U : 0U;
      wrong += judged.wrong ? 1U : 0U;
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(hits, count / 4);
}

} // namespace
} // namespace fastrt::test
