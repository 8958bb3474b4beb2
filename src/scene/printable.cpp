// SPDX-License-Identifier: Apache-2.0
#include "src/scene/printable.hpp"

#include <algorithm>

namespace fastrt {

std::size_t utf8_length(const std::string& text, std::size_t position) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned lead = byte(position);
  const unsigned next = byte(position + 1);
  const std::size_t length = lead < 0x80 ? 1 : lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  // Overlong forms, surrogates and what lies beyond U+10FFFF.
  if (lead > 0xF4 || (lead == 0xE0 && next < 0xA0) || (lead == 0xED && next > 0x9F) ||
      (lead == 0xF0 && next < 0x90) || (lead == 0xF4 && next > 0x8F)) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(position + i) & 0xC0U) != 0x80) return 0;
  return length;
}

std::string printable(const std::string& text) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string shown;
  shown.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length(text, i);
    const bool is_late_control =
        length == 2 && lead == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    const bool is_shown = length != 0 && lead >= 0x20 && lead != 0x7F && !is_late_control;
    for (const std::size_t end = i + std::max<std::size_t>(length, 1); i < end; ++i) {
      const auto byte = static_cast<unsigned char>(text[i]);
      if (is_shown)
        shown += text[i];
      else
        (shown += "\\x") += {digits[byte >> 4U], digits[byte & 15U]};
    }
  }
  return shown;
}

} // namespace fastrt
