// SPDX-License-Identifier: Apache-2.0
// How many threads a parallel region gets.
#pragma once

namespace fastrt {

// wanted: 0 takes what OpenMP takes by itself (every core, or OMP_NUM_THREADS). Never more than four per
// core: past what the system can start, libgomp ends the process.
int thread_count(int wanted) noexcept;

} // namespace fastrt
