// SPDX-License-Identifier: Apache-2.0
// fastrt_compare: fastrt's kernels against each other and against Embree 3, on the same rays in the same
// process.
#include <fastrt/fastrt.hpp>

#include <algorithm>
#include <fstream>

#include "bench/allocations.hpp"
#include "bench/arguments.hpp"
#include "bench/compare_options.hpp"
#include "bench/embree_scene.hpp"
#include "bench/models.hpp"
#include "bench/report.hpp"

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

// Tries every mode a few times and returns the fastest.
Contender best_mode(const EmbreeScene& scene, const char* prefix, const RaySet& set, RoundSettings settings,
                    std::size_t step, TraversalResult& result, std::string& best_name) {
  std::vector<Contender> contenders;
  for (const EmbreeMode& mode : embree_modes()) contenders.push_back(scene.contender(mode));
  settings.rounds = 3;
  const std::vector<double> rates = medians(run_rounds(contenders, set, settings, step));
  for (std::size_t i = 0; i < contenders.size(); ++i)
    result.embree_modes.emplace_back(prefix + name_of(embree_modes()[i]), 1e-6 * rates[i]);
  const std::size_t best = fastest(rates);
  best_name = name_of(embree_modes()[best]);
  return contenders[best];
}

Spread scaled(Spread spread, double factor) {
  return {spread.median * factor, spread.smallest * factor, spread.largest * factor};
}

Spread ratio_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return spread_of(ratios);
}

struct EmbreePair {
  std::unique_ptr<EmbreeScene> fast, robust;
};

// One kind of rays at one number of threads: all ISAs and Embree's best modes in turn.
TraversalResult measure_traversal(const Tracer& tracer, const EmbreePair& embree, const RaySet& set,
                                  const CompareOptions& options, int threads) {
  TraversalResult result;
  result.rays = set.name;
  result.threads = threads;
  result.ray_count = set.ray_count;
  const RoundSettings settings{threads, options.rounds, options.seconds};
  std::vector<Contender> contenders;
  for (const Isa isa : options.isas) contenders.push_back(fastrt_contender(tracer, isa));
  const std::size_t step = step_for(contenders.front(), set, settings);
  result.traced_share = 1.0 / static_cast<double>(step);
  const std::size_t count = contenders.size();
  if (embree.fast != nullptr) {
    contenders.push_back(best_mode(*embree.fast, "", set, settings, step, result, result.best_mode));
    contenders.push_back(
        best_mode(*embree.robust, "robust ", set, settings, step, result, result.best_robust_mode));
    result.with_embree = compare_answers(contenders[0], contenders[count], set);
    result.with_robust = compare_answers(contenders[0], contenders[count + 1], set);
  }
  const auto rates = run_rounds(contenders, set, settings, step);
  const auto scalar = std::find(options.isas.begin(), options.isas.end(), Isa::scalar);
  for (std::size_t i = 0; i < count; ++i) {
    FastrtRow row;
    row.isa = contenders[i].name;
    row.mrays = scaled(spread_of(rates[i]), 1e-6);
    if (embree.fast != nullptr) {
      row.ratio = ratio_of(rates[i], rates[count]);
      row.robust_ratio = ratio_of(rates[i], rates[count + 1]);
    }
    if (scalar != options.isas.end())
      row.scalar_ratio = ratio_of(rates[i], rates[static_cast<std::size_t>(scalar - options.isas.begin())]);
    result.fastrt.push_back(row);
  }
  if (embree.fast != nullptr) {
    result.embree = scaled(spread_of(rates[count]), 1e-6);
    result.embree_robust = scaled(spread_of(rates[count + 1]), 1e-6);
  }
  return result;
}

void compare_model(const std::string& argument, const CompareOptions& options, Report& report) {
  Model model = read_model(argument);
  if (options.build) {
    print_build_heading();
    for (const int threads : options.threads) {
      report.builds.push_back(measure_build(model, threads, options));
      print(report.builds.back());
    }
  }
  const Tracer tracer{Scene(std::move(model.desc))};
  View view = view_of(model, tracer.scene().bounds(), options.inside);
  if (options.eye) view.camera.eye = *options.eye;
  if (options.look_at) view.camera.look_at = *options.look_at;
  const std::vector<RaySet> sets = make_ray_sets(tracer, view, options.width, options.height, options.rays);
  const int threads = *std::max_element(options.threads.begin(), options.threads.end());
  const EmbreePair embree{
      build_embree_scene(tracer.scene(), {.threads = threads, .isa = {}}),
      build_embree_scene(tracer.scene(), {.robust = true, .threads = threads, .isa = {}})};
  for (const RaySet& set : sets) {
    if (set.ray_count == 0) continue;
    for (const int count : options.threads) {
      report.traversals.push_back(measure_traversal(tracer, embree, set, options, count));
      report.traversals.back().model = model.name;
      print(report.traversals.back());
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
