// SPDX-License-Identifier: Apache-2.0
#include "src/cli/run.hpp"

#include "src/cli/option_warnings.hpp"
#include "src/cli/output_files.hpp"
#include "src/cli/progress.hpp"
#include "src/cli/report.hpp"
#include "src/cli/save.hpp"
#include "src/cli/scene_defaults.hpp"
#include "src/cli/signals.hpp"
#include "src/cli/stats.hpp"
#include "src/scene/threads.hpp"

#include <fastrt/fastrt.hpp>

#include <omp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace fastrt::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void warn(const Options& options, const std::string& message) {
  if (!options.quiet) print_warning(message);
}

void warn(const Options& options, const std::vector<std::string>& messages) {
  for (const std::string& message : messages) warn(options, message);
}

Isa choose_isa(const Options& options) {
  if (options.isa) return select_isa(*options.isa);
  const char* environment = std::getenv("FASTRT_ISA");
  return select_isa(environment == nullptr ? "auto" : environment);
}

int choose_threads(const Options& options) {
  const int threads = thread_count(options.threads);
  if (options.threads > threads) {
    warn(options, "--threads: " + std::to_string(options.threads) + " are too many for this machine, " +
                      std::to_string(threads) + " taken");
  }
  return threads;
}

// Codes alone, unless more is asked of a pixel: to be compared, or written as linear values, or to go on
// with; or it is made one by one (`scalar`).
PixelFormat choose_pixel_format(const Options& options, const fs::path& output, Isa isa) {
  const bool is_8bit = output.empty() || is_8bit_format(format_of(output));
  const bool needs_more = options.verify || options.adaptive > 0 || !aovs_to_render(options).empty() ||
                          options.integrator == Integrator::forward || isa == Isa::scalar;
  return is_8bit && !needs_more ? PixelFormat::srgb8 : PixelFormat::linear;
}

// What rendering keeps of a pixel: its codes; or its colour and primitive id, AOVs, and twice all of it if
// there are two renderings.
std::uint64_t bytes_per_pixel(const Options& options, PixelFormat format) {
  if (format == PixelFormat::srgb8) return 3;
  std::uint64_t values = 4;
  if (options.adaptive > 0) values += 11;                     // sums, counts, what the eye sees
  if (options.integrator == Integrator::forward) values += 6; // sums of 64 bits
  for (const Aov aov : aovs_to_render(options)) values += static_cast<std::uint64_t>(aov_info(aov).channels);
  return values * sizeof(float) * (options.verify ? 2 : 1);
}

void check_image_size(const Options& options, PixelFormat format) {
  const std::uint64_t pixel_bytes = bytes_per_pixel(options, format);
  const auto [width, height] = frame_size(options);
  const std::uint64_t bytes =
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * pixel_bytes;
  if (bytes > static_cast<std::uint64_t>(options.max_image_mb) << 20U) {
    throw LimitError("a picture of " + std::to_string(width) + "x" + std::to_string(height) + " takes " +
                     std::to_string((bytes + (1U << 20U) - 1) >> 20U) + " MB, more than --max-image-mb " +
                     std::to_string(options.max_image_mb));
  }
}

RenderSettings render_settings(const Options& options, PixelFormat format, int threads) {
  RenderSettings settings;
  settings.pixel_format = format;
  settings.width = options.width;
  settings.height = options.height;
  settings.samples_per_pixel = options.samples_per_pixel;
  settings.filter = options.filter;
  settings.crop = options.crop;
  settings.seed = options.seed;
  settings.adaptive = options.adaptive;
  settings.most_samples = options.most_samples;
  settings.light_samples = options.light_samples;
  settings.integrator = options.integrator;
  settings.photons = options.photons.value_or(settings.photons);
  settings.caustic_photons = options.caustic_photons;
  settings.caustic_radius = options.caustic_radius.value_or(0.0F);
  settings.max_depth = options.max_depth;
  settings.min_contribution = options.min_contribution;
  settings.aovs = aovs_to_render(options);
  settings.threads = threads;
  settings.cancelled = &cancelled();
  return settings;
}

// A rendering that shows how far it is, and ends the program if a signal cut it short.
template <class Render>
Frame watched(const Options& options, const char* label, RenderSettings settings, Render render_with) {
  ProgressBar bar(options.show_progress && !options.quiet, label);
  settings.progress = [&](double done) {
    note_progress(done);
    bar.update(done);
  };
  Frame frame = render_with(settings);
  if (!frame.complete) end_by_signal();
  return frame;
}

// to_stderr: when the picture itself goes to stdout.
void report(const Options& options, const RunStats& stats, bool to_stderr) {
  if (options.stats == StatsFormat::text) std::fputs(stats_text(stats).c_str(), stderr);
  std::string text;
  if (options.stats == StatsFormat::json) {
    text = stats_json(stats);
  } else if (!options.quiet) {
    text = verify_text(stats) + summary_line(stats);
  }
  if (to_stderr) {
    std::fputs(text.c_str(), stderr);
  } else {
    print_out(text);
  }
}

void describe(const Options& options, const Tracer& tracer, const Frame& frame, RunStats& stats) {
  stats.scene = options.scene;
  stats.width = frame.width;
  stats.height = frame.height;
  stats.samples_per_pixel = options.samples_per_pixel;
  if (!frame.samples.empty()) {
    stats.most_samples = *std::max_element(frame.samples.begin(), frame.samples.end());
    stats.mean_samples = std::accumulate(frame.samples.begin(), frame.samples.end(), 0.0) /
                         static_cast<double>(frame.samples.size());
  }
  stats.aovs = frame.aovs.size();
  stats.isa = tracer.isa();
  stats.triangles = tracer.scene().triangle_count();
  stats.spheres = tracer.scene().sphere_count();
  stats.shapes = tracer.scene().primitive_count() - tracer.scene().first_of(PrimitiveKind::cone);
  stats.instances = tracer.scene().instance_count();
  stats.lights = tracer.scene().lights().size();
  stats.rays = frame.rays;
  stats.tests = frame.tests;
  stats.bvh = tracer.bvh_stats();
  stats.scene_bytes = tracer.scene().bytes();
}

SceneDesc read_scene(const Options& options, int threads) {
  LoadOptions load;
  load.threads = threads;
  load.strict = options.strict;
  load.allow_external_files = options.allow_external_files;
  load.tr_is_opacity = options.tr_is_opacity;
  load.sidecar = options.sidecar;
  std::error_code error;
  if (fs::is_directory(options.scene, error)) {
    throw InputError("cannot read '" + options.scene + "': it is a folder");
  }
  const fs::path sidecar = options.sidecar ? find_sidecar(options.scene) : fs::path();
  if (!sidecar.empty() && !options.quiet)
    print_note("'" + sidecar.string() + "' beside the scene is used too (--no-sidecar: it is not)");
  Diagnostics diagnostics;
  SceneDesc desc = load_scene(options.scene, load, diagnostics);
  warn(options, diagnostics.lines());
  return desc;
}

// Whether the picture goes where print_out() goes.
bool is_standard_output(const fs::path& output) {
  struct stat picture {};
  struct stat stream {};
  return !output.empty() && stat(output.c_str(), &picture) == 0 && fstat(STDOUT_FILENO, &stream) == 0 &&
         !S_ISCHR(stream.st_mode) && picture.st_dev == stream.st_dev && picture.st_ino == stream.st_ino;
}

} // namespace

int run(const Options& given, Clock::time_point start) {
  Options options = given;
  warn(options, options.warnings);
  RunStats stats;
  TracerSettings tracer_settings;
  tracer_settings.quality = stats.bvh_quality = options.bvh_quality;
  tracer_settings.isa = choose_isa(options);
  tracer_settings.culling = options.culling;
  tracer_settings.threads = stats.threads = choose_threads(options);
  const OutputFiles files = choose_output_files(options);
  const fs::path& output = files.picture;
  check_image_size(options, choose_pixel_format(options, output, tracer_settings.isa));

  Clock::time_point phase_start = Clock::now();
  SceneDesc desc = read_scene(options, stats.threads);
  const Aabb bounds = bounds_of(desc);
  take_picture_settings(desc, options);
  warn(options, sampling_warnings(options));
  const PixelFormat pixel_format = choose_pixel_format(options, output, tracer_settings.isa);
  check_image_size(options, pixel_format);
  check_crop(options);
  check_output_sizes(files, options);
  const Camera camera = choose_camera(options, bounds, desc);
  warn(options, camera_warnings(options, camera));
  light_scene(options, bounds, camera, desc);
  stats.read_seconds = seconds_since(phase_start);

  phase_start = Clock::now();
  const Tracer tracer(checked_scene(options, std::move(desc)), tracer_settings);
  warn(options, caustic_warnings(options, tracer.scene()));
  stats.build_seconds = seconds_since(phase_start);

  const RenderSettings settings = render_settings(options, pixel_format, stats.threads);
  enter_phase(Phase::rendering);
  phase_start = Clock::now();
  const Frame frame = watched(options, "rendering", settings,
                              [&](const RenderSettings& with) { return render(tracer, camera, with); });
  stats.render_seconds = seconds_since(phase_start);
  describe(options, tracer, frame, stats);

  if (options.verify) {
    phase_start = Clock::now();
    const Frame expected = watched(options, "verifying", settings, [&](const RenderSettings& with) {
      return render_reference(tracer.scene(), camera, with);
    });
    stats.verify = compare(frame, expected);
    stats.verify_seconds = seconds_since(phase_start);
  }
  enter_phase(Phase::idle);

  phase_start = Clock::now();
  save_extra_files(files, frame, stats.threads);
  if (!output.empty() && signal_received() == 0) {
    save_picture(files, frame, tracer.scene().desc().object_names, stats.threads);
    stats.output = output.string();
  }
  stats.write_seconds = seconds_since(phase_start);
  if (signal_received() != 0) {
    print_error(stats.output.empty() ? std::string("interrupted; no picture is written")
                                     : "interrupted after '" + stats.output + "' was written");
    return 128 + signal_received();
  }

  stats.peak_rss_bytes = peak_rss_bytes();
  stats.total_seconds = seconds_since(start);
  report(options, stats, is_standard_output(output));
  if (!stats.verify || stats.verify->equal()) return exit_done;
  print_error("the kernels and the plain scalar code make different pictures");
  return exit_differs;
}

} // namespace fastrt::cli
