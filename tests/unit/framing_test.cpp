// SPDX-License-Identifier: Apache-2.0
#include <fastrt/camera.hpp>
#include <fastrt/error.hpp>
#include <fastrt/load.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fastrt {
namespace {

Vec3 corner_of(const Aabb& box, unsigned i) {
  return {(i & 1U) != 0 ? box.upper.x : box.lower.x, (i & 2U) != 0 ? box.upper.y : box.lower.y,
          (i & 4U) != 0 ? box.upper.z : box.lower.z};
}

// The largest |coordinate| that a corner of the box has in the picture; 1 is its border, infinity behind the
// eye.
double largest_extent(const Aabb& box, const Camera& camera, float aspect) {
  using Vec3d = glm::dvec3;
  const Vec3d forward = glm::normalize(Vec3d(camera.look_at) - Vec3d(camera.eye));
  const Vec3d right = glm::normalize(glm::cross(forward, Vec3d(camera.up)));
  const Vec3d up = glm::cross(right, forward);
  const double half = std::tan(camera.fov_degrees * 3.14159265358979 / 360);
  double largest = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3d p = Vec3d(corner_of(box, i)) - Vec3d(camera.eye);
    const double depth = glm::dot(p, forward);
    if (depth <= 0) return infinity;
    largest = std::max({largest, std::fabs(glm::dot(p, right)) / (depth * half * aspect),
                        std::fabs(glm::dot(p, up)) / (depth * half)});
  }
  return largest;
}

const Aabb boxes[] = {
    {{-1, -1, -1}, {1, 1, 1}},
    {{0, 0, 0}, {10, 0.1F, 3}},
    {{-5, 2, -5}, {5, 2, 5}},
    {{1, 1, 1}, {1, 4, 1}},
    {{1e5F, -10, 2}, {100020, 10, 4}},
    {{-1e-4F, -2e-4F, 0}, {1e-4F, 1e-4F, 3e-4F}},
    {{-1e7F, 0, -1e7F}, {1e7F, 3e6F, 1e7F}},
};

TEST(FrameScene, ShowsTheWholeBoxTightly) {
  for (const Aabb& box : boxes)
    for (const float fov : {5.0F, 40.0F, 90.0F})
      for (const float aspect : {0.25F, 1.0F, 16.0F / 9, 6.0F}) {
        const Camera camera = frame_scene(box, fov, aspect);
        const double largest = largest_extent(box, camera, aspect);
        EXPECT_LE(largest, 0.975) << fov << ' ' << aspect;
        // Almost 180 degrees from side to side, the eye keeps its distance instead.
        const bool very_wide = fov >= 90 && aspect >= 6;
        EXPECT_GE(largest, very_wide ? 0.3 : 0.93) << fov << ' ' << aspect;
        EXPECT_EQ(camera.fov_degrees, fov);
      }
}

TEST(FrameScene, EveryUpIsUp) {
  const Vec3 ups[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {0, 0, -2}, {0.3F, 0.2F, 0.9F}};
  for (const Vec3& up : ups) {
    const Camera camera = frame_scene(boxes[0], 40, 1, up);
    EXPECT_EQ(camera.up, up);
    EXPECT_NO_THROW(make_camera_frame(camera, 64, 64));
    EXPECT_LE(largest_extent(boxes[0], camera, 1), 0.975);
    // From above, at the same angle for all.
    const Vec3 view = glm::normalize(camera.eye - camera.look_at);
    EXPECT_NEAR(glm::dot(view, glm::normalize(up)), 0.345, 0.001);
  }
}

TEST(FrameScene, TheFrontOfYUpIsZAndOfZUpIsMinusY) {
  const Vec3 y_up = glm::normalize(frame_scene(boxes[0], 40, 1).eye);
  EXPECT_GT(y_up.z, 0.7F);
  EXPECT_GT(y_up.x, 0.3F);
  const Vec3 z_up = glm::normalize(frame_scene(boxes[0], 40, 1, {0, 0, 1}).eye);
  EXPECT_LT(z_up.y, -0.7F);
  EXPECT_GT(z_up.x, 0.3F);
}

TEST(FrameScene, BoxesWithoutSizeStillGiveACamera) {
  const Camera nothing = frame_scene(Aabb{}, 30, 1);
  EXPECT_EQ(nothing.eye, Camera{}.eye);
  EXPECT_EQ(nothing.fov_degrees, 30);
  for (const Vec3& point : {Vec3(0), Vec3(1, 2, 3), Vec3(1e6F, 0, 0)}) {
    const Camera camera = frame_scene({point, point}, 40, 1.5F);
    EXPECT_NO_THROW(make_camera_frame(camera, 8, 8));
    EXPECT_LT(glm::distance(camera.look_at, point), glm::distance(camera.eye, point));
  }
}

TEST(FrameScene, WideViewsStayOutsideOfTheBox) {
  const Camera camera = frame_scene(boxes[0], 175, 1);
  EXPECT_LE(largest_extent(boxes[0], camera, 1), 1);
}

TEST(FrameScene, NonsenseIsRefused) {
  EXPECT_THROW(frame_scene(boxes[0], 0, 1), InputError);
  EXPECT_THROW(frame_scene(boxes[0], 40, 0), InputError);
  EXPECT_THROW(frame_scene(boxes[0], 40, infinity), InputError);
  EXPECT_THROW(frame_scene(boxes[0], 40, 1, {0, 0, 0}), InputError);
  for (const float aspect : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), infinity})
    EXPECT_THROW(orthographic_height(boxes[0], Camera{}, aspect), InputError);
}

// The most that a diffuse grey surface of the given normal gets.
float brightness(const SceneDesc& desc, const Vec3& normal) {
  float light = desc.ambient.value().x;
  for (const Light& l : desc.lights)
    light += l.intensity.x * std::max(0.0F, -glm::dot(glm::normalize(l.direction), normal));
  return 0.8F * light;
}

TEST(DefaultLights, DoNotClipAGreySurfaceAndShowTheFront) {
  const Camera camera = frame_scene(boxes[0], 40, 1);
  SceneDesc desc;
  add_default_lights(desc, boxes[0], camera);
  ASSERT_EQ(desc.lights.size(), 2U);
  EXPECT_TRUE(desc.lights[0].casts_shadows);
  EXPECT_FALSE(desc.lights[1].casts_shadows);
  float brightest = 0;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 50; ++j) {
      const float a = 0.0628318F * static_cast<float>(i), b = 0.0628318F * static_cast<float>(j);
      const Vec3 normal{std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)};
      brightest = std::max(brightest, brightness(desc, normal));
    }
  EXPECT_LE(brightest, 1.0F);
  EXPECT_GE(brightest, 0.8F);
  EXPECT_GE(brightness(desc, glm::normalize(camera.eye - camera.look_at)), 0.4F);
  EXPECT_NO_THROW(Scene{desc});
}

TEST(OrthographicHeight, ShowsAllCornersAndHardlyMore) {
  for (const Aabb& box : boxes)
    for (const float aspect : {0.4F, 1.0F, 2.5F}) {
      Camera camera = frame_scene(box, 40, aspect);
      camera.projection = Projection::orthographic;
      camera.view_height = orthographic_height(box, camera, aspect);
      const CameraAxes axes = camera_axes(camera);
      float most = 0;
      for (int i = 0; i < 8; ++i) {
        const Vec3 p =
            Vec3((i & 1) != 0 ? box.lower.x : box.upper.x, (i & 2) != 0 ? box.lower.y : box.upper.y,
                 (i & 4) != 0 ? box.lower.z : box.upper.z) -
            camera.eye;
        most = std::max({most, std::fabs(glm::dot(p, axes.v)), std::fabs(glm::dot(p, axes.u)) / aspect});
        EXPECT_GT(glm::dot(p, axes.w), 0.0F); // before the eye
      }
      EXPECT_LT(2 * most, camera.view_height);
      EXPECT_GT(2 * most, 0.9F * camera.view_height);
    }
}

TEST(DefaultLights, TheKeyComesFromTheUpperLeft) {
  const Camera camera = frame_scene(boxes[0], 40, 1);
  SceneDesc desc;
  add_default_lights(desc, boxes[0], camera);
  const CameraFrame frame = make_camera_frame(camera, 2, 2);
  EXPECT_GT(glm::dot(desc.lights[0].direction, frame.du), 0.0F);
  EXPECT_GT(glm::dot(desc.lights[0].direction, frame.dv), 0.0F);
}

TEST(DefaultLights, KeepWhatTheSceneHas) {
  SceneDesc desc;
  desc.background = Vec3(0.0F, 0.0F, 1.0F);
  desc.ambient = Vec3(0.5F);
  desc.lights.resize(1);
  add_default_lights(desc, boxes[0], frame_scene(boxes[0], 40, 1));
  EXPECT_EQ(desc.background, Vec3(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(desc.ambient, Vec3(0.5F));
  EXPECT_EQ(desc.lights.size(), 3U);
}

TEST(DefaultLights, BlackIsAColourLikeAnyOther) {
  SceneDesc desc;
  desc.background = desc.ambient = Vec3(0.0F);
  add_default_lights(desc, boxes[0], frame_scene(boxes[0], 40, 1));
  EXPECT_EQ(desc.background, Vec3(0.0F));
  EXPECT_EQ(desc.ambient, Vec3(0.0F));
  SceneDesc silent;
  add_default_lights(silent, boxes[0], frame_scene(boxes[0], 40, 1));
  EXPECT_GT(silent.background.value().x, 0.0F);
  EXPECT_GT(silent.ambient.value().x, 0.0F);
}

TEST(DefaultLights, LightARoomFromTheEye) {
  SceneDesc desc;
  Camera camera;
  camera.eye = {0.5F, 0, 0};
  camera.look_at = {0, 0, 0};
  add_default_lights(desc, boxes[0], camera);
  EXPECT_EQ(desc.lights[0].kind, LightKind::point);
  EXPECT_EQ(desc.lights[0].position, camera.eye);
}

} // namespace
} // namespace fastrt
