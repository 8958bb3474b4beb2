// SPDX-License-Identifier: Apache-2.0
// AOVs against geometry in double precision.
#include "tests/golden/pictures.hpp"

namespace fastrt::test {
namespace {

class Aovs : public Picture {};

std::vector<Aov> all_aovs() {
  std::vector<Aov> all;
  for (std::size_t i = 0; i < aov_count; ++i) all.push_back(static_cast<Aov>(i));
  return all;
}

Light lamp(const Vec3& position, bool casts_shadows = true) {
  Light light;
  light.kind = LightKind::point;
  light.position = position;
  light.casts_shadows = casts_shadows;
  return light;
}

// A ball of radius 1 in the middle, a quad behind it at z = -2.
struct Stage {
  SceneBuilder builder;
  Camera camera;
  RenderSettings settings = settings_of(61, 61);
  Stage() {
    camera.eye = {0, 0, 6};
    camera.look_at = {0, 0, 0};
    settings.aovs = all_aovs();
    builder.set_background(Vec3(0.5F));
    Material red = black();
    red.diffuse = {0.75F, 0.25F, 0.125F};
    const std::uint32_t wall = builder.add_material(black());
    const std::uint32_t ball = builder.add_material(red);
    add_quad(builder, {-2, -2, -2}, {4, 0, 0}, {0, 4, 0}, wall);
    builder.add_sphere({0, 0, 0}, 1, ball);
  }
};

TEST_P(Aovs, GeometryOfABallAndAWall) {
  Stage stage;
  const Pinhole pinhole(stage.camera, stage.settings);
  const Frame frame = render(stage.builder, stage.camera, stage.settings);
  ASSERT_EQ(frame.aovs.size(), aov_count);
  int balls = 0, walls = 0;
  for (int y = 0; y < 61; ++y)
    for (int x = 0; x < 61; ++x) {
      const auto i = static_cast<std::size_t>(61 * y + x);
      const DVec3 d = pinhole.direction(x + 0.5, y + 0.5);
      if (std::fabs(gap(pinhole.eye(), d, {{0, 0, 0}, 1})) < 1e-4) continue;
      const std::int32_t id = frame.find(Aov::id)->ids[i];
      const float* normal = &frame.find(Aov::normal)->values[3 * i];
      const float* position = &frame.find(Aov::position)->values[3 * i];
      const double depth = static_cast<double>(frame.find(Aov::depth)->values[i]);
      EXPECT_EQ(frame.find(Aov::primitive)->ids[i], frame.primitive[i]);
      EXPECT_EQ(frame.find(Aov::material)->ids[i], id); // as it happens
      if (id < 0) {
        EXPECT_EQ(frame.find(Aov::depth)->values[i], infinity);
        continue;
      }
      const bool ball = gap(pinhole.eye(), d, {{0, 0, 0}, 1}) < 0;
      ++(ball ? balls : walls);
      EXPECT_EQ(id, ball ? 1 : 0);
      const double b = glm::dot(pinhole.eye(), d);
      const double expected = ball ? -b - std::sqrt(b * b - 35) : 8 / -d.z;
      EXPECT_NEAR(depth, expected, 1e-4);
      const DVec3 point = pinhole.eye() + expected * d;
      const DVec3 n = ball ? point : DVec3(0, 0, 1);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(position[c], point[c], 1e-4);
        EXPECT_NEAR(normal[c], n[c], 1e-4);
      }
      EXPECT_EQ(frame.find(Aov::albedo)->values[3 * i], ball ? 0.75F : 0.0F);
    }
  EXPECT_GT(balls, 100);
  EXPECT_GT(walls, 100);
}

// A light behind the ball, seen from the ball's front: dark; the wall is lit but for the ball's shadow.
TEST_P(Aovs, ShadowIsTheShareOfLightThatArrives) {
  Stage stage;
  stage.builder.add_light(lamp({0, 0, 6}));
  stage.builder.add_light(lamp({0, 0, -50}));
  stage.builder.add_light(lamp({3, 3, 3}, false)); // counts for nothing
  stage.settings.aovs = {Aov::shadow, Aov::cost, Aov::recursion};
  const Frame frame = render(stage.builder, stage.camera, stage.settings);
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(61 * y + x); };
  EXPECT_EQ(frame.find(Aov::shadow)->values[3 * at(30, 30)], 0.5F); // one of two lights
  EXPECT_EQ(frame.find(Aov::cost)->ids[at(30, 30)], 2);             // itself, and the one shadow ray
  EXPECT_EQ(frame.find(Aov::cost)->ids[at(0, 0)], 1);
  EXPECT_EQ(frame.find(Aov::recursion)->ids[at(30, 30)], 0);
  EXPECT_EQ(frame.find(Aov::normal), nullptr);
}

TEST_P(Aovs, RecursionCountsBounces) {
  SceneBuilder builder;
  const std::uint32_t glass = builder.add_material(clear(1));
  builder.add_sphere({0, 0, 0}, 1, glass);
  builder.add_sphere({0, 0, -3}, 1, glass);
  Camera camera;
  RenderSettings settings = settings_of(9, 9);
  settings.aovs = {Aov::recursion, Aov::cost};
  const Frame frame = render(builder, camera, settings);
  EXPECT_EQ(frame.find(Aov::recursion)->ids[40], 4); // in, out, in, out
  EXPECT_EQ(frame.find(Aov::cost)->ids[40], 5);
  EXPECT_EQ(frame.find(Aov::recursion)->ids[0], 0);
}

TEST_P(Aovs, AreThoseOfThePixelsCentreWhateverTheSamples) {
  Stage one, many;
  many.settings.samples_per_pixel = 5;
  const Frame a = render(one.builder, one.camera, one.settings);
  const Frame b = render(many.builder, many.camera, many.settings);
  EXPECT_EQ(compare(a, b).aovs, 0U);
  EXPECT_NE(compare(a, b).pixels, 0U);
  EXPECT_EQ(b.rays.primary, 6 * a.rays.primary);
}

TEST_P(Aovs, TextureCoordinatesWhereTheMeshHasThem) {
  SceneDesc desc;
  for (const Vec3& p : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(-1, 1, 0)}) desc.positions.push_back(p);
  desc.uvs.x = {2, 4, 2};
  desc.uvs.y = {1, 1, 5};
  desc.triangles.v0 = {0};
  desc.triangles.v1 = {1};
  desc.triangles.v2 = {2};
  desc.triangles.t0 = {0};
  desc.triangles.t1 = {1};
  desc.triangles.t2 = {2};
  desc.triangles.material = {0};
  desc.triangles.object = {0};
  desc.materials.emplace_back();
  desc.object_names.emplace_back("one");
  RenderSettings settings = settings_of(41, 41);
  settings.aovs = {Aov::uv, Aov::position};
  const Frame frame = GetParam().render(Scene(std::move(desc)), Camera{}, settings);
  int seen = 0;
  for (std::size_t i = 0; i < frame.primitive.size(); ++i) {
    if (frame.primitive[i] < 0) continue;
    ++seen;
    const float* p = &frame.find(Aov::position)->values[3 * i];
    EXPECT_NEAR(frame.find(Aov::uv)->values[2 * i], 2 + (p[0] + 1), 1e-5F);
    EXPECT_NEAR(frame.find(Aov::uv)->values[2 * i + 1], 1 + 2 * (p[1] + 1), 1e-5F);
  }
  EXPECT_GT(seen, 100);
}

FASTRT_PICTURES(Aovs);

} // namespace
} // namespace fastrt::test
