// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace fastrt::cli {

// "  42 % [========>           ] 0:12 left", as wide as `columns` allows. The time left is guessed from the
// time taken.
std::string progress_line(const std::string& label, double share, double seconds_taken, int columns);

// A bar on stderr, redrawn at most ten times a second and erased at the end. Only for a terminal: elsewhere
// nothing is printed.
class ProgressBar {
public:
  ProgressBar(bool wanted, std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // share: 0..1. From one thread at a time.
  void update(double share);

private:
  using Clock = std::chrono::steady_clock;

  bool enabled_;
  bool drawn_ = false;
  std::string label_;
  Clock::time_point start_, last_;
};

} // namespace fastrt::cli
