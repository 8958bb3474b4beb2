// SPDX-License-Identifier: Apache-2.0
#include "src/scene/camera_check.hpp"

#include <fastrt/camera.hpp>
#include <fastrt/error.hpp>

#include <cmath>
#include <numbers>

namespace fastrt {

namespace {

using Vec3d = glm::dvec3;

// The sine of the angle between the view and `up` below which rounding decides where the right hand is.
constexpr double least_sine = 1e-6;

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

[[noreturn]] void refuse(const char* why) { throw InputError(std::string("degenerate camera: ") + why); }

} // namespace

void check_field_of_view(float fov_degrees) {
  if (!(fov_degrees > 0.0F && fov_degrees < 180.0F))
    refuse("the field of view must be greater than 0 and less than 180 degrees");
}

CameraFrame make_camera_frame(const Camera& camera, int width, int height) {
  FASTRT_ASSERT_LE(1, width);
  FASTRT_ASSERT_LE(1, height);
  check_field_of_view(camera.fov_degrees);
  if (!is_finite(camera.eye) || !is_finite(camera.look_at) || !is_finite(camera.up))
    refuse("eye, look-at point and up vector must be finite");
  if (camera.eye == camera.look_at) refuse("eye and look-at point are the same");
  if (camera.up == Vec3(0.0F)) refuse("the up vector is 0");

  const Vec3d forward = glm::normalize(Vec3d(camera.look_at) - Vec3d(camera.eye));
  const Vec3d side = glm::cross(forward, glm::normalize(Vec3d(camera.up)));
  const double sine = glm::length(side);
  if (!(sine > least_sine)) refuse("the up vector points along the view");
  const Vec3d right = side / sine;
  const Vec3d up = glm::cross(right, forward);

  const double half_height = std::tan(static_cast<double>(camera.fov_degrees) * std::numbers::pi / 360.0);
  const double pixel = 2.0 * half_height / height;
  CameraFrame frame{};
  frame.eye = camera.eye;
  frame.corner = Vec3(forward - (0.5 * pixel * width) * right + half_height * up);
  frame.du = Vec3(pixel * right);
  frame.dv = Vec3(-pixel * up);
  return frame;
}

float footprint_spread(const CameraFrame& camera, int samples_per_pixel) {
  return glm::length(camera.du) / std::sqrt(static_cast<float>(samples_per_pixel));
}

} // namespace fastrt
