// SPDX-License-Identifier: Apache-2.0
// Programmer errors: checked where the CMake option FASTRT_ASSERTS is on, as in the preset `dev`.
#pragma once

namespace fastrt {

// Prints the failed claim with both values and aborts.
[[noreturn]] void assertion_failed(const char* claim, const char* file, int line, double left,
                                   double right) noexcept;

} // namespace fastrt

#if defined(FASTRT_ASSERTS)
#define FASTRT_ASSERT_OP(a, op, b)                                                                           \
  (((a)op(b)) ? static_cast<void>(0)                                                                         \
              : ::fastrt::assertion_failed(#a " " #op " " #b, __FILE__, __LINE__, static_cast<double>(a),    \
                                           static_cast<double>(b)))
#else
#define FASTRT_ASSERT_OP(a, op, b) static_cast<void>(0)
#endif
#define FASTRT_ASSERT_LE(a, b) FASTRT_ASSERT_OP(a, <=, b)
#define FASTRT_ASSERT_LT(a, b) FASTRT_ASSERT_OP(a, <, b)
