// SPDX-License-Identifier: Apache-2.0
// What the machine can do at most, found by loops that do nothing else. Thread CPU time; the best of a few
// tries.
#pragma once

#include <fastrt/isa.hpp>

#include <cstddef>

namespace fastrt::bench {

// Multiply-adds of floats in registers (SSE4.2: multiplications and additions), operations a second of one
// thread.
double peak_operations(Isa isa);

// Instructions a second of one thread: additions of floats and integers, loads from the stack and comparisons
// that do not wait for one another, so that the front end is the limit.
double peak_instructions();

// Bytes a second of `threads` threads together, each reading a buffer of its own again and again.
double read_bandwidth(std::size_t bytes, int threads);

// Bytes read and written a second by one thread that copies memory much larger than the caches.
double copy_bandwidth();

} // namespace fastrt::bench
