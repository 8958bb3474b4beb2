// SPDX-License-Identifier: Apache-2.0
// A view and lights for a scene that brings none.
#include "src/scene/camera_check.hpp"

#include <fastrt/camera.hpp>
#include <fastrt/error.hpp>
#include <fastrt/load.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fastrt {

namespace {

using Vec3d = glm::dvec3;

// Where the eye stands when up is +y: to the right, above, in front.
constexpr Vec3d view_side{0.55, 0.42, 1.0};
// What the scene fills of the view's half width or height.
constexpr double filled = 0.96;

struct Axes {
  Vec3d right, up, forward;
};

// Turns v by the smallest rotation that takes +y to `up`, a unit vector.
Vec3d turn_y_to(const Vec3d& up, const Vec3d& v) {
  if (up.y < -0.999999) return {-v.x, -v.y, v.z};
  const Vec3d axis{up.z, 0.0, -up.x};
  const Vec3d across = glm::cross(axis, v);
  return v + across + glm::cross(axis, across) / (1.0 + up.y);
}

Axes axes_of(const Vec3d& forward, const Vec3d& up) {
  const Vec3d right = glm::normalize(glm::cross(forward, up));
  return {right, glm::cross(right, forward), forward};
}

// Half the box; a box that is a single point gets a size that fits its coordinates.
Vec3d half_extent(const Aabb& bounds, const Vec3d& center) {
  const Vec3d half = 0.5 * (Vec3d(bounds.upper) - Vec3d(bounds.lower));
  if (half != Vec3d(0.0)) return half;
  const double largest = std::max({std::fabs(center.x), std::fabs(center.y), std::fabs(center.z)});
  return Vec3d(largest > 0.0 ? 1e-3 * largest : 1.0);
}

void check_aspect(float aspect) {
  if (!(aspect > 0.0F && std::isfinite(aspect))) throw InputError("the aspect must be greater than 0");
}

// For one image axis: the points (x, z), z along the view, fit into |x - shift| <= slope * (distance + z).
struct Fit {
  double slope;
  double upper = -std::numeric_limits<double>::infinity(); // max of x - slope * z
  double lower = std::numeric_limits<double>::infinity();  // min of x + slope * z
  void add(double x, double z) {
    upper = std::max(upper, x - slope * z);
    lower = std::min(lower, x + slope * z);
  }
  double distance() const { return (upper - lower) / (2.0 * slope); }
  double shift() const { return 0.5 * (upper + lower); }
};

} // namespace

Camera frame_scene(const Aabb& bounds, float fov_degrees, float aspect, const Vec3& up) {
  check_field_of_view(fov_degrees);
  check_aspect(aspect);
  const double up_length = glm::length(Vec3d(up));
  if (!(up_length > 0.0 && std::isfinite(up_length)))
    throw InputError("degenerate camera: the up vector must be finite and not 0");
  Camera camera;
  camera.up = up;
  camera.fov_degrees = fov_degrees;
  if (bounds.empty()) return camera;

  const Vec3d unit_up = Vec3d(up) / up_length;
  const Axes axes = axes_of(-turn_y_to(unit_up, glm::normalize(view_side)), unit_up);
  const Vec3d center = 0.5 * Vec3d(bounds.lower) + 0.5 * Vec3d(bounds.upper);
  const Vec3d half = half_extent(bounds, center);
  const double slope = filled * std::tan(static_cast<double>(fov_degrees) * std::numbers::pi / 360.0);
  Fit horizontal{slope * static_cast<double>(aspect)}, vertical{slope};
  double nearest = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3d p{(corner & 1U) != 0 ? half.x : -half.x, (corner & 2U) != 0 ? half.y : -half.y,
                  (corner & 4U) != 0 ? half.z : -half.z};
    const double depth = glm::dot(p, axes.forward);
    horizontal.add(glm::dot(p, axes.right), depth);
    vertical.add(glm::dot(p, axes.up), depth);
    nearest = std::min(nearest, depth);
  }
  // A very wide view would end up touching the box.
  const double distance =
      std::max({horizontal.distance(), vertical.distance(), 0.01 * glm::length(half) - nearest});
  const Vec3d target = center + horizontal.shift() * axes.right + vertical.shift() * axes.up;
  camera.look_at = Vec3(target);
  camera.eye = Vec3(target - distance * axes.forward);
  return camera;
}

float orthographic_height(const Aabb& bounds, const Camera& camera, float aspect) {
  check_aspect(aspect);
  const CameraAxes axes = camera_axes(camera);
  if (bounds.empty()) return Camera{}.view_height;
  double half = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3d p{(corner & 1U) != 0 ? bounds.upper.x : bounds.lower.x,
                  (corner & 2U) != 0 ? bounds.upper.y : bounds.lower.y,
                  (corner & 4U) != 0 ? bounds.upper.z : bounds.lower.z};
    const Vec3d from_eye = p - Vec3d(camera.eye);
    half = std::max({half, std::fabs(glm::dot(from_eye, Vec3d(axes.v))),
                     std::fabs(glm::dot(from_eye, Vec3d(axes.u))) / static_cast<double>(aspect)});
  }
  return half > 0.0 ? static_cast<float>(2.0 * half / filled) : Camera{}.view_height;
}

void add_default_lights(SceneDesc& desc, const Aabb& bounds, const Camera& camera) {
  // The frame's vectors are the camera's axes, whatever the resolution; this throws for a degenerate camera.
  Camera pinhole;
  pinhole.eye = camera.eye;
  pinhole.look_at = camera.look_at;
  pinhole.up = camera.up;
  pinhole.fov_degrees = camera.fov_degrees;
  const CameraFrame frame = make_camera_frame(pinhole, 2, 2);
  const Vec3 right = glm::normalize(frame.du), up = -glm::normalize(frame.dv);
  const Vec3 forward = glm::normalize(frame.corner + frame.du + frame.dv);

  // Together at most 1.1, and ambient 0.1: a surface with Kd = Ka = 0.8 stays below 1 whichever way it faces.
  Light key, fill;
  key.kind = fill.kind = LightKind::directional;
  key.direction = 0.55F * right - 0.75F * up + 0.7F * forward;
  key.intensity = Vec3(0.9F);
  fill.direction = -0.5F * right - 0.1F * up + forward;
  fill.intensity = Vec3(0.2F);
  fill.casts_shadows = false;
  const bool inside = !bounds.empty() && glm::all(glm::lessThan(bounds.lower, camera.eye)) &&
                      glm::all(glm::lessThan(camera.eye, bounds.upper));
  if (inside) { // a ceiling would keep the key light out of a room
    key.kind = LightKind::point;
    key.position = camera.eye;
  }
  desc.lights.push_back(key);
  desc.lights.push_back(fill);
  if (!desc.ambient) desc.ambient = Vec3(0.1F);
  if (!desc.background) desc.background = Vec3(0.033F, 0.036F, 0.042F);
}

} // namespace fastrt
