// SPDX-License-Identifier: Apache-2.0
#include "src/cli/run_report.hpp"

#include "src/cli/report.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>

namespace fastrt::cli {
namespace {

namespace fs = std::filesystem;

// Whether the picture goes where print_out() goes.
bool is_standard_output(const fs::path& path) {
  struct stat picture {};
  struct stat stream {};
  if (path.empty() || fstat(STDOUT_FILENO, &stream) != 0 || S_ISCHR(stream.st_mode)) return false;
  if (path == "/dev/stdout") return true;
  return stat(path.c_str(), &picture) == 0 && picture.st_dev == stream.st_dev &&
         picture.st_ino == stream.st_ino;
}

} // namespace

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

void report(const Options& options, const RunStats& stats, const fs::path& picture) {
  if (options.stats == StatsFormat::text) std::fputs(stats_text(stats).c_str(), stderr);
  std::string text;
  if (options.stats == StatsFormat::json) {
    text = stats_json(stats);
  } else if (!options.quiet) {
    text = verify_text(stats) + summary_line(stats);
  }
  if (is_standard_output(picture)) {
    std::fputs(text.c_str(), stderr);
  } else {
    print_out(text);
  }
}

} // namespace fastrt::cli
