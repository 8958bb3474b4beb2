// SPDX-License-Identifier: Apache-2.0
#include "src/cli/run.hpp"

#include "src/cli/frame_settings.hpp"
#include "src/cli/option_warnings.hpp"
#include "src/cli/output_files.hpp"
#include "src/cli/progress.hpp"
#include "src/cli/report.hpp"
#include "src/cli/run_report.hpp"
#include "src/cli/scene_defaults.hpp"
#include "src/cli/signals.hpp"
#include "src/scene/threads.hpp"

#include <fastrt/fastrt.hpp>

#include <cstdlib>
#include <filesystem>
#include <set>
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

// How long a phase takes: from here to the end of the block.
class PhaseTimer {
public:
  explicit PhaseTimer(double& seconds) : seconds_(seconds) {}
  ~PhaseTimer() { seconds_ = seconds_since(start_); }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

private:
  double& seconds_;
  Clock::time_point start_ = Clock::now();
};

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

TracerSettings choose_engine(const Options& options) {
  TracerSettings settings;
  settings.quality = options.bvh_quality;
  settings.isa = choose_isa(options);
  settings.culling = options.culling;
  settings.threads = choose_threads(options);
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

// Throws UsageError for files that would go over what is read.
SceneDesc read_scene(const Options& options, const OutputFiles& files, int threads) {
  LoadOptions load;
  load.threads = threads;
  load.strict = options.strict;
  load.allow_external_files = options.allow_external_files;
  load.tr_is_opacity = options.tr_is_opacity;
  load.sidecar = options.sidecar;
  std::set<fs::path> scene_files;
  load.on_file = [&](const fs::path& file) { scene_files.insert(file); };
  std::error_code error;
  if (fs::is_directory(options.scene, error)) {
    throw InputError("cannot read '" + options.scene + "': it is a folder");
  }
  const fs::path sidecar = options.sidecar ? find_sidecar(options.scene) : fs::path();
  if (!sidecar.empty() && !options.quiet)
    print_note("'" + sidecar.string() + "' beside the scene is used too (--no-sidecar: it is not)");
  Diagnostics diagnostics;
  SceneDesc desc = load_scene(options.scene, load, diagnostics);
  refuse_scene_files(files, scene_files);
  warn(options, diagnostics.lines());
  return desc;
}

// Takes what the scene says of the picture; warns of options that say nothing, and throws for those that ask
// for too much.
void settle_picture(const SceneDesc& desc, const OutputFiles& files, Isa isa, Options& options) {
  take_picture_settings(desc, options);
  warn(options, sampling_warnings(options));
  check_image_size(options, files.picture, isa);
  check_crop(options);
  check_output_sizes(files, options);
}

// Gives the scene its lights; returns its camera.
Camera settle_view(const Options& options, SceneDesc& desc) {
  const Aabb bounds = bounds_of(desc);
  const Camera camera = choose_camera(options, bounds, desc);
  warn(options, camera_warnings(options, camera));
  light_scene(options, bounds, camera, desc);
  return camera;
}

Tracer build(const Options& options, SceneDesc desc, const TracerSettings& settings, RunStats& stats) {
  const PhaseTimer timer(stats.build_seconds);
  return Tracer(checked_scene(options, std::move(desc)), settings);
}

Frame render_fast(const Options& options, const Tracer& tracer, const Camera& camera,
                  const RenderSettings& settings, RunStats& stats) {
  const PhaseTimer timer(stats.render_seconds);
  return watched(options, "rendering", settings,
                 [&](const RenderSettings& with) { return render(tracer, camera, with); });
}

void verify(const Options& options, const Tracer& tracer, const Camera& camera,
            const RenderSettings& settings, const Frame& frame, RunStats& stats) {
  const PhaseTimer timer(stats.verify_seconds);
  const Frame expected = watched(options, "verifying", settings, [&](const RenderSettings& with) {
    return render_reference(tracer.scene(), camera, with);
  });
  stats.verify = compare(frame, expected);
}

// A signal may come in between: then what is left is not written.
void save_files(const OutputFiles& files, const Tracer& tracer, const Frame& frame, RunStats& stats) {
  const PhaseTimer timer(stats.write_seconds);
  save_extra_files(files, frame, stats.threads);
  if (files.picture.empty() || signal_received() != 0) return;
  save_picture(files, frame, tracer.scene().desc().object_names, stats.threads);
  stats.output = files.picture.string();
}

int end_interrupted(const RunStats& stats) {
  print_error(stats.output.empty() ? std::string("interrupted; no picture is written")
                                   : "interrupted after '" + stats.output + "' was written");
  return 128 + signal_received();
}

int verdict(const RunStats& stats) {
  if (!stats.verify || stats.verify->equal()) return exit_done;
  print_error("the kernels and the plain scalar code make different pictures");
  return exit_differs;
}

} // namespace

int run(const Options& given, Clock::time_point start) {
  Options options = given;
  warn(options, options.warnings);
  const TracerSettings engine = choose_engine(options);
  const OutputFiles files = choose_output_files(options);
  check_image_size(options, files.picture, engine.isa);

  RunStats stats;
  stats.threads = engine.threads;
  stats.bvh_quality = engine.quality;
  const Clock::time_point read_start = Clock::now();
  SceneDesc desc = read_scene(options, files, engine.threads);
  settle_picture(desc, files, engine.isa, options);
  const Camera camera = settle_view(options, desc);
  stats.read_seconds = seconds_since(read_start);
  const Tracer tracer = build(options, std::move(desc), engine, stats);
  warn(options, caustic_warnings(options, tracer.scene()));

  const RenderSettings settings = render_settings(options, files.picture, engine.isa, engine.threads);
  enter_phase(Phase::rendering);
  const Frame frame = render_fast(options, tracer, camera, settings, stats);
  describe(options, tracer, frame, stats);
  if (options.verify) verify(options, tracer, camera, settings, frame, stats);
  enter_phase(Phase::idle);

  save_files(files, tracer, frame, stats);
  if (signal_received() != 0) return end_interrupted(stats);
  stats.peak_rss_bytes = peak_rss_bytes();
  stats.total_seconds = seconds_since(start);
  report(options, stats, files.picture);
  return verdict(stats);
}

} // namespace fastrt::cli
