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

// The lecture's p_ij = (wl + i du, wt + j dv, f).
TEST(CameraFrame, TheWindowIsTheLectures) {
  Camera camera;
  camera.eye = {1, 2, 3};
  camera.look_at = {4, -1, -2};
  camera.window = Window{-0.7F, 1.1F, -0.4F, 0.3F};
  camera.focal_distance = 2.5F;
  const CameraAxes axes = camera_axes(camera);
  constexpr int nc = 7, nr = 5;
  const CameraFrame frame = make_camera_frame(camera, nc, nr);
  for (int j = 0; j < nr; ++j)
    for (int i = 0; i < nc; ++i) {
      const float x = -0.7F + static_cast<float>(i) * (1.1F - -0.7F) / (nc - 1);
      const float y = 0.3F + static_cast<float>(j) * (-0.4F - 0.3F) / (nr - 1);
      const Vec3 expected = x * axes.u + y * axes.v + 2.5F * axes.w;
      const Vec3 found = 2.5F * direction(frame, static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F);
      EXPECT_NEAR(glm::length(found - expected), 0, 1e-6F) << i << ' ' << j;
    }
  // One pixel shows the upper left corner.
  const Vec3 single = 2.5F * direction(make_camera_frame(camera, 1, 1), 0.5F, 0.5F);
  EXPECT_NEAR(glm::length(single - (-0.7F * axes.u + 0.3F * axes.v + 2.5F * axes.w)), 0, 1e-6F);
}

TEST(CameraFrame, AxesAreOrthonormal) {
  Camera camera;
  camera.eye = {3, 1, -2};
  camera.look_at = {-1, 5, 2};
  camera.up = {0.1F, 2, -0.4F};
  const auto [u, v, w] = camera_axes(camera);
  EXPECT_NEAR(glm::length(glm::cross(u, v) + w), 0, 1e-6F); // right, up, forward
  EXPECT_NEAR(glm::dot(u, camera.up), 0, 1e-6F);
  EXPECT_GT(glm::dot(v, camera.up), 0);
  EXPECT_NEAR(glm::length(w - glm::normalize(camera.look_at - camera.eye)), 0, 1e-6F);
}

TEST(CameraFrame, OrthographicRaysAreParallel) {
  Camera camera;
  camera.eye = {1, 2, 8};
  camera.look_at = {1, 2, 0};
  camera.projection = Projection::orthographic;
  camera.view_height = 4;
  const CameraFrame frame = make_camera_frame(camera, 20, 10);
  EXPECT_TRUE(frame.orthographic);
  expect_near(frame.direction, {0, 0, -1});
  expect_near(direction(frame, 0, 0), {-3, 4, 8});
  expect_near(direction(frame, 20, 10), {5, 0, 8});
  camera.window = Window{-1, 2, -3, 5};
  const CameraFrame window = make_camera_frame(camera, 4, 9);
  expect_near(direction(window, 0.5F, 0.5F), {0, 7, 8});
  expect_near(direction(window, 3.5F, 8.5F), {3, -1, 8});
}

// Whatever the point of the lens, the ray of an image point meets the same point at the focus distance.
TEST(CameraFrame, TheLensIsSharpAtItsFocusDistance) {
  Camera camera;
  camera.eye = {0, 0, 0};
  camera.look_at = {0, 0, -4};
  camera.aperture_radius = 0.25F;
  for (const float focus : {0.0F, 4.0F, 7.0F}) {
    camera.focus_distance = focus;
    const CameraFrame frame = make_camera_frame(camera, 16, 16);
    EXPECT_TRUE(frame.has_lens);
    const float distance = focus == 0 ? 4 : focus;
    const Vec3 sharp = distance * direction(frame, 3, 5);
    for (const Vec2 lens : {Vec2(1, 0), Vec2(0, -1), Vec2(0.6F, 0.5F)}) {
      const Vec3 beside = lens.x * frame.lens_u + lens.y * frame.lens_v;
      EXPECT_NEAR(glm::length(beside), 0.25F * glm::length(lens), 1e-6F);
      const Vec3 ray = direction(frame, 3, 5) - (lens.x * frame.shift_u + lens.y * frame.shift_v);
      EXPECT_NEAR(glm::length(frame.eye + beside + distance * ray - sharp), 0, 1e-6F);
    }
  }
}

TEST(CameraFrame, WhatMakesNoSenseIsRefused) {
  const auto refused = [](auto change) {
    Camera camera;
    change(camera);
    EXPECT_THROW(make_camera_frame(camera, 8, 8), InputError);
  };
  refused([](Camera& c) { c.window = Window{1, 1, 0, 1}; });
  refused([](Camera& c) { c.window = Window{0, 1, 0, std::numeric_limits<float>::infinity()}; });
  refused([](Camera& c) { c.window = Window{}, c.focal_distance = 0; });
  refused([](Camera& c) { c.projection = Projection::orthographic, c.view_height = 0; });
  refused([](Camera& c) { c.projection = Projection::orthographic, c.aperture_radius = 1; });
  refused([](Camera& c) { c.aperture_radius = -1; });
  refused([](Camera& c) { c.aperture_radius = 1, c.focus_distance = -2; });
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
