// SPDX-License-Identifier: Apache-2.0
#include "src/cli/read_numbers.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

namespace fastrt::cli {

bool read_number(std::string_view text, float& value) {
  // from_chars knows no leading plus.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end && std::isfinite(value);
}

bool read_vector(std::string_view text, Vec3& value) {
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i == 2)) return false;
    if (!read_number(text.substr(0, comma), value[i])) return false;
    text = i == 2 ? std::string_view() : text.substr(comma + 1);
  }
  return true;
}

bool read_color(std::string_view text, Vec3& value) {
  return read_vector(text, value) && value.x >= 0 && value.y >= 0 && value.z >= 0;
}

} // namespace fastrt::cli
