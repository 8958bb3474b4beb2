// SPDX-License-Identifier: Apache-2.0
#include "src/load/text.hpp"

#include "src/scene/printable.hpp"

#include <algorithm>
#include <cstring>

namespace fastrt {

namespace {

bool has_comment(const char* begin, const char* end) {
  for (const char* p = begin; p != end; ++p) {
    p = static_cast<const char*>(std::memchr(p, '#', static_cast<std::size_t>(end - p)));
    if (p == nullptr) return false;
    if (p == begin || is_blank(p[-1])) return true;
  }
  return false;
}

char* find_line_end(char* begin, char* limit) {
  auto* feed = static_cast<char*>(std::memchr(begin, '\n', static_cast<std::size_t>(limit - begin)));
  if (feed == nullptr) feed = limit;
  auto* carriage = static_cast<char*>(std::memchr(begin, '\r', static_cast<std::size_t>(feed - begin)));
  return carriage == nullptr ? feed : carriage;
}

} // namespace

Line take_line(char* begin, char* limit) {
  char* part = begin;
  for (std::size_t line_ends = 0;;) {
    char* end = find_line_end(part, limit);
    const bool at_limit = end == limit;
    char* next = at_limit ? limit : end + (end[0] == '\r' && end + 1 != limit && end[1] == '\n' ? 2 : 1);
    line_ends += at_limit ? 0 : 1;
    const bool marked = end != part && end[-1] == '\\' && !has_comment(part, end);
    if (!marked) return {begin, end, next, line_ends};
    end[-1] = ' ';
    if (next == limit) return {begin, end, next, line_ends, true};
    std::fill(end, next, ' ');
    part = next;
  }
}

std::string_view Words::next() {
  std::size_t begin = end_;
  while (begin != line_.size() && is_blank(line_[begin])) ++begin;
  position_ = begin;
  end_ = begin;
  if (begin == line_.size() || line_[begin] == '#') {
    end_ = line_.size();
    return {};
  }
  while (end_ != line_.size() && !is_blank(line_[end_])) ++end_;
  return line_.substr(begin, end_ - begin);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view name_in(std::string_view rest) {
  for (std::size_t i = rest.find('#'); i != std::string_view::npos; i = rest.find('#', i + 1)) {
    const bool after_blank = i == 0 || is_blank(rest[i - 1]);
    const bool before_blank = i + 1 == rest.size() || is_blank(rest[i + 1]);
    if (after_blank && before_blank) return trimmed(rest.substr(0, i));
  }
  return trimmed(rest);
}

std::string in_quotes(std::string_view text) {
  std::size_t most = 80;
  const auto goes_on = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80; };
  while (most > 77 && text.size() > most && goes_on(most)) --most; // no part of a character
  std::string shown(1, '\'');
  shown += printable(std::string(text.substr(0, most)));
  shown += text.size() > most ? "...'" : "'";
  return shown;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

} // namespace fastrt
