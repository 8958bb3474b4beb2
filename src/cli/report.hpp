// SPDX-License-Identifier: Apache-2.0
// What the program says, besides the picture.
#pragma once

#include <string_view>

namespace fastrt::cli {

// One line on stderr: "fastrt: error: ...", "fastrt: warning: ..." or "fastrt: note: ...".
void print_error(std::string_view message);
void print_warning(std::string_view message);
void print_note(std::string_view message);

// Prints to stdout; throws OutputError if it can't take the text.
void print_out(std::string_view text);

} // namespace fastrt::cli
