// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace fastrt {

// The root of everything the library throws on purpose. what() is one line, ready to be shown to a user.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// A scene, material or camera that can't be used. what() begins with file:line:column where these are known.
class InputError : public Error {
public:
  explicit InputError(const std::string& message) : Error(message) {}
  // line and column count from 1; 0 leaves them out.
  InputError(const std::string& file, std::size_t line, std::size_t column, const std::string& message);
};

// An option or argument that makes no sense, or that this machine can't serve (an ISA that the CPU lacks).
class UsageError : public Error {
public:
  using Error::Error;
};

// A picture that can't be written.
class OutputError : public Error {
public:
  using Error::Error;
};

// More memory, primitives or pixels than the limits allow.
class LimitError : public Error {
public:
  using Error::Error;
};

// Prints the failed claim with both values and aborts. Only FASTRT_ASSERT calls it.
[[noreturn]] void assertion_failed(const char* claim, const char* file, int line, double left,
                                   double right) noexcept;

} // namespace fastrt

// Programmer errors: checked in Debug builds and in the tests' builds, compiled out of Release.
#if defined(FASTRT_ASSERTS)
#define FASTRT_ASSERT_OP(a, op, b)                                                                           \
  (((a)op(b)) ? static_cast<void>(0)                                                                         \
              : ::fastrt::assertion_failed(#a " " #op " " #b, __FILE__, __LINE__, static_cast<double>(a),    \
                                           static_cast<double>(b)))
#else
#define FASTRT_ASSERT_OP(a, op, b) static_cast<void>(0)
#endif
#define FASTRT_ASSERT(claim) FASTRT_ASSERT_OP((claim), !=, false)
#define FASTRT_ASSERT_LE(a, b) FASTRT_ASSERT_OP(a, <=, b)
#define FASTRT_ASSERT_LT(a, b) FASTRT_ASSERT_OP(a, <, b)
#define FASTRT_ASSERT_EQ(a, b) FASTRT_ASSERT_OP(a, ==, b)
