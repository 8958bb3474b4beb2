// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/cli/options.hpp"

#include <chrono>

namespace fastrt::cli {

// The program's exit codes, besides 128 + n for signal n.
enum ExitCode : int {
  exit_done = 0,
  exit_differs = 1,
  exit_usage = 2,
  exit_input = 3,
  exit_output = 4,
  exit_limit = 5,
  exit_bug = 70,
};

// Reads, renders and writes as the options say, and reports. Returns the exit code; throws for all that goes
// wrong. start: when the program began.
int run(const Options& options, std::chrono::steady_clock::time_point start);

} // namespace fastrt::cli
