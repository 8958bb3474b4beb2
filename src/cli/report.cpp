// SPDX-License-Identifier: Apache-2.0
#include "src/cli/report.hpp"

#include "src/scene/printable.hpp"

#include <fastrt/error.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

namespace fastrt::cli {
namespace {

// One write, so that lines of several programs don't mix.
void print_line(std::string_view kind, std::string_view message) {
  const std::string line = "fastrt: " + std::string(kind) + ": " + printable(std::string(message)) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

} // namespace

void print_error(std::string_view message) { print_line("error", message); }
void print_warning(std::string_view message) { print_line("warning", message); }
void print_note(std::string_view message) { print_line("note", message); }

void print_out(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw OutputError(std::string("cannot write to standard output: ") + std::strerror(errno));
  }
}

} // namespace fastrt::cli
