// SPDX-License-Identifier: Apache-2.0
#include <fastrt/load.hpp>
#include <fastrt/render.hpp>

#include <benchmark/benchmark.h>

#include <string>

#include "bench/benchmarks.hpp"
#include "bench/generated.hpp"

namespace fastrt::bench {
namespace {

constexpr int width = 1024, height = 768;

// The scene with lights, and with mirrors if wanted.
Scene lit_scene(const std::string& name, bool mirrors, Camera& camera) {
  SceneDesc desc = generated_scene(name);
  const Aabb bounds = bounds_of(desc);
  camera = frame_scene(bounds, 40.0F, static_cast<float>(width) / height);
  add_default_lights(desc, bounds, camera);
  if (mirrors) desc.materials[0].mirror = Vec3(0.5F);
  return Scene(std::move(desc));
}

void render_frame(benchmark::State& state, const std::string& name, Isa isa, bool mirrors, int threads) {
  Camera camera;
  TracerSettings tracer_settings;
  tracer_settings.isa = isa;
  const Tracer tracer(lit_scene(name, mirrors, camera), tracer_settings);
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.threads = threads;
  std::uint64_t rays = 0;
  for (auto _ : state) rays = render(tracer, camera, settings).rays.total();
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsIterationInvariantRate);
}

} // namespace

void register_frames() {
  for (const std::string& scene : generated_scene_names())
    for (const bool mirrors : {false, true})
      for (const Isa isa : available_isas())
        for (const int threads : {1, 2}) {
          const std::string name = "frame/" + scene + (mirrors ? " of mirrors/" : "/") + isa_name(isa) +
                                   "/threads:" + std::to_string(threads);
          benchmark::RegisterBenchmark(
              name.c_str(),
              [=](benchmark::State& state) { render_frame(state, scene, isa, mirrors, threads); })
              ->UseRealTime()
              ->Unit(benchmark::kMillisecond);
        }
}

} // namespace fastrt::bench
