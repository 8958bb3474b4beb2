// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <omp.h>

#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

namespace fastrt {

// Calls task(i, thread) for i = 0 .. count - 1, each once, on so many threads. Of the exceptions thrown the
// one of the smallest i is passed on.
template <class Task>
void parallel_for(std::size_t count, int threads, Task&& task) {
  std::exception_ptr failure;
  std::size_t failed = std::numeric_limits<std::size_t>::max();
  std::mutex mutex;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < count; ++i) {
    try {
      task(i, static_cast<std::size_t>(omp_get_thread_num()));
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (i < failed) {
        failed = i;
        failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

} // namespace fastrt
