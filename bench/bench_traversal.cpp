// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "bench/benchmarks.hpp"
#include "bench/embree_scene.hpp"
#include "bench/generated.hpp"
#include "bench/measure.hpp"

namespace fastrt::bench {
namespace {

constexpr int picture_size = 512; // pixels

// A scene with all that traces it and the rays that are traced. Made by the first benchmark that runs.
struct Course {
  Tracer tracer;
  std::vector<RaySet> sets;
  std::unique_ptr<EmbreeScene> embree;

  explicit Course(SceneDesc desc)
      : tracer(Scene(std::move(desc))), sets(make_ray_sets(tracer, outside_view(tracer.scene().bounds()),
                                                           picture_size, picture_size, ray_set_names())),
        embree(build_embree_scene(tracer.scene(), {})) {}
};

const Course& course_of(const std::string& scene) {
  static std::vector<std::pair<std::string, std::unique_ptr<Course>>> courses;
  for (const auto& [name, course] : courses)
    if (name == scene) return *course;
  courses.emplace_back(scene, std::make_unique<Course>(generated_scene(scene)));
  return *courses.back().second;
}

void trace(benchmark::State& state, const Contender& contender, const RaySet& set) {
  if (set.ray_count == 0) return state.SkipWithError("no rays");
  const auto count = static_cast<double>(set.ray_count);
  for (auto _ : state) state.SetIterationTime(count / rays_per_second(contender, set, 1, {}));
  state.counters["rays/s"] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
}

template <class MakeContender>
void add(const std::string& scene, std::size_t set, const std::string& who, const MakeContender& make) {
  const std::string name = scene + '/' + ray_set_names()[set] + '/' + who;
  benchmark::RegisterBenchmark(name.c_str(),
                               [scene, set, make](benchmark::State& state) {
                                 const Course& course = course_of(scene);
                                 trace(state, make(course), course.sets[set]);
                               })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void add_all(const std::string& scene, std::size_t set) {
  for (const Isa isa : available_isas())
    add(scene, set, isa_name(isa), [isa](const Course& c) { return fastrt_contender(c.tracer, isa); });
  if (embree_version().empty()) return;
  for (const EmbreeMode mode :
       {EmbreeMode{EmbreeCall::packet_1, false}, EmbreeMode{EmbreeCall::packet_8, true},
        EmbreeMode{EmbreeCall::packet_16, true}})
    add(scene, set, "embree " + name_of(mode), [mode](const Course& c) { return c.embree->contender(mode); });
}

} // namespace

void register_traversal() {
  for (const std::string& scene : generated_scene_names())
    for (std::size_t set = 0; set < ray_set_names().size(); ++set) add_all(scene, set);
}

} // namespace fastrt::bench
