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

// What the scene's first material is: as it is, half a mirror, or glass. Glass scatters rays all over the
// scene, and shadow rays go through it.
enum class Surface { plain, mirror, glass };
constexpr const char* suffixes[] = {"/", " of mirrors/", " of glass/"};

// The scene with lights.
Scene lit_scene(const std::string& name, Surface surface, Camera& camera) {
  SceneDesc desc = generated_scene(name);
  const Aabb bounds = bounds_of(desc);
  camera = frame_scene(bounds, 40.0F, static_cast<float>(width) / height);
  add_default_lights(desc, bounds, camera);
  Material& material = desc.materials[0];
  if (surface == Surface::mirror) material.mirror = Vec3(0.5F);
  if (surface == Surface::glass) {
    material.opacity = 0.1F;
    material.ior = 1.5F;
    material.mirror = Vec3(1.0F);
    material.fresnel = Fresnel::dielectric;
  }
  return Scene(std::move(desc));
}

void render_frame(benchmark::State& state, const std::string& name, Isa isa, Surface surface, int samples,
                  int threads) {
  Camera camera;
  TracerSettings tracer_settings;
  tracer_settings.isa = isa;
  const Tracer tracer(lit_scene(name, surface, camera), tracer_settings);
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples_per_pixel = samples;
  settings.threads = threads;
  std::uint64_t rays = 0;
  for (auto _ : state) rays = render(tracer, camera, settings).rays.total();
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsIterationInvariantRate);
}

} // namespace

void register_frames() {
  const auto add = [](const std::string& scene, Surface surface, int samples) {
    for (const Isa isa : available_isas())
      for (const int threads : {1, 2}) {
        const std::string name = "frame/" + scene + suffixes[static_cast<int>(surface)] +
                                 (samples > 1 ? std::to_string(samples) + " samples/" : "") + isa_name(isa) +
                                 "/threads:" + std::to_string(threads);
        benchmark::RegisterBenchmark(
            name.c_str(),
            [=](benchmark::State& state) { render_frame(state, scene, isa, surface, samples, threads); })
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
      }
  };
  for (const std::string& scene : generated_scene_names()) {
    for (const Surface surface : {Surface::plain, Surface::mirror, Surface::glass}) add(scene, surface, 1);
    add(scene, Surface::plain, 16);
  }
}

} // namespace fastrt::bench
