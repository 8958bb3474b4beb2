// SPDX-License-Identifier: Apache-2.0
// How many threads a parallel region gets, and where they run.
#pragma once

namespace fastrt {

// wanted: 0 takes what OpenMP takes by itself (every core, or OMP_NUM_THREADS). Never more than four per
// core, nor more than the system's limits let start: past that libgomp ends the process.
int thread_count(int wanted) noexcept;

// Puts the threads that the caller's coming parallel regions of `threads` threads will get on processors of
// their own. New threads, and those that have slept, often begin on the processor of the caller, which waits
// for them spinning: small pictures then take several milliseconds longer, each of 4 twice. Takes 0.1 ms, at
// most every 2. Does nothing where there are more or fewer processors than threads, within parallel regions,
// and where the user has bound threads (OMP_PROC_BIND). No thread stays bound.
void place_threads(int threads) noexcept;

} // namespace fastrt
