// SPDX-License-Identifier: Apache-2.0
// Those that are compared: each answers a few batches of rays at a time from memory that is already warm, so
// that what is timed is tracing alone.
#pragma once

#include "src/kernels/kernel_table.hpp"

#include <fastrt/isa.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/ray_sets.hpp"

namespace fastrt::bench {

inline constexpr std::size_t chunk_batches = 16; // what a worker takes at once

// One thread's hands. load() copies and converts the rays and is not timed; trace() answers them.
class Worker {
public:
  Worker() = default;
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  virtual ~Worker() = default;

  virtual void load(const RayBatch* batches, std::size_t count) = 0;
  virtual void trace() = 0;
  // After trace(): the primitive per ray in order (no_primitive: none); for Question::any 0 where something
  // was hit.
  virtual void answers(std::vector<std::int32_t>& out) const = 0;
};

struct Contender {
  std::string name;
  std::function<std::unique_ptr<Worker>(Question)> make_worker;
};

// Isa::scalar has none.
const KernelTable& kernel_table_of(Isa isa);

// The kernels of one ISA; for Isa::scalar one ray at a time through the binary tree. The tracer must outlive
// it.
Contender fastrt_contender(const Tracer& tracer, Isa isa);

} // namespace fastrt::bench
