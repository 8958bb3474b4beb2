// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/render.hpp>
#include <fastrt/tracer.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace fastrt::cli {

// What one run did and how long it took.
struct RunStats {
  std::string scene, output; // output: empty when no file was written
  int width = 0, height = 0, samples_per_pixel = 0, threads = 0;
  int most_samples = 0; // of a pixel, where sampling was adaptive; then also
  double mean_samples = 0;
  std::size_t aovs = 0; // that were rendered
  Isa isa = Isa::scalar;
  BvhQuality bvh_quality = BvhQuality::standard;
  std::size_t triangles = 0, spheres = 0, shapes = 0, lights = 0; // shapes: other primitives
  std::size_t instances = 0;
  double read_seconds = 0, build_seconds = 0, render_seconds = 0, write_seconds = 0, total_seconds = 0;
  RayCounts rays;
  RayTests tests; // of kernels
  BvhStats bvh;
  std::size_t scene_bytes = 0, peak_rss_bytes = 0;
  std::optional<FrameDifference> verify;
  double verify_seconds = 0;

  double mrays_per_second() const;
};

// "dragon.png: 1024x768, 871414 triangles, 1 spp, 1.2 Mrays in 0.03 s (41 Mrays/s), total 0.31 s"
std::string summary_line(const RunStats& stats);

// Several lines for people.
std::string stats_text(const RunStats& stats);

// One JSON object on one line.
std::string stats_json(const RunStats& stats);

// Three lines: how many pixels and primitive ids differ, and the largest difference.
std::string verify_text(const RunStats& stats);

// The most memory that this process has held.
std::size_t peak_rss_bytes();

} // namespace fastrt::cli
