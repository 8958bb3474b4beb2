// SPDX-License-Identifier: Apache-2.0
// fastrt_bench: the parts of fastrt on their own. Needs no files.
#include <benchmark/benchmark.h>

#include "bench/benchmarks.hpp"

int main(int count, char** arguments) {
  using namespace fastrt::bench;
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  register_kernels();
  register_build();
  register_traversal();
  register_files();
  register_frames();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
