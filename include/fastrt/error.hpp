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

} // namespace fastrt
