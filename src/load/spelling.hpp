// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fastrt {

// The name that is most like `word`, or "" if none is.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> names);

// "; did you mean 'color'?" with that name, or "".
std::string did_you_mean(std::string_view word, std::span<const std::string_view> names);

} // namespace fastrt
