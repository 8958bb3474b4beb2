// SPDX-License-Identifier: Apache-2.0
#include "src/scene/threads.hpp"

#include "src/scene/startable_threads.hpp"

#include <omp.h>

#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <chrono>

namespace fastrt {

int thread_count(int wanted) noexcept {
  const int most = std::max(1, std::min(4 * omp_get_num_procs(), omp_get_thread_limit()));
  const int count = std::clamp(wanted <= 0 ? omp_get_max_threads() : wanted, 1, most);
  return omp_in_parallel() != 0 ? count : startable_threads(count);
}

#ifdef __linux__
namespace {

// Takes the processor on which the caller runs out of `free`, or else the first that it may run on; -1 if
// none is left.
int take_processor(const cpu_set_t& allowed, cpu_set_t& free) noexcept {
  const int here = sched_getcpu();
  for (int i = -1; i < CPU_SETSIZE; ++i) {
    const int processor = i < 0 ? here : i;
    if (processor < 0 || !CPU_ISSET(processor, &allowed) || !CPU_ISSET(processor, &free)) continue;
    CPU_CLR(processor, &free);
    return processor;
  }
  return -1;
}

// Moves the caller there. It may leave again.
void move_to(int processor, const cpu_set_t& allowed) noexcept {
  if (processor < 0 || processor == sched_getcpu()) return;
  cpu_set_t there;
  CPU_ZERO(&there);
  CPU_SET(processor, &there);
  if (sched_setaffinity(0, sizeof there, &there) == 0) sched_setaffinity(0, sizeof allowed, &allowed);
}

// Moves the caller to a processor that nobody has taken.
void move_to_own(cpu_set_t& free) noexcept {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  int own = -1;
#pragma omp critical(fastrt_place_threads)
  own = take_processor(allowed, free);
  move_to(own, allowed);
}

// Lets each of the caller's first `threads` threads, in a team of `team`, move to a processor of its own.
// free: those that none has taken, the caller's aside.
void spread(int team, int threads, cpu_set_t free) noexcept {
#pragma omp parallel num_threads(team)
  {
    const int thread = omp_get_thread_num();
    if (thread == 0)
      sched_yield();
    else if (thread < threads)
      move_to_own(free);
  }
}

// For about this long libgomp's threads wait for the next region spinning. After that they sleep, and may
// wake up on the caller's processor.
constexpr std::chrono::milliseconds awake(2);

} // namespace

// In a team with one thread more than there are processors libgomp's threads wait for each other asleep:
// those that begin on the caller's processor get it at once, and move. The caller wakes up wherever the last
// of them was, and moves back. In the second team, without the one too many, they wake up once more, and from
// then on wait spinning.
void place_threads(int threads) noexcept {
  static thread_local int placed = 1;
  static thread_local std::chrono::steady_clock::time_point until;
  const auto now = std::chrono::steady_clock::now();
  cpu_set_t allowed;
  if (threads == 1 || (threads <= placed && now < until) || omp_in_parallel() != 0 ||
      omp_get_proc_bind() != omp_proc_bind_false || sched_getaffinity(0, sizeof allowed, &allowed) != 0 ||
      CPU_COUNT(&allowed) != threads || startable_threads(threads + 1) <= threads)
    return;
  placed = threads;
  until = now + awake;
  cpu_set_t free = allowed;
  const int own = take_processor(allowed, free);
  spread(threads + 1, threads, free);
  move_to(own, allowed);
  spread(threads, threads, free);
}
#else
void place_threads(int) noexcept {}
#endif

} // namespace fastrt
