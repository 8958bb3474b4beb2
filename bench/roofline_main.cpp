// SPDX-License-Identifier: Apache-2.0
// fastrt_roofline: what a ray costs (instructions, operations, bytes) beside what this machine can do at
// most.
#include "src/trace/tracer_parts.hpp"

#include <fastrt/fastrt.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "bench/arguments.hpp"
#include "bench/embree_scene.hpp"
#include "bench/limits.hpp"
#include "bench/measure.hpp"
#include "bench/models.hpp"
#include "bench/stepping.hpp"

namespace fastrt::bench {
namespace {

const char* const usage =
    "usage: fastrt_roofline [options] MODEL...\n"
    "Counts what rays cost, one instruction at a time, and measures what the machine can do.\n"
    "MODEL: a scene file or a generated scene (balls, terrain, tree).\n"
    "  --isa NAME    of the kernels (the widest that runs here)\n"
    "  --steps N     instructions to step through per kind of rays, about (150000)\n"
    "  --threads N   for the bandwidth of several threads (2)\n"
    "  --json FILE   write all numbers\n";

struct Options {
  std::vector<std::string> models;
  Isa isa = select_isa("auto");
  std::size_t steps = 150'000;
  int threads = 2;
  std::string json;
};

// Of one thread, a second, except memory_all.
struct Limits {
  std::vector<std::pair<Isa, double>> operations;
  double instructions = 0, memory = 0, copy = 0, cache = 0, memory_all = 0;
};

struct Cost {
  std::string model, rays;
  double rate = 0;                                    // rays a second of one thread
  double instructions = 0, operations = 0, bytes = 0; // a ray
  double embree_instructions = 0;                     // a ray in Embree's fastest mode; 0 without Embree
  std::size_t sampled_rays = 0;
};

Options parse(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string name = arguments[i];
    if (!name.starts_with("-")) {
      options.models.push_back(name);
      continue;
    }
    if (i + 1 == count) throw UsageError("unknown option or missing value: " + name);
    const std::string value = arguments[++i];
    if (name == "--isa")
      options.isa = select_isa(value);
    else if (name == "--steps")
      options.steps = static_cast<std::size_t>(number(value, 1));
    else if (name == "--threads")
      options.threads = whole_number(value);
    else if (name == "--json")
      options.json = value;
    else
      throw UsageError("unknown option: " + name);
  }
  if (options.isa == Isa::scalar) throw UsageError("there are no kernels to count for scalar");
  return options;
}

Limits measure_limits(int threads) {
  constexpr std::size_t beyond_caches = std::size_t{1} << 28U, second_cache = std::size_t{1} << 18U;
  Limits limits;
  for (const Isa isa : available_isas())
    if (isa != Isa::scalar) limits.operations.emplace_back(isa, peak_operations(isa));
  limits.instructions = peak_instructions();
  limits.memory = read_bandwidth(beyond_caches, 1);
  limits.memory_all = read_bandwidth(beyond_caches, threads);
  limits.cache = read_bandwidth(second_cache, 1);
  limits.copy = copy_bandwidth();
  return limits;
}

template <class Row>
std::span<const std::byte> bytes_of(const Column<Row>& column) {
  return std::as_bytes(std::span(column.data(), column.size()));
}

// Some rays of a batch, from `first` on.
RayBatch part_of(const RayBatch& batch, int first, int count) {
  RayBatch part = batch;
  part.count = std::min(count, batch.count - first);
  const auto cut = [&](auto& to, const auto& from) { std::copy_n(&from[first], part.count, &to[0]); };
  cut(part.origin_x, batch.origin_x);
  cut(part.origin_y, batch.origin_y);
  cut(part.origin_z, batch.origin_z);
  cut(part.dir_x, batch.dir_x);
  cut(part.dir_y, batch.dir_y);
  cut(part.dir_z, batch.dir_z);
  cut(part.t_min, batch.t_min);
  cut(part.t_max, batch.t_max);
  cut(part.exclude, batch.exclude);
  return part;
}

// What is stepped through at a time: batches that go through the tree as a whole are kept whole; of others,
// whose rays cost much, a few from many places say more.
RayBatch sample_of(const RayBatch& batch) {
  constexpr int few = 64;
  const bool whole = batch.shape == BatchShape::common_origin || batch.shape == BatchShape::parallel;
  return whole || batch.count <= few ? batch : part_of(batch, (batch.count - few) / 2 / 16 * 16, few);
}

// Steps through samples, spread over the set by the golden ratio, until the steps are used up. At least four.
Work count_work(Stepper& stepper, const Contender& contender, const RaySet& set, std::size_t steps,
                std::size_t& rays) {
  const auto worker = contender.make_worker(set.question);
  const auto batches = static_cast<double>(set.batches.size());
  Work sum;
  rays = 0;
  for (std::size_t i = 0; i < set.batches.size() && (i < 4 || sum.instructions < steps); ++i) {
    const double place = static_cast<double>(i + 1) * 0.6180339887498949;
    const RayBatch sample =
        sample_of(set.batches[static_cast<std::size_t>((place - std::floor(place)) * batches)]);
    if (rays_in(sample) == 0) continue;
    worker->load(&sample, 1);
    worker->trace();          // so that what is done once only is done
    worker->load(&sample, 1); // tracing shortens Embree's rays
    const Work work = stepper.run([&] { worker->trace(); });
    sum.instructions += work.instructions;
    sum.operations += work.operations;
    sum.lines += work.lines;
    rays += static_cast<std::size_t>(rays_in(sample));
  }
  return sum;
}

Cost cost_of(Stepper& stepper, const Tracer& tracer, const EmbreeScene* embree, const RaySet& set,
             const Options& options) {
  const RoundSettings settings{1, 5, 0.03};
  const Contender fastrt = fastrt_contender(tracer, options.isa);
  const Share share = share_for(fastrt, set, settings.seconds);
  Cost cost;
  cost.rays = set.name;
  cost.rate = spread_of(run_rounds(std::span(&fastrt, 1), set, settings, share)[0]).median;
  const Work work = count_work(stepper, fastrt, set, options.steps, cost.sampled_rays);
  const auto rays = static_cast<double>(cost.sampled_rays);
  cost.instructions = static_cast<double>(work.instructions) / rays;
  cost.operations = static_cast<double>(work.operations) / rays;
  cost.bytes = static_cast<double>(work.lines * line_bytes) / rays;
  if (embree == nullptr) return cost;
  std::vector<Contender> modes;
  for (const EmbreeMode& mode : embree_modes()) modes.push_back(embree->contender(mode));
  const Contender& best = modes[fastest(medians(run_rounds(modes, set, {1, 3, 0.02}, share)))];
  std::size_t embree_rays = 0;
  const Work peer = count_work(stepper, best, set, options.steps, embree_rays);
  cost.embree_instructions = static_cast<double>(peer.instructions) / static_cast<double>(embree_rays);
  return cost;
}

void print(const Cost& c) {
  std::printf("%-16s %-18s %8.2f %10.1f %10.1f %10.1f %10.1f\n", c.model.c_str(), c.rays.c_str(),
              1e-6 * c.rate, c.instructions, c.operations, c.bytes, c.embree_instructions);
  std::fflush(stdout);
}

void print(const Limits& limits) {
  for (const auto& [isa, rate] : limits.operations)
    std::printf("%-44s %8.1f G/s\n", ("float operations, " + std::string(isa_name(isa))).c_str(),
                1e-9 * rate);
  std::printf("%-44s %8.1f G/s\n", "instructions", 1e-9 * limits.instructions);
  std::printf("%-44s %8.1f GB/s\n%-44s %8.1f GB/s\n", "reading memory", 1e-9 * limits.memory,
              "copying memory", 1e-9 * limits.copy);
  std::printf("%-44s %8.1f GB/s\n%-44s %8.1f GB/s\n\n", "reading memory, all threads",
              1e-9 * limits.memory_all, "reading the second cache level", 1e-9 * limits.cache);
  std::printf("%-16s %-18s %8s %10s %10s %10s %10s\n", "", "rays", "Mrays/s", "instr/ray", "flop/ray",
              "bytes/ray", "Embree's instr/ray");
  std::fflush(stdout);
}

void cost_of_model(const std::string& argument, const Options& options, std::vector<Cost>& costs) {
  Model model = read_model(argument);
  TracerSettings settings;
  settings.isa = options.isa;
  const Tracer tracer(Scene(std::move(model.desc)), settings);
  const View view = view_of(model, tracer.scene().bounds(), std::nullopt);
  const auto embree = build_embree_scene(tracer.scene(), {});
  Stepper stepper({bytes_of(tracer.parts().nodes), bytes_of(tracer.parts().triangle_blocks),
                   bytes_of(tracer.parts().sphere_blocks)});
  for (const RaySet& set : make_ray_sets(tracer, view, 1024, 1024, ray_set_names())) {
    if (set.ray_count == 0) continue;
    costs.push_back(cost_of(stepper, tracer, embree.get(), set, options));
    costs.back().model = model.name;
    print(costs.back());
  }
}

void write_json(const Limits& limits, const std::vector<Cost>& costs, const Options& options) {
  std::ofstream file(options.json);
  file << "{\"limits\": {\"gflops\": {";
  for (std::size_t i = 0; i < limits.operations.size(); ++i)
    file << (i == 0 ? "" : ", ") << '"' << isa_name(limits.operations[i].first)
         << "\": " << 1e-9 * limits.operations[i].second;
  file << "}, \"ginstructions\": " << 1e-9 * limits.instructions
       << ", \"memory_gb\": " << 1e-9 * limits.memory << ", \"copy_gb\": " << 1e-9 * limits.copy
       << ", \"cache_gb\": " << 1e-9 * limits.cache << ", \"memory_gb_all\": " << 1e-9 * limits.memory_all
       << ", \"threads\": " << options.threads << "},\n\"rays\": [";
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const Cost& c = costs[i];
    file << (i == 0 ? "\n" : ",\n") << "  {\"model\": \"" << c.model << "\", \"isa\": \""
         << isa_name(options.isa) << "\", \"rays\": \"" << c.rays << "\", \"mrays\": " << 1e-6 * c.rate
         << ", \"instructions\": " << c.instructions << ", \"flops\": " << c.operations
         << ", \"bytes\": " << c.bytes << ", \"embree_instructions\": " << c.embree_instructions
         << ", \"sampled_rays\": " << c.sampled_rays << '}';
  }
  file << "\n]}\n";
  file.close();
  if (!file) throw OutputError("cannot write " + options.json);
}

int run(int count, char** arguments) {
  const Options options = parse(count, arguments);
  if (options.models.empty()) throw UsageError(std::string("no model given\n") + usage);
  const Limits limits = measure_limits(options.threads);
  print(limits);
  std::vector<Cost> costs;
  for (const std::string& model : options.models) cost_of_model(model, options, costs);
  if (!options.json.empty()) write_json(limits, costs, options);
  return 0;
}

} // namespace
} // namespace fastrt::bench

int main(int count, char** arguments) {
  return fastrt::bench::guarded_main("fastrt_roofline", fastrt::bench::run, count, arguments);
}
