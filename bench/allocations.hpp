// SPDX-License-Identifier: Apache-2.0
// Counts what operator new hands out and the memory of columns, which large ones take from the system itself.
// A program that links allocations.cpp has its operator new replaced and its columns wrapped
// (CMakeLists.txt).
#pragma once

#include <cstddef>

namespace fastrt::bench {

std::size_t bytes_allocated() noexcept; // held now
std::size_t peak_allocated() noexcept;  // held at most since the last reset
void reset_peak() noexcept;

} // namespace fastrt::bench
