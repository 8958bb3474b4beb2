// SPDX-License-Identifier: Apache-2.0
#include "src/scene/assert.hpp"
#include "src/scene/printable.hpp"

#include <fastrt/error.hpp>

#include <cstdio>
#include <cstdlib>

namespace fastrt {

namespace {

std::string located(const std::string& file, std::size_t line, std::size_t column,
                    const std::string& message) {
  std::string text = file;
  for (const std::size_t number : {line, line == 0 ? 0 : column}) {
    if (number == 0) break;
    text += ':';
    text += std::to_string(number);
  }
  if (!text.empty()) text += ": ";
  return printable(text + message);
}

} // namespace

InputError::InputError(const std::string& file, std::size_t line, std::size_t column,
                       const std::string& message)
    : Error(located(file, line, column, message)) {}

void assertion_failed(const char* claim, const char* file, int line, double left, double right) noexcept {
  static_cast<void>(
      std::fprintf(stderr, "%s:%d: assertion failed: %s (%.17g, %.17g)\n", file, line, claim, left, right));
  std::abort();
}

} // namespace fastrt
