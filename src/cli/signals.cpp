// SPDX-License-Identifier: Apache-2.0
#include "src/cli/signals.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>

namespace fastrt::cli {
namespace {

constexpr int grace_microseconds = 350'000;

std::atomic<Phase> current_phase{Phase::idle};
std::atomic<bool> cancel_flag{false};
std::atomic<int> first_signal{0};
std::atomic<int> percent_done{0};
static_assert(std::atomic<Phase>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
              std::atomic<bool>::is_always_lock_free);

// The functions below run inside a signal handler: only what is async-signal-safe.

void append(char*& end, const char* text) {
  while (*text != '\0') *end++ = *text++;
}

// number: 0..999.
void append(char*& end, int number) {
  if (number >= 100) *end++ = static_cast<char>('0' + number / 100);
  if (number >= 10) *end++ = static_cast<char>('0' + number / 10 % 10);
  *end++ = static_cast<char>('0' + number % 10);
}

[[noreturn]] void end_now(int signal) {
  char line[160];
  char* end = line;
  if (isatty(STDERR_FILENO) == 1) append(end, "\r\x1b[K"); // over a progress bar
  append(end, "fastrt: error: ");
  append(end, signal == SIGINT ? "interrupted" : "terminated");
  if (current_phase.load() == Phase::rendering) {
    append(end, " at ");
    append(end, percent_done.load());
    append(end, " % of the rendering; no picture is written");
  }
  append(end, "\n");
  // Whoever can't be told is still to be left.
  const ssize_t said = write(STDERR_FILENO, line, static_cast<std::size_t>(end - line));
  static_cast<void>(said);
  _exit(128 + signal);
}

void on_grace_over(int) { end_now(first_signal.load()); }

void on_signal(int signal) {
  int none = 0;
  if (!first_signal.compare_exchange_strong(none, signal)) _exit(128 + signal);
  if (current_phase.load() == Phase::idle) end_now(signal);
  const int saved_errno = errno;
  cancel_flag.store(true);
  const itimerval timer{{0, 0}, {0, grace_microseconds}};
  setitimer(ITIMER_REAL, &timer, nullptr);
  errno = saved_errno;
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

} // namespace

void install_signal_handlers() {
  handle(SIGALRM, on_grace_over);
  handle(SIGINT, on_signal);
  handle(SIGTERM, on_signal);
  handle(SIGXFSZ, SIG_IGN);
}

void enter_phase(Phase phase) noexcept {
  current_phase.store(phase);
  // One that came a moment before, when it could only set the flag.
  if (phase == Phase::idle && first_signal.load() != 0) end_by_signal();
}

const std::atomic<bool>& cancelled() noexcept { return cancel_flag; }

void note_progress(double share) noexcept { percent_done.store(static_cast<int>(share * 100)); }

void end_by_signal() noexcept {
  const itimerval never{};
  setitimer(ITIMER_REAL, &never, nullptr);
  end_now(first_signal.load());
}

int signal_received() noexcept { return first_signal.load(); }

} // namespace fastrt::cli
