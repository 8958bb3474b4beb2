// SPDX-License-Identifier: Apache-2.0
// Measures contenders on the same rays, in turn, so that whatever else the machine does meets them alike.
#pragma once

#include <span>
#include <vector>

#include "bench/tracers.hpp"

namespace fastrt::bench {

// CPU time of the calling thread.
double thread_seconds();

struct Spread {
  double median = 0, smallest = 0, largest = 0;
};
Spread spread_of(std::vector<double> values);

struct RoundSettings {
  int threads = 1;
  int rounds = 7;
  double seconds = 0.08; // that one contender's part of a round should take each thread
};

// What of a set is traced in a round, by all contenders: one of `step` chunks, spread over the whole picture,
// so that slow sets do not take minutes; and these `passes` times for each thread, so that in fast sets what
// a thread meets with cold caches counts for little.
struct Share {
  std::size_t step = 1, passes = 1;
};

// So that this contender takes each thread about so many seconds.
Share share_for(const Contender& contender, const RaySet& set, double seconds);

// Rays per second of tracing, of all threads together. Time is each thread's CPU time, so that being pushed
// off a core does not count; loading is not timed.
double rays_per_second(const Contender& contender, const RaySet& set, int threads, const Share& share);

// One value per round for each contender: A B C A B C ...
std::vector<std::vector<double>> run_rounds(std::span<const Contender> contenders, const RaySet& set,
                                            const RoundSettings& settings, const Share& share);

// Of each contender's rounds, and which contender's is the largest.
std::vector<double> medians(const std::vector<std::vector<double>>& rates);
std::size_t fastest(const std::vector<double>& rates);

// What two contenders answer differently over the whole set.
struct Disagreement {
  std::size_t rays = 0, hits = 0; // hits: of the first
  std::size_t hit_or_miss = 0;    // one hits, the other does not
  std::size_t primitive = 0;      // both hit, but not the same primitive
};
Disagreement compare_answers(const Contender& a, const Contender& b, const RaySet& set);

} // namespace fastrt::bench
