// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/cli/light_option.hpp"
#include "src/cli/parse.hpp"

#include <fastrt/camera.hpp>
#include <fastrt/math.hpp>
#include <fastrt/render.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace fastrt::cli {

enum class StatsFormat { none, text, json };

// What the command line asks for; what is not given and has no fixed default is empty.
struct Options {
  std::string scene;
  std::string output; // empty: the scene's stem and .png, here; "none": no file

  std::vector<Aov> aovs;
  std::optional<std::string> signature; // a file; empty: beside the picture

  int width = 1024, height = 768;
  std::optional<Crop> crop;
  std::int64_t max_image_mb = 1024;
  int samples_per_pixel = 1;
  PixelFilter filter = PixelFilter::tent;
  std::uint32_t seed = 0;
  float adaptive = 0; // 0: not
  int most_samples = 0;
  Integrator integrator = Integrator::whitted;
  std::optional<std::int64_t> photons; // of the forward integrator
  std::int64_t caustic_photons = 0;    // 0: no caustics
  std::optional<float> caustic_radius; // empty: by their density
  int max_depth = 8;
  float min_contribution = 1.0F / 256;

  // The options that were given, by their long names: of the others a scene file may say what they are.
  std::set<std::string> given;
  std::optional<Vec3> eye, look_at;
  Vec3 up{0.0F, 1.0F, 0.0F};
  float fov_degrees = 40.0F;
  bool orthographic = false;
  std::optional<float> view_height; // of an orthographic camera; empty: shows the whole scene
  std::optional<Window> window;
  float focal_distance = 1, aperture_radius = 0, focus_distance = 0;
  std::vector<LightOption> lights;
  int light_samples = 16;
  std::optional<Vec3> ambient, background;

  int threads = 0;                // 0: what OpenMP would take
  std::optional<std::string> isa; // empty: FASTRT_ISA, or the widest
  BvhQuality bvh_quality = BvhQuality::standard;
  bool culling = true;
  bool verify = false;
  bool strict = false;
  bool allow_external_files = false;
  bool tr_is_opacity = false;
  bool sidecar = true;

  bool quiet = false;
  bool show_progress = true;
  StatsFormat stats = StatsFormat::none;

  // The text of --help or --version: it is to be printed, and nothing else done.
  std::optional<std::string> answer;
  // What was asked for beyond what is served, and served as far as it goes.
  std::vector<std::string> warnings;
};

// The picture's, or the part of it that --crop asks for.
Resolution frame_size(const Options& options);

// Throws UsageError for a part that reaches beyond the picture. To be asked when the picture's size is
// settled, which may be the scene's.
void check_crop(const Options& options);

// What the options about photons ask for together. Throws UsageError for what excludes each other, and warns
// of what says nothing.
void check_photons_together(Options& options);

// Reads the command line. Throws UsageError for what it can't make sense of.
Options parse_options(int argc, const char* const* argv);

} // namespace fastrt::cli
