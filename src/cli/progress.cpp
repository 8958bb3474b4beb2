// SPDX-License-Identifier: Apache-2.0
#include "src/cli/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace fastrt::cli {
namespace {

bool is_smart_terminal() {
  const char* term = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && term != nullptr && std::strcmp(term, "dumb") != 0;
}

int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string clock_time(double seconds) {
  const auto whole = static_cast<long>(std::min(seconds, 359'999.0) + 0.5);
  char text[32];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  }
  return text;
}

} // namespace

std::string progress_line(const std::string& label, double share, double seconds_taken, int columns) {
  share = std::clamp(share, 0.0, 1.0);
  char percent[16];
  std::snprintf(percent, sizeof percent, "%3d %% ", static_cast<int>(share * 100));
  const std::string left =
      share > 0 ? " " + clock_time(seconds_taken * (1 - share) / share) + " left" : std::string();
  std::string line = label + " " + percent;

  // The last column stays empty: some terminals wrap there.
  const int room = columns - 1 - static_cast<int>(line.size() + left.size()) - 2;
  if (room >= 10) {
    const auto width = static_cast<std::size_t>(std::min(room, 40));
    const auto full = static_cast<std::size_t>(share * static_cast<double>(width));
    line += "[" + std::string(full, '=') + std::string(width - full, ' ') + "]";
  }
  return line + left;
}

ProgressBar::ProgressBar(bool wanted, std::string label)
    : enabled_(wanted && is_smart_terminal()), label_(std::move(label)), start_(Clock::now()), last_(start_) {
}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::update(double share) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  const double taken = std::chrono::duration<double>(now - start_).count();
  std::fputs(("\r" + progress_line(label_, share, taken, terminal_columns()) + "\x1b[K").c_str(), stderr);
}

} // namespace fastrt::cli
