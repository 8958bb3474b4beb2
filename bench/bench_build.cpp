// SPDX-License-Identifier: Apache-2.0
#include <fastrt/tracer.hpp>

#include <benchmark/benchmark.h>

#include <string>

#include "bench/benchmarks.hpp"
#include "bench/generated.hpp"

namespace fastrt::bench {
namespace {

void build(benchmark::State& state, const SceneDesc& desc, int threads) {
  TracerSettings settings;
  settings.threads = threads;
  std::size_t primitives = 0, bytes = 0;
  for (auto _ : state) {
    const Tracer tracer(Scene(desc), settings);
    state.SetIterationTime(tracer.bvh_stats().build_seconds);
    primitives = tracer.scene().primitive_count();
    bytes = tracer.bvh_stats().bytes;
  }
  state.counters["prims/s"] =
      benchmark::Counter(static_cast<double>(primitives), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["bytes/prim"] = static_cast<double>(bytes) / static_cast<double>(primitives);
}

void add(const std::string& name, SceneDesc desc) {
  for (const int threads : {1, 2})
    benchmark::RegisterBenchmark(("build/" + name + "/threads:" + std::to_string(threads)).c_str(),
                                 [desc, threads](benchmark::State& state) { build(state, desc, threads); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

} // namespace

void register_build() {
  add("terrain 524k", terrain_scene(512));
  add("balls 66k", balls_scene(5));
}

} // namespace fastrt::bench
