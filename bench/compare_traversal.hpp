// SPDX-License-Identifier: Apache-2.0
// Rays through all trees of one model: fastrt's of every ISA, and Embree's.
#pragma once

#include <fastrt/tracer.hpp>

#include <memory>
#include <vector>

#include "bench/compare_options.hpp"
#include "bench/embree_scene.hpp"
#include "bench/report.hpp"

namespace fastrt::bench {

// What one ISA is compared by: trees differ, too. Embree's scene keeps to the ISA; none for scalar.
struct IsaCourse {
  Isa isa;
  Tracer tracer;
  std::unique_ptr<EmbreeScene> embree;
};

struct Course {
  std::vector<IsaCourse> isas;               // in the order of the options
  std::unique_ptr<EmbreeScene> fast, robust; // Embree's, with all that runs here
};
Course make_course(const SceneDesc& desc, const std::vector<Isa>& isas, int threads);

// One kind of rays at each number of threads, with the same part of the rays.
std::vector<TraversalResult> measure_traversal(const Course& course, const RaySet& set,
                                               const CompareOptions& options);

} // namespace fastrt::bench
