// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/camera.hpp>

namespace fastrt {

// From points to the image: with q = point - origin, (dot(q, u), dot(q, v)) are the image point and z =
// dot(q, w) says how far away it is, in the camera ray's own t; of a pinhole the first two are yet to be
// divided by z. A surface of unit area that looks along `direction` (a pinhole's: that of q) and is at z = 1
// takes inverse_area pixels, per length of q.
struct EyeProjection {
  Vec3 origin, u, v, w;
  Vec3 direction; // of parallel rays
  float inverse_area;
  bool orthographic;
};

// Throws UsageError for a camera with a lens: light that comes from the scene would have to find it.
EyeProjection make_eye_projection(const CameraFrame& camera);

} // namespace fastrt
