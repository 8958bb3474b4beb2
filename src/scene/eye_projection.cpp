// SPDX-License-Identifier: Apache-2.0
#include "src/scene/eye_projection.hpp"

#include <fastrt/error.hpp>

#include <cmath>

namespace fastrt {

// The rows of the inverse of the matrix (du, dv, third column), by Cramer's rule.
EyeProjection make_eye_projection(const CameraFrame& camera) {
  if (camera.has_lens) throw UsageError("the forward integrator has no lens: it needs a pinhole");
  const glm::dvec3 du(camera.du), dv(camera.dv);
  const glm::dvec3 third(camera.orthographic ? camera.direction : camera.corner);
  const double determinant = glm::dot(glm::cross(du, dv), third);
  EyeProjection eye{};
  eye.origin = camera.orthographic ? camera.corner : camera.eye;
  eye.direction = camera.direction;
  eye.orthographic = camera.orthographic;
  if (determinant == 0.0) return eye; // pixels without an area
  eye.u = glm::cross(dv, third) / determinant;
  eye.v = glm::cross(third, du) / determinant;
  eye.w = glm::cross(du, dv) / determinant;
  eye.inverse_area = static_cast<float>(1.0 / std::fabs(determinant));
  return eye;
}

} // namespace fastrt
