// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/aov.hpp>
#include <fastrt/camera.hpp>
#include <fastrt/column.hpp>
#include <fastrt/picture.hpp>
#include <fastrt/tracer.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace fastrt {

// whitted: rays from the eye, back to the lights. forward: photons from the lights, which bounce, bend and
// scatter, and whose light is collected on the image plane wherever they meet a surface that is not all
// mirror or glass; what such a surface shows of the rest is not seen. Needs a pinhole or parallel rays.
enum class Integrator { whitted, forward };

// What a frame keeps of a pixel. linear: its colour and its primitive, 16 bytes. srgb8: the 8-bit codes of
// the colour, as png, ppm, jpg and tif hold them: 3 bytes. The linear values are then never kept, but for
// AOVs, adaptive samples, the forward integrator and Isa::scalar: those make a linear frame first.
enum class PixelFormat { linear, srgb8 };

// Columns x0 .. x1 - 1 and rows y0 .. y1 - 1 of a picture, counted from its upper left corner. At least one
// of each, and none outside of the picture.
struct Crop {
  int x0, y0, x1, y1;
};

struct RenderSettings {
  int width = 1024; // 1..65536
  int height = 768; // 1..65536
  // Makes this part of the picture alone: the frame has its size, and each pixel is the whole picture's.
  std::optional<Crop> crop = std::nullopt;
  int samples_per_pixel = 1;              // at least 1, which is the pixel's centre
  PixelFilter filter = PixelFilter::tent; // of 2 samples and more
  std::uint32_t seed = 0;
  // Above 0: samples_per_pixel is what each pixel gets, and those that differ from a neighbour by more than
  // this (the square root of a channel, cut off at 1) get as many again, and again, up to most_samples. 0..1.
  float adaptive = 0;
  int most_samples = 0;                // at least samples_per_pixel; 0: 16 times that
  int light_samples = 16;              // shadow rays to each light with a size, 1..1024
  int max_depth = 8;                   // bounces after the camera ray, 0..64; 0 traces none
  float min_contribution = 1.0F / 256; // a ray whose largest weight is below this is not traced; 0..1
  Integrator integrator = Integrator::whitted;
  std::int64_t photons = 1000000; // of the forward integrator, of all lights together, 1..2^30
  // Above 0: so many photons go through mirrors and glass before the picture is made, and the surfaces that
  // they meet show their light. Bodies that bend light then throw whole shadows: photons carry what they let
  // through. whitted alone, at most 10^8.
  std::int64_t caustic_photons = 0;
  float caustic_radius = 0; // over which they are averaged, in the scene's unit; 0: chosen by their density
  PixelFormat pixel_format = PixelFormat::linear;
  std::vector<Aov> aovs; // which to record; with several samples this takes one ray more a pixel
  int threads = 0;       // 0: every core, or as many as OMP_NUM_THREADS says; at most four a core
  // Both may be null. `cancelled` is read between tiles and photons; `progress` gets the share of them that
  // is done, 0..1, from one thread at a time.
  const std::atomic<bool>* cancelled = nullptr;
  std::function<void(double)> progress;
};

// How many rays were traced, by what they are for. Of photons: each that leaves a light is primary, each way
// from a surface to the eye is a shadow ray, and what bounces off or scatters is reflected.
struct RayCounts {
  std::uint64_t primary = 0, shadow = 0, reflected = 0, refracted = 0;
  std::uint64_t total() const noexcept { return primary + shadow + reflected + refracted; }
  RayCounts& operator+=(const RayCounts& other) noexcept {
    primary += other.primary, shadow += other.shadow;
    reflected += other.reflected, refracted += other.refracted;
    return *this;
  }
};

// What it took to find the hits of the rays that RayCounts counts, photons included. A node's eight boxes
// count eight for a ray on its own and for up to 256 rays that meet them together; primitives count once for
// each ray that was held against one (where that happens to four or eight at once, for all of these).
struct TestCounts {
  std::uint64_t boxes = 0, primitives = 0;
};
struct RayTests {
  TestCounts primary, shadow, secondary; // secondary: reflected and refracted
};

// A finished picture, or the part of it that was asked for: linear RGB, three floats a pixel, rows from the
// top; and the primitive that the first sample of each pixel sees (no_primitive where it sees the
// background).
struct Frame {
  int width = 0, height = 0;
  int x = 0, y = 0;                      // where a crop's first pixel lies in the whole picture
  int whole_width = 0, whole_height = 0; // of that picture; 0 where the frame is all there is
  Column<float> rgb;
  Column<std::int32_t> primitive;
  // With PixelFormat::srgb8, which leaves both of these empty: three codes a pixel, what encode_image makes
  // of rgb.
  Column<unsigned char> srgb8;
  Column<std::int32_t> samples; // that each pixel got; empty unless sampling was adaptive
  std::vector<AovPlane> aovs;   // those that were asked for, each once
  RayCounts rays;
  RayTests tests;       // of kernels; Isa::scalar and the reference count none
  bool complete = true; // false when the rendering was cancelled: tiles not done are black
  // The plane of an AOV; null if it was not asked for.
  const AovPlane* find(Aov aov) const noexcept;
};

// Renders with the tracer's kernels. The picture depends on the scene, the camera and the settings alone: not
// on the ISA and not on the number of threads. Throws UsageError for settings out of their ranges, InputError
// for a degenerate camera, and what `progress` throws.
Frame render(const Tracer& tracer, const Camera& camera, const RenderSettings& settings);

// The same picture by the naive scalar path: every primitive tested for every ray, no tree, no SIMD. For
// checking. Throws as render does.
Frame render_reference(const Scene& scene, const Camera& camera, const RenderSettings& settings);

// What differs between two frames of one size and pixel format. compare throws UsageError for others.
struct FrameDifference {
  std::size_t pixels = 0;     // pixels with a channel that differs in its bits
  std::size_t primitives = 0; // pixels that see another primitive
  double largest = 0;         // the largest difference of a channel; of codes, by 255
  std::size_t aovs = 0;       // pixels with an AOV that differs
  bool equal() const noexcept { return pixels == 0 && primitives == 0 && aovs == 0; }
};
FrameDifference compare(const Frame& a, const Frame& b);

} // namespace fastrt
