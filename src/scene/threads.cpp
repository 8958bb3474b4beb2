// SPDX-License-Identifier: Apache-2.0
#include "src/scene/threads.hpp"

#include <omp.h>

#include <algorithm>

namespace fastrt {

int thread_count(int wanted) noexcept {
  const int most = 4 * std::max(1, omp_get_num_procs());
  return std::clamp(wanted <= 0 ? omp_get_max_threads() : wanted, 1, most);
}

} // namespace fastrt
