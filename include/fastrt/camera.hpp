// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>

#include <optional>

namespace fastrt {

// perspective: all rays start at the eye, or on the lens around it. orthographic: they are parallel and start
// on the plane through the eye that is square to the view.
enum class Projection { perspective, orthographic };

// A rectangle of the view plane, in units of length along u and v; `left` may be greater than `right`.
struct Window {
  float left = -1, right = 1, bottom = -1, top = 1;
};

// Where the picture is taken from, what it looks at and which way is up, all in world space; then what it
// shows: a vertical field of view in degrees, or of an orthographic camera a height, or a window of the view
// plane.
struct Camera {
  Vec3 eye{0.0F, 0.0F, 5.0F};
  Vec3 look_at{0.0F};
  Vec3 up{0.0F, 1.0F, 0.0F};
  float fov_degrees = 40.0F;

  Projection projection = Projection::perspective;
  float view_height = 2; // of orthographic cameras: what the picture shows from bottom to top, > 0

  // The lecture's window: the ray of pixel (i, j) goes through left + i * (right - left) / (width - 1) along
  // u and top + j * (bottom - top) / (height - 1) along v, so the outer pixels' own points lie on its edges.
  // It takes the place of the field of view or of the height. A side of one pixel shows `left` or `top`.
  std::optional<Window> window = std::nullopt;
  float focal_distance = 1; // of the window's plane from the eye, > 0; orthographic cameras have none

  // A thin lens of this radius around the eye: what is at the focus distance (along w) is sharp. 0: a
  // pinhole. Perspective only. Pictures of one sample a pixel are those of the pinhole.
  float aperture_radius = 0;
  float focus_distance = 0; // 0: that of look_at
};

// Orthonormal: u to the right, v up, w along the view.
struct CameraAxes {
  Vec3 u, v, w;
};
// Throws InputError where eye, look_at and up give no axes.
CameraAxes camera_axes(const Camera& camera);

// The camera made ready for one resolution. The ray through image point (px, py), in pixels from the upper
// left corner with pixel centres at .5, starts at `eye` and has the direction (corner + px * du) + py * dv;
// it is not normalised: at t = 1 it crosses the plane at distance 1 from the eye. Orthographic: it starts at
// (corner + px * du) + py * dv and has the direction `direction`. Through the point (a, b) of a lens, a disk
// of radius 1, it starts a * lens_u + b * lens_v beside the eye, and its direction is less by a * shift_u + b
// * shift_v.
struct CameraFrame {
  Vec3 eye, corner, du, dv;
  bool orthographic = false, has_lens = false;
  Vec3 direction{0.0F};
  Vec3 lens_u{0.0F}, lens_v{0.0F}, shift_u{0.0F}, shift_v{0.0F};
};

// Throws InputError for a degenerate camera: eye equal to look_at, up along the view, a field of view outside
// (0, 180), a window without an area, or numbers that are not finite or not positive where they must be.
// width and height are at least 1.
CameraFrame make_camera_frame(const Camera& camera, int width, int height);

// What textures are averaged over: the side of the part of a surface that one of a pixel's samples stands
// for, where the ray starts, and what it grows by per unit of distance.
struct Footprint {
  float width, spread;
};
Footprint camera_footprint(const CameraFrame& camera, int samples_per_pixel);

} // namespace fastrt
