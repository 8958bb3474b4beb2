// SPDX-License-Identifier: Apache-2.0
// fastrt_compare: fastrt's kernels against each other and against Embree 3, on the same rays in the same
// process.
#include <fastrt/fastrt.hpp>

#include <algorithm>
#include <fstream>

#include "bench/allocations.hpp"
#include "bench/arguments.hpp"
#include "bench/compare_traversal.hpp"
#include "bench/models.hpp"

namespace fastrt::bench {
namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
  return "unknown";
}

// What is held at most cannot be less than what is left: then something is not counted.
void check_peak(const char* who, std::size_t peak, std::size_t held) {
  if (peak < held)
    throw Error(std::string(who) + "'s build is said to take " + std::to_string(peak) +
                " bytes at most, but " + std::to_string(held) + " are left");
}

// How long both take to build, in turn.
BuildResult measure_build(const Model& model, int threads, const CompareOptions& options) {
  BuildResult result;
  result.model = model.name;
  result.threads = threads;
  std::vector<double> fastrt_seconds, embree_seconds, ratios;
  for (int round = 0; round < options.rounds; ++round) {
    TracerSettings settings;
    settings.threads = threads;
    Scene scene(model.desc);
    reset_peak();
    const std::size_t held = bytes_allocated();
    const Tracer tracer(std::move(scene), settings);
    result.fastrt_peak_bytes = peak_allocated() - held;
    result.primitives = tracer.scene().primitive_count();
    result.fastrt_bytes = tracer.bvh_stats().bytes;
    check_peak("fastrt", result.fastrt_peak_bytes, result.fastrt_bytes);
    fastrt_seconds.push_back(tracer.bvh_stats().build_seconds);
    const auto embree = build_embree_scene(tracer.scene(), {.threads = threads, .isa = {}});
    if (embree == nullptr) continue;
    embree_seconds.push_back(embree->build_seconds());
    result.embree_bytes = embree->bytes();
    result.embree_peak_bytes = embree->peak_bytes();
    check_peak("Embree", result.embree_peak_bytes, result.embree_bytes);
    ratios.push_back(embree_seconds.back() / fastrt_seconds.back());
  }
  result.fastrt_seconds = spread_of(fastrt_seconds);
  result.embree_seconds = spread_of(embree_seconds);
  result.ratio = spread_of(ratios);
  return result;
}

void compare_model(const std::string& argument, const CompareOptions& options, Report& report) {
  const Model model = read_model(argument);
  if (options.build) {
    print_build_heading();
    for (const int threads : options.threads) {
      report.builds.push_back(measure_build(model, threads, options));
      print(report.builds.back());
    }
  }
  const int threads = *std::max_element(options.threads.begin(), options.threads.end());
  const Course course = make_course(model.desc, options.isas, threads);
  const Tracer& tracer = course.isas.front().tracer;
  View view = view_of(model, tracer.scene().bounds(), options.inside);
  if (options.eye) view.camera.eye = *options.eye;
  if (options.look_at) view.camera.look_at = *options.look_at;
  for (const RaySet& set : make_ray_sets(tracer, view, options.width, options.height, options.rays)) {
    if (set.ray_count == 0) continue;
    for (TraversalResult& result : measure_traversal(course, set, options)) {
      result.model = model.name;
      print(result);
      report.traversals.push_back(std::move(result));
    }
  }
  std::printf("\n");
}

int run(int count, char** arguments) {
  const CompareOptions options = parse_compare_options(count, arguments);
  if (options.help || options.models.empty()) {
    std::fputs(compare_usage().c_str(), options.help ? stdout : stderr);
    return options.help ? 0 : 2;
  }
  Report report;
  report.cpu = cpu_name();
  report.embree = embree_version();
  report.fastrt = version();
  std::printf("fastrt %s, Embree %s, %s\n\n", report.fastrt.c_str(),
              report.embree.empty() ? "not installed" : report.embree.c_str(), report.cpu.c_str());
  for (const std::string& model : options.models) compare_model(model, options, report);
  if (!options.json.empty()) write_json(report, options.json);
  return 0;
}

} // namespace
} // namespace fastrt::bench

int main(int count, char** arguments) {
  return fastrt::bench::guarded_main("fastrt_compare", fastrt::bench::run, count, arguments);
}
