// SPDX-License-Identifier: Apache-2.0
#include "src/scene/assert.hpp"
#include "src/scene/camera_check.hpp"
#include "src/scene/finite.hpp"

#include <fastrt/camera.hpp>
#include <fastrt/error.hpp>

#include <cmath>
#include <numbers>

namespace fastrt {

namespace {

using Vec3d = glm::dvec3;

// The sine of the angle between the view and `up` below which rounding decides where the right hand is.
constexpr double least_sine = 1e-6;

[[noreturn]] void refuse(const char* why) { throw InputError(std::string("degenerate camera: ") + why); }

struct Axes {
  Vec3d u, v, w;
};

Axes axes_of(const Camera& camera) {
  if (!is_finite(camera.eye) || !is_finite(camera.look_at) || !is_finite(camera.up))
    refuse("eye, look-at point and up vector must be finite");
  if (camera.eye == camera.look_at) refuse("eye and look-at point are the same");
  if (camera.up == Vec3(0.0F)) refuse("the up vector is 0");

  const Vec3d forward = glm::normalize(Vec3d(camera.look_at) - Vec3d(camera.eye));
  const Vec3d side = glm::cross(forward, glm::normalize(Vec3d(camera.up)));
  const double sine = glm::length(side);
  if (!(sine > least_sine)) refuse("the up vector points along the view");
  const Vec3d right = side / sine;
  return {right, glm::cross(right, forward), forward};
}

bool is_positive(float x) { return x > 0.0F && std::isfinite(x); }

// What the picture shows of the view plane: its upper left corner and a pixel's width and height there, along
// u and v. dv is negative.
struct Plane {
  double left, top, du, dv;
};

// From edge to edge, `height` high; pixels are square.
Plane plane_of_height(double half_height, int width, int height) {
  const double pixel = 2.0 * half_height / height;
  return {-0.5 * pixel * width, half_height, pixel, -pixel};
}

// The window's edges are the points of the outer pixels, half a pixel inside of the picture's edges.
Plane plane_of_window(const Window& window, double scale, int width, int height) {
  const double du = width == 1 ? 0.0 : scale * (double(window.right) - double(window.left)) / (width - 1);
  const double dv = height == 1 ? 0.0 : scale * (double(window.bottom) - double(window.top)) / (height - 1);
  return {scale * double(window.left) - 0.5 * du, scale * double(window.top) - 0.5 * dv, du, dv};
}

void check_window(const Camera& camera) {
  const Window& window = *camera.window;
  if (!std::isfinite(window.left) || !std::isfinite(window.right) || !std::isfinite(window.bottom) ||
      !std::isfinite(window.top))
    refuse("the window must be finite");
  if (window.left == window.right || window.bottom == window.top) refuse("the window has no area");
  if (!is_positive(camera.focal_distance)) refuse("the focal distance must be greater than 0");
}

void add_lens(const Camera& camera, const Axes& axes, CameraFrame& frame) {
  if (camera.aperture_radius == 0.0F) return;
  if (!is_positive(camera.aperture_radius)) refuse("the aperture must not be negative");
  if (frame.orthographic) refuse("an orthographic camera has no lens");
  if (camera.focus_distance != 0.0F && !is_positive(camera.focus_distance))
    refuse("the focus distance must be greater than 0");
  const double radius = camera.aperture_radius;
  const double focus = camera.focus_distance != 0.0F ? double(camera.focus_distance)
                                                     : glm::length(Vec3d(camera.look_at) - Vec3d(camera.eye));
  frame.has_lens = true;
  frame.lens_u = Vec3(radius * axes.u);
  frame.lens_v = Vec3(radius * axes.v);
  frame.shift_u = Vec3((radius / focus) * axes.u);
  frame.shift_v = Vec3((radius / focus) * axes.v);
}

} // namespace

void check_field_of_view(float fov_degrees) {
  if (!(fov_degrees > 0.0F && fov_degrees < 180.0F))
    refuse("the field of view must be greater than 0 and less than 180 degrees");
}

CameraAxes camera_axes(const Camera& camera) {
  const Axes axes = axes_of(camera);
  return {Vec3(axes.u), Vec3(axes.v), Vec3(axes.w)};
}

CameraFrame make_camera_frame(const Camera& camera, int width, int height) {
  FASTRT_ASSERT_LE(1, width);
  FASTRT_ASSERT_LE(1, height);
  check_field_of_view(camera.fov_degrees);
  const Axes axes = axes_of(camera);
  CameraFrame frame{};
  frame.orthographic = camera.projection == Projection::orthographic;
  Plane plane{};
  if (camera.window) {
    check_window(camera);
    const double scale = frame.orthographic ? 1.0 : 1.0 / double(camera.focal_distance);
    plane = plane_of_window(*camera.window, scale, width, height);
  } else if (frame.orthographic) {
    if (!is_positive(camera.view_height)) refuse("the height of the view must be greater than 0");
    plane = plane_of_height(0.5 * double(camera.view_height), width, height);
  } else {
    const double half_height = std::tan(static_cast<double>(camera.fov_degrees) * std::numbers::pi / 360.0);
    plane = plane_of_height(half_height, width, height);
  }
  frame.eye = camera.eye;
  const Vec3d base = frame.orthographic ? Vec3d(camera.eye) : axes.w;
  frame.corner = Vec3(base + plane.left * axes.u + plane.top * axes.v);
  frame.du = Vec3(plane.du * axes.u);
  frame.dv = Vec3(plane.dv * axes.v);
  if (frame.orthographic) frame.direction = Vec3(axes.w);
  add_lens(camera, axes, frame);
  return frame;
}

Footprint camera_footprint(const CameraFrame& camera, int samples_per_pixel) {
  const float side = glm::length(camera.du) / std::sqrt(static_cast<float>(samples_per_pixel));
  return camera.orthographic ? Footprint{side, 0.0F} : Footprint{0.0F, side};
}

} // namespace fastrt
