// SPDX-License-Identifier: Apache-2.0
// What the comparison found, for people and for programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/measure.hpp"

namespace fastrt::bench {

struct FastrtRow {
  std::string isa;
  Spread mrays;        // Mrays/s
  Spread ratio;        // to Embree's best mode, per round
  Spread robust_ratio; // to the best mode of Embree's robust scene
  Spread scalar_ratio; // to one ray at a time through the binary tree
  // Embree kept to the ISA, with packets as wide as its registers: the faster mode, and the ratio to it.
  std::string peer_mode;
  Spread peer, peer_ratio;
};

struct TraversalResult {
  std::string model, rays;
  int threads = 1;
  std::size_t ray_count = 0;
  double traced_share = 1; // of the set in each round
  std::vector<FastrtRow> fastrt;
  std::vector<std::pair<std::string, double>> embree_modes; // Mrays/s
  std::string best_mode, best_robust_mode;
  Spread embree, embree_robust; // Mrays/s of those, in the paired rounds
  Disagreement with_embree, with_robust;
};

struct BuildResult {
  std::string model;
  int threads = 1;
  std::size_t primitives = 0;
  Spread fastrt_seconds, embree_seconds, ratio; // ratio: Embree's time over fastrt's
  std::size_t fastrt_bytes = 0,
              fastrt_peak_bytes = 0; // of the tree, primitives included; at most during the build
  std::size_t embree_bytes = 0, embree_peak_bytes = 0;
};

struct Report {
  std::string cpu, embree, fastrt;
  std::vector<BuildResult> builds;
  std::vector<TraversalResult> traversals;
};

void print_build_heading();
void print(const BuildResult& result);
void print(const TraversalResult& result);
// Throws OutputError.
void write_json(const Report& report, const std::string& path);

} // namespace fastrt::bench
