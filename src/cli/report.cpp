// SPDX-License-Identifier: Apache-2.0
#include "src/cli/report.hpp"

#include <fastrt/error.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace fastrt::cli {
namespace {

// One write, so that lines of several programs don't mix.
void print_line(std::string_view kind, std::string_view message) {
  const std::string line = "fastrt: " + std::string(kind) + ": " + printable(message) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

} // namespace

std::string printable(std::string_view text) {
  constexpr const char* digits = "0123456789abcdef";
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7F) {
      line += c;
    } else {
      line += "\\x";
      line += digits[byte >> 4U];
      line += digits[byte & 15U];
    }
  }
  return line;
}

void print_error(std::string_view message) { print_line("error", message); }
void print_warning(std::string_view message) { print_line("warning", message); }

void print_out(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw OutputError(std::string("cannot write to standard output: ") + std::strerror(errno));
  }
}

} // namespace fastrt::cli
