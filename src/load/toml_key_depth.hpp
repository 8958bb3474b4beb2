// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace fastrt {

// Where in the text of a TOML file a key has more parts (a.b.c) than `most`; npos if nowhere. Text that is
// not TOML may be passed over: what is wrong with it is for the parser to say.
std::size_t find_deep_key(std::string_view text, int most);

} // namespace fastrt
