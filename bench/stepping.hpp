// SPDX-License-Identifier: Apache-2.0
// Counts what a piece of code does by running it one instruction at a time (the processor's trap flag). Needs
// no hardware counters and works with any instruction set; each step costs microseconds.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace fastrt::bench {

struct Work {
  std::size_t instructions = 0, operations = 0; // operations: on floats
  std::size_t lines = 0; // distinct cache lines of the watched memory that were touched
};

inline constexpr std::size_t line_bytes = 64;

class Stepper {
public:
  // Watches these ranges of memory, which must outlive the stepper. One stepper at a time; x86-64 Linux
  // alone.
  explicit Stepper(std::vector<std::span<const std::byte>> watched);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  ~Stepper();

  // What `code` does on this thread. It must not raise or block signals.
  Work run(const std::function<void()>& code);

private:
  Work raw(const std::function<void()>& code);
  Work empty_; // what stepping adds by itself
};

} // namespace fastrt::bench
