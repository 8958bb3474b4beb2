// SPDX-License-Identifier: Apache-2.0
#include "src/scene/startable_threads.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace fastrt {
namespace {

// Whoever may have so many threads or more has some left.
constexpr unsigned long plenty = 16384;

bool is_below(auto resource, rlim_t number) noexcept {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 && limit.rlim_cur < number;
}

// Of a container: the file says "max" where there is no limit.
bool has_number_below(const char* path, unsigned long number) noexcept {
  std::FILE* const file = std::fopen(path, "r");
  if (file == nullptr) return false;
  unsigned long found = number;
  const bool has_one = std::fscanf(file, "%lu", &found) == 1;
  std::fclose(file);
  return has_one && found < number;
}

// Whether a team of threads might not start.
bool are_limited() noexcept {
  return is_below(RLIMIT_AS, RLIM_INFINITY) || is_below(RLIMIT_NPROC, plenty) ||
         has_number_below("/sys/fs/cgroup/pids.max", plenty) ||
         has_number_below("/sys/fs/cgroup/pids/pids.max", plenty);
}

// How many threads, the caller counted and `wanted` at most, run at once: starts them, and waits for their
// end.
int count_started(int wanted) noexcept {
  std::mutex gate;
  std::vector<std::thread> threads;
  {
    const std::lock_guard closed(gate);
    try {
      threads.reserve(static_cast<std::size_t>(wanted));
      for (int count = 1; count < wanted; ++count)
        threads.emplace_back([&gate] { const std::lock_guard passed(gate); });
    } catch (const std::exception&) { // no memory for a stack, or one thread too many
    }
  }
  for (std::thread& thread : threads) thread.join();
  return static_cast<int>(threads.size()) + 1;
}

} // namespace

int startable_threads(int wanted) noexcept {
  static const bool limited = are_limited();
  static thread_local int known = 1;
  if (!limited || wanted <= known) return wanted;
  const int started = count_started(wanted);
  if (started < wanted) return std::max(known, started / 2);
  return known = started;
}

} // namespace fastrt
