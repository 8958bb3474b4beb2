// SPDX-License-Identifier: Apache-2.0
#include "src/load/nff_tokens.hpp"

#include "src/load/number.hpp"

#include <utility>

namespace fastrt {
namespace {

bool is_space(char c) { return is_blank(c) || is_line_end(c); }

} // namespace

std::size_t NffTokens::skip_blanks(std::size_t at) const {
  while (at != text_.size()) {
    if (text_[at] == '#') {
      while (at != text_.size() && !is_line_end(text_[at])) ++at;
    } else if (is_space(text_[at])) {
      ++at;
    } else {
      break;
    }
  }
  return at;
}

std::size_t NffTokens::end_of_word(std::size_t at) const {
  while (at != text_.size() && !is_space(text_[at]) && text_[at] != '#') ++at;
  return at;
}

std::string_view NffTokens::word() {
  offset_ = skip_blanks(end_);
  end_ = end_of_word(offset_);
  return text_.substr(offset_, end_ - offset_);
}

std::string_view NffTokens::peek() {
  const std::size_t begin = skip_blanks(end_);
  return text_.substr(begin, end_of_word(begin) - begin);
}

void NffTokens::skip_line() {
  while (end_ != text_.size() && !is_line_end(text_[end_])) ++end_;
}

bool NffTokens::is_number_next() {
  const std::string_view next = peek();
  return !next.empty() && parse_number(next).fault == NumberFault::none;
}

// A number as most are written; false, and nothing taken, for all else.
bool NffTokens::take_plain_number(float& value) {
  const std::size_t begin = skip_blanks(end_);
  const char* p = text_.data() + begin;
  if (!take_float(p, value)) return false;
  const auto end = static_cast<std::size_t>(p - text_.data());
  if (end_of_word(end) != end) return false;
  offset_ = begin;
  end_ = end;
  return true;
}

float NffTokens::number(const char* what) {
  float plain = 0.0F;
  if (take_plain_number(plain)) return plain;
  const std::string_view text = word();
  if (text.empty()) fail(std::string("the file ends within ") + in_quotes(what));
  const Number number = parse_number(text);
  if (number.fault != NumberFault::none)
    fail(std::string(what) + ": " + describe(number.fault) + " " + in_quotes(text));
  return number.value;
}

Vec3 NffTokens::vector(const char* what) {
  const float x = number(what);
  const float y = number(what);
  return {x, y, number(what)};
}

std::size_t NffTokens::count(const char* what, std::size_t least, std::size_t most) {
  const float value = number(what);
  const bool fits = value >= static_cast<float>(least) && value <= static_cast<float>(most) &&
                    value == static_cast<float>(static_cast<std::size_t>(value));
  if (!fits)
    fail(std::string(what) + ": " + in_quotes(text_.substr(offset_, end_ - offset_)) +
         " is not a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<std::size_t>(value);
}

void NffTokens::fail(std::string message) {
  log_.fail(offset_, std::move(message));
  throw NffFailure{};
}

} // namespace fastrt
