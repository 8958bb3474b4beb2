// SPDX-License-Identifier: Apache-2.0
// Runs programs and measures them from outside.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fastrt::bench {

struct ProcessResult {
  double seconds = 0;     // from start to end
  double cpu_seconds = 0; // user and system
  std::size_t peak_bytes = 0;
  int exit_code = 0; // 128 + signal if it was killed
};

// Runs a command with its output thrown away. Throws Error if it can't be started. By way of this program
// itself, called with `measure_option`: a process that is started by a large one counts as that large.
ProcessResult run_process(const std::vector<std::string>& command);

// What main() does if its first argument is that: runs the command that follows and prints what it took.
inline constexpr const char* measure_option = "--measure-process";
int measure_process(char** command);

// The program's full path if PATH has it.
std::optional<std::string> find_program(const std::string& name);

} // namespace fastrt::bench
