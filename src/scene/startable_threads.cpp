// SPDX-License-Identifier: Apache-2.0
#include "src/scene/startable_threads.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <mutex>
#include <vector>

namespace fastrt {
namespace {

// Whoever may have so many threads or more has some left.
constexpr unsigned long plenty = 16384;

rlim_t limit_of(auto resource) noexcept {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 ? limit.rlim_cur : RLIM_INFINITY;
}

// The first number of a file of the system, or `otherwise`.
unsigned long number_in(const char* path, unsigned long otherwise) noexcept {
  std::FILE* const file = std::fopen(path, "r");
  if (file == nullptr) return otherwise;
  unsigned long number = otherwise;
  if (std::fscanf(file, "%lu", &number) != 1) number = otherwise;
  std::fclose(file);
  return number;
}

std::size_t stack_bytes() noexcept {
  pthread_attr_t attributes;
  std::size_t bytes = std::size_t{8} << 20U;
  if (pthread_attr_init(&attributes) != 0) return bytes;
  pthread_attr_getstacksize(&attributes, &bytes);
  pthread_attr_destroy(&attributes);
  return std::max<std::size_t>(bytes, 1);
}

// Half of the address space that is left is for stacks.
int fitting(int wanted) noexcept {
  const rlim_t most = limit_of(RLIMIT_AS);
  if (most == RLIM_INFINITY) return wanted;
  const rlim_t used = number_in("/proc/self/statm", 0) * static_cast<unsigned long>(sysconf(_SC_PAGESIZE));
  const rlim_t stacks = most > used ? (most - used) / 2 / stack_bytes() : 0;
  return static_cast<int>(std::min<rlim_t>(static_cast<rlim_t>(wanted), stacks + 1));
}

// In a container the file says "max" where there is no limit.
bool are_counted() noexcept {
  return limit_of(RLIMIT_NPROC) < plenty || number_in("/sys/fs/cgroup/pids.max", plenty) < plenty ||
         number_in("/sys/fs/cgroup/pids/pids.max", plenty) < plenty;
}

void* pass(void* gate) {
  const std::lock_guard passed(*static_cast<std::mutex*>(gate));
  return nullptr;
}

// How many threads, the caller counted and `wanted` at most, run at once: starts them, and waits for their
// end. Small ones, for the system keeps their stacks.
int count_started(int wanted) noexcept {
  std::mutex gate;
  std::vector<pthread_t> threads;
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return 1;
  pthread_attr_setstacksize(&attributes, std::size_t{64} << 10U);
  {
    const std::lock_guard closed(gate);
    try {
      threads.resize(static_cast<std::size_t>(wanted - 1));
    } catch (const std::exception&) { // none is started
    }
    std::size_t started = 0;
    while (started < threads.size() && pthread_create(&threads[started], &attributes, pass, &gate) == 0)
      ++started;
    threads.resize(started);
  }
  for (const pthread_t thread : threads) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  return static_cast<int>(threads.size()) + 1;
}

} // namespace

int startable_threads(int wanted) noexcept {
  static const bool counted = are_counted();
  static thread_local int known = 1;
  if (wanted <= known) return wanted;
  int found = fitting(wanted);
  if (counted && found > 1) found = std::min(found, count_started(2 * found) / 2);
  return known = std::max(known, found);
}

} // namespace fastrt
