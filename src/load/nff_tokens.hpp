// SPDX-License-Identifier: Apache-2.0
// The words and numbers of an NFF file, wherever its lines end.
#pragma once

#include "src/load/event_log.hpp"
#include "src/load/text.hpp"

#include <fastrt/math.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace fastrt {

// What a failed read throws once it has been logged.
struct NffFailure {};

// Bytes past its end that a reader may look at.
inline constexpr std::size_t nff_padding = 16;

class NffTokens {
public:
  // After the text come `nff_padding` bytes that are 0. A byte order mark is passed over.
  NffTokens(std::string_view text, EventLog& log) : text_(text), log_(log), end_(text_begin(text)) {}

  // The next word; empty at the end of the file.
  std::string_view word();
  // The next word without taking it.
  std::string_view peek();
  void skip_line();
  // Where the last word that was taken begins.
  std::uint64_t offset() const { return offset_; }
  // Bytes that have not been read.
  std::size_t left() const { return text_.size() - end_; }

  // Numbers of the statement `what`. Log the fault and throw NffFailure if there is no finite one.
  float number(const char* what);
  Vec3 vector(const char* what);
  // A whole number from `least` to `most`.
  std::size_t count(const char* what, std::size_t least, std::size_t most);
  bool is_number_next();

  // About the last word that was taken.
  [[noreturn]] void fail(std::string message);

private:
  bool take_plain_number(float& value);
  std::size_t skip_blanks(std::size_t at) const;
  std::size_t end_of_word(std::size_t at) const;

  std::string_view text_;
  EventLog& log_;
  std::size_t offset_ = 0, end_;
};

} // namespace fastrt
