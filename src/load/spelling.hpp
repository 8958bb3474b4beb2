// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fastrt {

// "; did you mean 'color'?" with the name that is most like `word`, or "" if none is.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> names);

} // namespace fastrt
