// SPDX-License-Identifier: Apache-2.0
#include <fastrt/error.hpp>
#include <fastrt/load.hpp>
#include <fastrt/write.hpp>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "bench/benchmarks.hpp"
#include "bench/generated.hpp"

namespace fastrt::bench {
namespace {

// An OBJ file that lives as long as this does.
class TemporaryObj {
public:
  explicit TemporaryObj(const SceneDesc& desc)
      : path_(std::filesystem::temp_directory_path() /
              ("fastrt_bench_" + std::to_string(getpid()) + ".obj")) {
    std::ofstream file(path_);
    char line[96];
    for (std::size_t i = 0; i < desc.positions.size(); ++i) {
      const Vec3 p = desc.positions[i];
      std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", p.x, p.y, p.z);
      file << line;
    }
    const TriangleColumns& t = desc.triangles;
    for (std::size_t i = 0; i < t.size(); ++i)
      file << "f " << t.v0[i] + 1 << ' ' << t.v1[i] + 1 << ' ' << t.v2[i] + 1 << '\n';
    file.close();
    if (!file) throw OutputError("cannot write " + path_.string());
  }
  TemporaryObj(const TemporaryObj&) = delete;
  TemporaryObj& operator=(const TemporaryObj&) = delete;
  ~TemporaryObj() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

void read_obj(benchmark::State& state) {
  const TemporaryObj file(terrain_scene(512));
  LoadOptions options;
  options.threads = static_cast<int>(state.range(0));
  for (auto _ : state) {
    Diagnostics diagnostics;
    benchmark::DoNotOptimize(load_obj(file.path(), options, diagnostics).triangles.size());
  }
  state.SetBytesProcessed(state.iterations() *
                          static_cast<std::int64_t>(std::filesystem::file_size(file.path())));
}

// A picture with smooth parts and detail, as renderings have.
std::vector<float> some_picture(int width, int height) {
  std::vector<float> rgb;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float fx = static_cast<float>(x), fy = static_cast<float>(y);
      const bool inside = std::hypot(fx - 500.0F, fy - 400.0F) < 300.0F;
      for (const float shade : {0.9F, 0.8F, 0.6F})
        rgb.push_back(inside ? shade * (0.5F + 0.4F * std::sin(0.05F * fx) * std::cos(0.31F * fy)) : 0.04F);
    }
  return rgb;
}

void write_png(benchmark::State& state) {
  constexpr int width = 1024, height = 768;
  const std::vector<float> rgb = some_picture(width, height);
  std::size_t bytes = 0;
  for (auto _ : state)
    bytes = encode_image("png", rgb, width, height, static_cast<int>(state.range(0))).size();
  state.counters["pixels/s"] =
      benchmark::Counter(double{width} * height, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["bytes"] = static_cast<double>(bytes);
}

} // namespace

void register_files() {
  benchmark::RegisterBenchmark("read obj", read_obj)
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("write png", write_png)
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

} // namespace fastrt::bench
