// SPDX-License-Identifier: Apache-2.0
// Lines, words and names of scene files of all formats.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fastrt {

// The longest line, continuations included.
inline constexpr std::size_t max_line_bytes = std::size_t{1} << 20U;

// Where a text begins: behind the byte order mark that some editors write, or at 0.
inline std::size_t text_begin(std::string_view bytes) { return bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0; }

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }

// A statement's line in a buffer that ends with a line feed. Lines joined by `\` are one.
struct Line {
  char* begin;
  char* end;                      // at the line end, or at the buffer's end
  char* next;                     // the line after
  std::size_t line_ends = 0;      // how many of them were passed
  bool ends_in_backslash = false; // at the end of the buffer, where nothing follows
  std::string_view text() const { return {begin, static_cast<std::size_t>(end - begin)}; }
};

// Takes the line at `begin`; limit is the end of the text, at which a line feed stands. Joins lines by
// writing blanks over the `\` and the line end, so that offsets stay true. A comment is not continued: a path
// that ends in `\` must not swallow the next statement.
Line take_line(char* begin, char* limit);

// The words of a statement, one by one. A `#` at the start of a word begins a comment; one inside is part of
// the word ("1.#INF" is no number).
class Words {
public:
  explicit Words(std::string_view line) : line_(line) {}
  // The next word, empty when there is none.
  std::string_view next();
  // Where the last word began.
  std::size_t position() const { return position_; }
  // Everything behind the last word.
  std::string_view rest() const { return line_.substr(end_); }

private:
  std::string_view line_;
  std::size_t position_ = 0;
  std::size_t end_ = 0;
};

std::string_view trimmed(std::string_view text);

// The name in the rest of a line: trimmed, blanks inside kept. "Material #25" is a name; " # " begins a
// comment.
std::string_view name_in(std::string_view rest);

// 'text' for a message: short, and without control characters.
std::string in_quotes(std::string_view text);

std::string lower_case(std::string_view text);

} // namespace fastrt
