// SPDX-License-Identifier: Apache-2.0
// What the system's limits leave of a team of threads: libgomp ends the process if it can't start all of one.
#pragma once

namespace fastrt {

// As many threads of `wanted`, the caller counted, as the caller may have in a team: at most half of what the
// system has room for, which leaves some to others and memory to more than stacks. Where their number is
// limited it is tried, once for each thread that calls and larger number: some 50 us a thread.
int startable_threads(int wanted) noexcept;

} // namespace fastrt
