// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>

namespace fastrt {

// A pinhole camera: where it is, what it looks at, which way is up, and its vertical field of view in
// degrees.
struct Camera {
  Vec3 eye{0.0F, 0.0F, 5.0F};
  Vec3 look_at{0.0F};
  Vec3 up{0.0F, 1.0F, 0.0F};
  float fov_degrees = 40.0F;
};

// The camera made ready for one resolution. The ray through image point (px, py), in pixels from the upper
// left corner with pixel centres at .5, starts at `eye` and has the direction (corner + px * du) + py * dv;
// it is not normalised: at t = 1 it crosses the plane at distance 1 from the eye.
struct CameraFrame {
  Vec3 eye, corner, du, dv;
};

// Throws InputError for a degenerate camera: eye equal to look_at, up along the view, a field of view outside
// (0, 180), or numbers that are not finite. width and height are at least 1.
CameraFrame make_camera_frame(const Camera& camera, int width, int height);

// How much the part of a surface that one of a pixel's samples stands for widens per unit of distance: what
// textures are averaged over.
float footprint_spread(const CameraFrame& camera, int samples_per_pixel);

} // namespace fastrt
