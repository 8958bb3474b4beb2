// SPDX-License-Identifier: Apache-2.0
// Numbers that a text is made of. All are false if it is something else; the value is then of no use.
#pragma once

#include <fastrt/math.hpp>

#include <string_view>

namespace fastrt::cli {

// A finite number.
bool read_number(std::string_view text, float& value);

// Three of them between commas.
bool read_vector(std::string_view text, Vec3& value);

// The same, each at least 0.
bool read_color(std::string_view text, Vec3& value);

} // namespace fastrt::cli
