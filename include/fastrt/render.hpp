// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/aov.hpp>
#include <fastrt/camera.hpp>
#include <fastrt/column.hpp>
#include <fastrt/tracer.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace fastrt {

// How the samples of a pixel are spread and weighed: over the pixel's own square; as a tent two pixels wide;
// as a bell (deviation 0.5 pixels, cut off at 1.5); or as Mitchell & Netravali's with B = C = 1/3, which
// sharpens.
enum class PixelFilter { box, tent, gaussian, mitchell };

// Columns x0 .. x1 - 1 and rows y0 .. y1 - 1 of a picture.
struct Crop {
  int x0, y0, x1, y1;
};

struct RenderSettings {
  int width = 1024; // 1..65536
  int height = 768; // 1..65536
  // Makes this part of the picture alone: the frame has its size, and each pixel is the whole picture's.
  std::optional<Crop> crop = std::nullopt;
  int samples_per_pixel = 1;              // 1 is the pixel's centre
  PixelFilter filter = PixelFilter::tent; // of 2 samples and more
  std::uint32_t seed = 0;
  // Above 0: samples_per_pixel is what each pixel gets, and those that differ from a neighbour by more than
  // this (the square root of a channel, cut off at 1) get as many again, and again, up to most_samples.
  float adaptive = 0;
  int most_samples = 0;                // 0: 16 times samples_per_pixel
  int light_samples = 16;              // shadow rays to each light with a size, 1..1024
  int max_depth = 8;                   // bounces after the camera ray; 0 traces none
  float min_contribution = 1.0F / 256; // a ray whose largest weight is below this is not traced
  std::vector<Aov> aovs; // which to record; with several samples this takes one ray more a pixel
  int threads = 0;       // 0 takes every core
  // Both may be null. `cancelled` is read between tiles; `progress` gets the share of tiles done, 0..1, from
  // one thread at a time.
  const std::atomic<bool>* cancelled = nullptr;
  std::function<void(double)> progress;
};

struct RayCounts {
  std::uint64_t primary = 0, shadow = 0, reflected = 0, refracted = 0;
  std::uint64_t total() const noexcept { return primary + shadow + reflected + refracted; }
};

// A finished picture, or the part of it that was asked for: linear RGB, three floats a pixel, rows from the
// top; and the primitive that the first sample of each pixel sees (no_primitive where it sees the
// background).
struct Frame {
  int width = 0, height = 0;
  Column<float> rgb;
  Column<std::int32_t> primitive;
  std::vector<std::int32_t> samples; // that each pixel got; empty unless sampling was adaptive
  std::vector<AovPlane> aovs;        // those that were asked for, each once
  RayCounts rays;
  bool complete = true; // false when the rendering was cancelled: tiles not done are black
  // Null if it was not asked for.
  const AovPlane* find(Aov aov) const noexcept;
};

// Renders with the tracer's kernels. The picture depends on the scene, the camera and the settings alone: not
// on the ISA and not on the number of threads.
Frame render(const Tracer& tracer, const Camera& camera, const RenderSettings& settings);

// The same picture by the naive scalar path: every primitive tested for every ray, no tree, no SIMD. For
// checking.
Frame render_reference(const Scene& scene, const Camera& camera, const RenderSettings& settings);

// What differs between two frames of one size.
struct FrameDifference {
  std::size_t pixels = 0;     // pixels with a channel that differs in its bits
  std::size_t primitives = 0; // pixels that see another primitive
  double largest = 0;         // the largest difference of a channel
  std::size_t aovs = 0;       // pixels with an AOV that differs
  bool equal() const noexcept { return pixels == 0 && primitives == 0 && aovs == 0; }
};
FrameDifference compare(const Frame& a, const Frame& b);

} // namespace fastrt
