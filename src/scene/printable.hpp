// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace fastrt {

// The text with every control character as \xNN: a name out of a file may hold anything, a terminal must not
// obey it, and a message must stay one line.
std::string printable(const std::string& text);

} // namespace fastrt
