// SPDX-License-Identifier: Apache-2.0
// OpenMP tasks that may throw.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <utility>

namespace fastrt {

// The first exception of a number of tasks: none may leave the task that threw it.
class TaskFailure {
public:
  template <class F>
  void guard(F&& body) noexcept {
    try {
      std::forward<F>(body)();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!first_) first_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

private:
  std::mutex mutex_;
  std::exception_ptr first_;
};

// Runs `body` and all the tasks that it spawns on so many threads (0: every core); throws the first
// exception. Within another's body the tasks go to the threads that are there already: to end a team means to
// wait until each of its threads has had its turn, which can take long where others want the cores too.
template <class F>
void run_tasks(int threads, TaskFailure& failure, F&& body) {
  if (threads != 1 && omp_in_parallel() != 0) {
#pragma omp taskgroup
    failure.guard(body);
  } else {
#pragma omp parallel num_threads(threads > 0 ? threads : omp_get_max_threads())
#pragma omp single
    failure.guard(body);
  }
  failure.rethrow();
}

// Leaves `body` to whichever thread is free.
template <class F>
void spawn(TaskFailure& failure, F body) {
#pragma omp task default(none) firstprivate(body) shared(failure)
  failure.guard(body);
}

// body(0) .. body(count - 1), in any order and at the same time. The body must not throw.
template <class F>
void for_each_index(std::size_t count, const F& body) {
#pragma omp taskgroup
  for (std::size_t i = 0; i < count; ++i) {
#pragma omp task default(none) shared(body) firstprivate(i)
    body(i);
  }
}

// The same for pieces of so many neighbours: body(begin, end).
template <class F>
void for_each_piece(std::size_t count, std::size_t piece, const F& body) {
  for_each_index((count + piece - 1) / piece,
                 [&](std::size_t i) { body(i * piece, std::min(count, (i + 1) * piece)); });
}

// Into how many tasks to cut what is done to so many nodes: each is worth the trouble, and there are no more
// than it takes to keep threads busy. One thread needs one.
inline std::size_t tasks_for(std::size_t nodes, int threads) {
  return threads == 1 ? 1 : std::clamp<std::size_t>(nodes / 256, 1, 256);
}

} // namespace fastrt
