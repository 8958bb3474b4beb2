// SPDX-License-Identifier: Apache-2.0
#include <fastrt/camera.hpp>
#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fastrt {
namespace {

Vec3 direction(const CameraFrame& frame, float px, float py) {
  return (frame.corner + px * frame.du) + py * frame.dv;
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-6F) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(CameraFrame, LooksDownMinusZWithXRightAndYUp) {
  Camera camera; // at (0, 0, 5), towards the origin
  camera.fov_degrees = 90;
  const CameraFrame frame = make_camera_frame(camera, 200, 100);
  EXPECT_EQ(frame.eye, Vec3(0, 0, 5));
  expect_near(direction(frame, 100, 50), {0, 0, -1});
  expect_near(direction(frame, 0, 0), {-2, 1, -1});
  expect_near(direction(frame, 200, 0), {2, 1, -1});
  expect_near(direction(frame, 0, 100), {-2, -1, -1});
}

TEST(CameraFrame, TheFieldOfViewIsVertical) {
  Camera camera;
  camera.fov_degrees = 40;
  for (const int width : {10, 100, 1000}) {
    const CameraFrame frame = make_camera_frame(camera, width, 100);
    const Vec3 top = direction(frame, static_cast<float>(width) / 2, 0);
    EXPECT_NEAR(std::atan2(top.y, -top.z) * 180 / 3.14159265, 20, 1e-4);
    EXPECT_FLOAT_EQ(glm::length(frame.du), glm::length(frame.dv)); // square pixels
  }
}

TEST(CameraFrame, AnyOrientationIsRightHandedAndOrthogonal) {
  Camera camera;
  camera.eye = {3, -2, 7};
  camera.look_at = {-1, 4, 0.5F};
  camera.up = {0.1F, 0.3F, 5};
  const CameraFrame frame = make_camera_frame(camera, 640, 480);
  const Vec3 forward = direction(frame, 320, 240);
  expect_near(forward, glm::normalize(camera.look_at - camera.eye));
  EXPECT_NEAR(glm::dot(frame.du, frame.dv), 0, 1e-9);
  EXPECT_NEAR(glm::dot(frame.du, forward), 0, 1e-9);
  EXPECT_NEAR(glm::dot(frame.du, camera.up), 0, 1e-7);
  EXPECT_LT(glm::dot(frame.dv, camera.up), 0);
  // Right, down and forward, in this order, are right-handed.
  EXPECT_GT(glm::dot(glm::cross(frame.du, frame.dv), forward), 0);
}

TEST(CameraFrame, HugeAndTinyDistancesWork) {
  for (const float size : {1e-20F, 1e-3F, 1e5F, 1e30F}) {
    Camera camera;
    camera.eye = {0, 0, size};
    camera.up = {0, size, 0};
    expect_near(direction(make_camera_frame(camera, 2, 2), 1, 1), {0, 0, -1});
  }
}

TEST(CameraFrame, DegenerateCamerasAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const Camera good;
  EXPECT_NO_THROW(make_camera_frame(good, 1, 1));
  for (const float fov : {0.0F, -1.0F, 180.0F, 400.0F, nan, inf}) {
    Camera camera = good;
    camera.fov_degrees = fov;
    EXPECT_THROW(make_camera_frame(camera, 8, 8), InputError) << fov;
  }
  for (const Vec3& up : {Vec3(0), Vec3(0, 0, 1), Vec3(0, 0, -3), Vec3(nan, 1, 0), Vec3(0, inf, 0)}) {
    Camera camera = good;
    camera.up = up;
    EXPECT_THROW(make_camera_frame(camera, 8, 8), InputError) << up.x << ' ' << up.y << ' ' << up.z;
  }
  for (const Vec3& eye : {good.look_at, Vec3(nan, 0, 5), Vec3(0, inf, 5)}) {
    Camera camera = good;
    camera.eye = eye;
    EXPECT_THROW(make_camera_frame(camera, 8, 8), InputError) << eye.x << ' ' << eye.y << ' ' << eye.z;
    std::swap(camera.eye, camera.look_at);
    EXPECT_THROW(make_camera_frame(camera, 8, 8), InputError);
  }
}

} // namespace
} // namespace fastrt
