// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/isa.hpp>
#include <fastrt/math.hpp>

#include <optional>
#include <string>
#include <vector>

namespace fastrt::bench {

struct CompareOptions {
  std::vector<std::string> models; // files, or names of generated scenes
  std::vector<Isa> isas;
  std::vector<int> threads{1, 2};
  std::vector<std::string> rays;
  int rounds = 9;
  double seconds = 0.08;
  int width = 1024, height = 1024;
  std::optional<Vec3> eye, look_at;
  std::optional<bool> inside; // unset: by the model's name
  bool build = true;          // measure building too
  bool help = false;
  std::string json; // file; empty: none
};

// Throws UsageError.
CompareOptions parse_compare_options(int count, char** arguments);
std::string compare_usage();

} // namespace fastrt::bench
