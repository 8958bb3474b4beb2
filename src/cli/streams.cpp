// SPDX-License-Identifier: Apache-2.0
#include "src/cli/streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <initializer_list>

namespace fastrt::cli {
namespace {

bool output_was_closed = false;

} // namespace

void fill_closed_streams() noexcept {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    if (stream == STDOUT_FILENO) output_was_closed = true;
    if (open("/dev/null", O_RDWR) < 0) return;
  }
}

bool standard_output_is_closed() noexcept { return output_was_closed; }

} // namespace fastrt::cli
