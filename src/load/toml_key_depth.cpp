// SPDX-License-Identifier: Apache-2.0
#include "src/load/toml_key_depth.hpp"

#include <algorithm>

namespace fastrt {
namespace {

bool belongs_to_key(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

// Behind a string of one line that begins at `at`.
std::size_t end_of_line_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote && text[at] != '\n'; ++at)
    if (quote == '"' && text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

// Behind a string of several lines, `"""` or `'''`. One or two more quotes at its end are its own.
std::size_t end_of_long_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view end = text.substr(at, 3);
  for (at += 3; at < text.size() && text.substr(at, 3) != end; ++at)
    if (quote == '"' && text[at] == '\\') ++at;
  at = std::min(at + 3, text.size());
  for (int more = 0; more < 2 && at < text.size() && text[at] == quote; ++more) ++at;
  return at;
}

std::size_t end_of_string(std::string_view text, std::size_t at) {
  const bool is_long = text.substr(at, 3) == "\"\"\"" || text.substr(at, 3) == "'''";
  return is_long ? end_of_long_string(text, at) : end_of_line_string(text, at);
}

} // namespace

// A point counts if it follows a part of a key, until something ends the key.
std::size_t find_deep_key(std::string_view text, int most) {
  int parts = 1;
  bool after_part = false;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
      after_part = true;
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '.' && after_part && ++parts > most) return at;
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') parts = 1;
    if (c != ' ' && c != '\t') after_part = belongs_to_key(c);
    ++at;
  }
  return std::string_view::npos;
}

} // namespace fastrt
