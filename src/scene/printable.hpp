// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace fastrt {

// The text with every control character, and what is no UTF-8, as \xNN: a name out of a file may hold
// anything, a terminal must not obey it, and a message must stay one line that programs can read.
std::string printable(const std::string& text);

// The length of the well-formed UTF-8 sequence at `position`, or 0.
std::size_t utf8_length(const std::string& text, std::size_t position);

} // namespace fastrt
