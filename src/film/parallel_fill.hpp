// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/scene/threads.hpp"

#include <fastrt/column.hpp>

#include <cstddef>

namespace fastrt {

// Gives a column this size and all its numbers one value. Of large ones threads touch the memory first.
template <class T>
void fill(Column<T>& column, std::size_t count, T value, int threads) {
  column.resize(count);
  T* const values = column.data();
#pragma omp parallel for schedule(static) num_threads(thread_count(threads)) if (count > 65536)
  for (std::size_t i = 0; i < count; ++i) values[i] = value;
}

} // namespace fastrt
