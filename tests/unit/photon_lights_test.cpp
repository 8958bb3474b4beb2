// SPDX-License-Identifier: Apache-2.0
#include "src/film/photon_sampling.hpp"
#include "src/scene/eye_projection.hpp"
#include "src/scene/photon_lights.hpp"

#include <fastrt/error.hpp>
#include <fastrt/render.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fastrt {
namespace {

Material mirror() {
  Material material;
  material.mirror = Vec3(1.0F);
  return material;
}

// A wide matt floor and a mirror ball of radius 0.5 at (0, 2, 0).
SceneBuilder ball_over_floor() {
  SceneBuilder builder;
  builder.add_disk({0, 0, 0}, {0, 1, 0}, 10, builder.add_material({}), "floor");
  builder.add_sphere({0, 2, 0}, 0.5F, builder.add_material(mirror()), "ball");
  return builder;
}

Light lamp(LightKind kind) {
  Light light;
  light.kind = kind;
  light.position = {3, 6, 0};
  light.direction = {-3, -4, 0};
  light.intensity = {1, 0.5F, 0.25F};
  return light;
}

// How far a photon's ray passes the ball's middle.
double distance_to_ball(const PhotonLight& row, const Light& light, std::uint32_t index) {
  const SampleOffset place =
      photon_place(index, row.count, row.cells.data(), static_cast<std::uint32_t>(row.cells.size()),
                   photon_key(index, 0, 0));
  glm::dvec3 origin = light.position, way = row.w;
  if (light.kind == LightKind::directional) {
    origin = row.middle + row.half_side * (place.x * row.u + place.y * row.v);
  } else {
    const LightPlace d = cap_direction(place, row.cap_height);
    way = d.x * row.u + d.y * row.v + d.z * row.w;
  }
  return glm::length(glm::cross(glm::normalize(way), glm::dvec3(0, 2, 0) - origin));
}

TEST(PhotonLights, CausticPhotonsGoToWhatReflects) {
  for (const LightKind kind : {LightKind::point, LightKind::directional, LightKind::spot}) {
    SceneBuilder builder = ball_over_floor();
    const Light light = lamp(kind);
    builder.add_light(light);
    const PhotonPlan plan = plan_caustic_photons(builder.build(), 10000);
    ASSERT_EQ(plan.lights.size(), 1U);
    EXPECT_EQ(plan.count, 10000U);
    int near = 0;
    for (std::uint32_t i = 0; i < 10000; ++i)
      near += distance_to_ball(plan.lights[0], light, i) < 0.5 ? 1 : 0;
    EXPECT_GT(near, 6000) << static_cast<int>(kind);
    // The ball's share of the light arrives, however many photons miss.
    const double expected = kind == LightKind::directional
                                ? std::numbers::pi * 0.25
                                : 2 * std::numbers::pi * (1 - std::sqrt(1 - 0.25 / 25));
    EXPECT_NEAR(double(plan.lights[0].flux.x) * near / 10000, expected, 0.02 * expected)
        << static_cast<int>(kind);
  }
}

// Instances are where they are shown, and of the material that they show; prototypes are nowhere.
TEST(PhotonLights, CausticPhotonsGoToInstances) {
  const auto plan_of = [](bool shines, int instances, bool turned_over) {
    SceneBuilder builder;
    const std::uint32_t matt = builder.add_material({}), shining = builder.add_material(mirror());
    builder.add_disk({0, 0, 0}, {0, 1, 0}, 10, matt);
    builder.begin_prototype();
    builder.add_sphere({0, 0, 0}, 2, shines ? shining : matt);
    builder.add_disk({0, 0, 0}, {1, 0, 0}, 1, matt);
    const std::uint32_t prototype = builder.end_prototype();
    const Affine map{{0, 0.25F, 0}, {0.25F, 0, 0}, {0, 0, 0.25F}, {0, 2, 0}};
    for (int i = 0; i < instances; ++i)
      builder.add_instance(prototype, map, !turned_over ? no_index : shines ? matt : shining);
    builder.add_light(lamp(LightKind::point));
    return plan_caustic_photons(builder.build(), 10000);
  };
  EXPECT_EQ(plan_of(true, 0, false).count, 0U);
  EXPECT_EQ(plan_of(true, 1, true).count, 0U);
  EXPECT_EQ(plan_of(false, 1, false).count, 0U);
  for (const auto& plan : {plan_of(true, 1, false), plan_of(false, 1, true), plan_of(false, 2000, true)}) {
    ASSERT_EQ(plan.lights.size(), 1U);
    EXPECT_EQ(plan.count, 10000U);
    int near = 0;
    for (std::uint32_t i = 0; i < 10000; ++i)
      near += distance_to_ball(plan.lights[0], lamp(LightKind::point), i) < 0.5 ? 1 : 0;
    EXPECT_GT(near, 2000); // of the ball around the instance's box, a third
    EXPECT_NEAR(double(plan.lights[0].flux.x) * near / 10000,
                2 * std::numbers::pi * (1 - std::sqrt(1 - 0.25 / 25)), 0.002);
  }
}

TEST(PhotonLights, WhoSendsPhotons) {
  SceneBuilder builder = ball_over_floor();
  builder.add_light(lamp(LightKind::point));
  Light dark = lamp(LightKind::point);
  dark.intensity = Vec3(0.0F);
  builder.add_light(dark);
  Light soft = lamp(LightKind::point);
  soft.casts_shadows = false;
  builder.add_light(soft);
  const Scene scene = builder.build();
  EXPECT_EQ(plan_caustic_photons(scene, 100).lights.size(), 1U); // light without shadows goes everywhere
  const PhotonPlan forward = plan_forward_photons(scene, 101);
  ASSERT_EQ(forward.lights.size(), 2U);
  EXPECT_EQ(forward.lights[1].light, 2U);
  EXPECT_NEAR(static_cast<double>(forward.lights[0].count), 50.5, 1);
}

// A unit square that shines 3 to both sides, alone and beside a point: each sends by its light.
TEST(PhotonLights, MeshesSendTheirShare) {
  SceneBuilder builder = ball_over_floor();
  Material shining;
  shining.emission = {2, 1, 0};
  Light mesh = lamp(LightKind::mesh);
  mesh.intensity = Vec3(1.5F);
  mesh.material = builder.add_material(shining);
  const std::vector<Vec3> corners{{0, 5, 0}, {1, 5, 0}, {1, 5, 1}, {0, 5, 1}};
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  builder.add_mesh(corners, indices, mesh.material);
  builder.add_light(mesh);
  for (const bool caustic : {false, true}) {
    const Scene scene = SceneBuilder(builder).build();
    const PhotonPlan plan = caustic ? plan_caustic_photons(scene, 1000) : plan_forward_photons(scene, 1000);
    ASSERT_EQ(plan.lights.size(), 1U) << caustic;
    EXPECT_EQ(plan.lights[0].cells.size(), std::size_t{emission_side} * emission_side);
    EXPECT_FLOAT_EQ(plan.lights[0].flux.x, 6.0F);
    EXPECT_FLOAT_EQ(plan.lights[0].flux.y, 3.0F);
  }
  Light point = lamp(LightKind::point); // that fades as its light spreads
  point.intensity = Vec3(1.0F);
  point.constant = 0;
  point.quadratic = 1;
  builder.add_light(point);
  const PhotonPlan plan = plan_forward_photons(builder.build(), 100000);
  ASSERT_EQ(plan.lights.size(), 2U);
  const double sent = 4 * std::numbers::pi * static_cast<double>(plan.lights[1].cells.size()) / 4096;
  EXPECT_NEAR(plan.lights[0].count, 1e5 * 6 / (6 + sent), 2);
}

TEST(PhotonLights, NothingToSend) {
  SceneBuilder builder;
  builder.add_sphere({0, 0, 0}, 1, builder.add_material({}));
  EXPECT_EQ(plan_forward_photons(builder.build(), 100).count, 0U);
  builder = {};
  builder.add_sphere({0, 0, 0}, 1, builder.add_material({}));
  builder.add_light(lamp(LightKind::point));
  EXPECT_EQ(plan_caustic_photons(builder.build(), 100).count, 0U); // nothing reflects
  builder = {};
  builder.add_plane({0, 0, 0}, {0, 1, 0}, builder.add_material(mirror()));
  builder.add_light(lamp(LightKind::directional));
  builder.add_light(lamp(LightKind::point));
  const PhotonPlan plan = plan_caustic_photons(builder.build(), 100); // no bounds for parallel light
  ASSERT_EQ(plan.lights.size(), 1U);
  EXPECT_EQ(plan.lights[0].cells.size(), std::size_t{emission_side} * emission_side);
}

TEST(EyeProjection, FindsTheImagePoint) {
  Camera camera{{1, 2, 5}, {0.2F, 0, 0}, {0.1F, 1, 0}, 50};
  for (const bool orthographic : {false, true}) {
    camera.projection = orthographic ? Projection::orthographic : Projection::perspective;
    const CameraFrame frame = make_camera_frame(camera, 40, 30);
    const EyeProjection eye = make_eye_projection(frame);
    for (const Vec2 at : {Vec2(0, 0), Vec2(20, 15), Vec2(3.5F, 28)}) {
      const Vec3 image = (frame.corner + at.x * frame.du) + at.y * frame.dv;
      const Vec3 point = orthographic ? image + 4.0F * frame.direction : frame.eye + 4.0F * image;
      const Vec3 q = point - eye.origin;
      const float z = glm::dot(q, eye.w), scale = orthographic ? 1.0F : 1.0F / z;
      EXPECT_NEAR(z, 4, 1e-4F);
      EXPECT_NEAR(glm::dot(q, eye.u) * scale, at.x, 1e-3F);
      EXPECT_NEAR(glm::dot(q, eye.v) * scale, at.y, 1e-3F);
    }
  }
}

TEST(EyeProjection, RefusesALens) {
  Camera camera;
  camera.aperture_radius = 0.1F;
  EXPECT_THROW(make_eye_projection(make_camera_frame(camera, 4, 4)), UsageError);
}

// Settings that make no sense are refused by both paths.
TEST(PhotonSettings, AreChecked) {
  SceneBuilder builder = ball_over_floor();
  builder.add_light(lamp(LightKind::point));
  const Scene scene = builder.build();
  const auto refused = [&](const auto& change) {
    RenderSettings settings;
    settings.width = settings.height = 2;
    change(settings);
    EXPECT_THROW(render_reference(scene, {}, settings), UsageError);
    EXPECT_THROW(render(Tracer{Scene(scene)}, {}, settings), UsageError);
  };
  refused([](RenderSettings& s) { s.integrator = Integrator::forward, s.photons = 0; });
  refused([](RenderSettings& s) { s.integrator = Integrator::forward, s.photons = (1LL << 30) + 1; });
  refused([](RenderSettings& s) { s.integrator = Integrator::forward, s.caustic_photons = 1; });
  refused([](RenderSettings& s) { s.integrator = Integrator::forward, s.adaptive = 0.1F; });
  refused([](RenderSettings& s) { s.caustic_photons = -1; });
  refused([](RenderSettings& s) { s.caustic_radius = -1; });
}

TEST(PhotonSettings, PhotonsCanBeCancelled) {
  SceneBuilder builder = ball_over_floor();
  builder.add_light(lamp(LightKind::point));
  const Tracer tracer{builder.build()};
  std::atomic<bool> cancelled = false;
  RenderSettings settings;
  settings.width = settings.height = 4;
  settings.integrator = Integrator::forward;
  settings.photons = 1 << 28;
  settings.cancelled = &cancelled;
  double last = 0;
  settings.progress = [&](double done) {
    EXPECT_GT(done, last);
    last = done;
    if (done > 1e-3) cancelled = true;
  };
  EXPECT_FALSE(render(tracer, {}, settings).complete);
  EXPECT_LT(last, 0.1);
}

} // namespace
} // namespace fastrt
