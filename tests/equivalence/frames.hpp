// SPDX-License-Identifier: Apache-2.0
// A picture to be made twice, and what equal pictures are.
#pragma once

#include "tests/equivalence/isas.hpp"

#include <fastrt/render.hpp>

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace fastrt::test {

struct Shot {
  std::string name;
  Scene scene;
  Camera camera;
  RenderSettings settings;
};

inline void PrintTo(const Shot& shot, std::ostream* out) { *out << shot.name; }

inline RenderSettings small_settings(int width, int height, int samples = 1) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples_per_pixel = samples;
  settings.threads = 2;
  return settings;
}

inline Camera looking(const Vec3& eye, const Vec3& look_at, float fov_degrees = 45) {
  Camera camera;
  camera.eye = eye;
  camera.look_at = look_at;
  camera.fov_degrees = fov_degrees;
  return camera;
}

inline Tracer make_tracer(const Scene& scene, Isa isa) {
  TracerSettings settings;
  settings.isa = isa;
  settings.threads = 1;
  return Tracer(Scene(scene), settings);
}

// Every bit, every id, every count.
inline void expect_equal(const Frame& found, const Frame& expected, const std::string& what) {
  const FrameDifference difference = compare(found, expected);
  EXPECT_EQ(difference.pixels, 0U) << what << ": largest difference " << difference.largest;
  EXPECT_EQ(difference.primitives, 0U) << what;
  EXPECT_EQ(difference.aovs, 0U) << what;
  EXPECT_EQ(found.rays.primary, expected.rays.primary) << what;
  EXPECT_EQ(found.rays.shadow, expected.rays.shadow) << what;
  EXPECT_EQ(found.rays.reflected, expected.rays.reflected) << what;
  EXPECT_EQ(found.rays.refracted, expected.rays.refracted) << what;
  EXPECT_EQ(found.samples, expected.samples) << what;
  EXPECT_TRUE(found.complete) << what;
}

// Renders with every ISA and number of threads, against `expected`.
inline void expect_every_isa_makes(const Frame& expected, const Shot& shot,
                                   std::initializer_list<int> thread_counts) {
  for (const Isa isa : available_isas()) {
    const Tracer tracer = make_tracer(shot.scene, isa);
    for (const int threads : thread_counts) {
      RenderSettings settings = shot.settings;
      settings.threads = threads;
      expect_equal(render(tracer, shot.camera, settings), expected,
                   shot.name + ", " + isa_word(isa) + ", " + std::to_string(threads) + " threads");
    }
  }
}

// How many pixels see something: a picture of nothing proves nothing.
inline std::size_t pixels_with_hits(const Frame& frame) {
  std::size_t count = 0;
  for (const std::int32_t primitive : frame.primitive) count += primitive != no_primitive ? 1U : 0U;
  return count;
}

// Twenty random pictures, make_shot(first) and so on, by every ISA; together they show enough of everything.
template <class MakeShot>
void expect_shots_to_match(const MakeShot& make_shot, std::uint32_t first) {
  std::size_t seen = 0;
  RayCounts rays;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(effort(20)); ++i) {
    const Shot shot = make_shot(first + i);
    const Frame expected = render_reference(shot.scene, shot.camera, shot.settings);
    seen += pixels_with_hits(expected);
    rays += expected.rays;
    expect_every_isa_makes(expected, shot, {1});
  }
  if (slow_build) return;
  EXPECT_GT(seen, 500U);
  EXPECT_GT(rays.shadow, 100U);
  EXPECT_GT(rays.reflected, 100U);
  EXPECT_GT(rays.refracted, 100U);
}

} // namespace fastrt::test
