// SPDX-License-Identifier: Apache-2.0
#include "src/load/ply_cursor.hpp"

#include "src/load/text.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <charconv>

namespace fastrt {

namespace {

// Lines end with "\n", "\r\n" or "\r"; a "\r" at the end of the file ends none. There is a byte behind the
// last.
bool ends_line(const char* p, const char* end) {
  return (*p == '\n') | ((*p == '\r') & (p + 1 < end) & (p[1] != '\n'));
}

} // namespace

std::string PlyCursor::place_of(const char* place) const {
  if (format_ != PlyFormat::ascii) return name_ + ": byte " + std::to_string(place - begin_) + ": ";
  if (place < counted_) counted_ = begin_, lines_ = 0;
  for (; counted_ < place; ++counted_) lines_ += ends_line(counted_, end_) ? 1U : 0U;
  const char* start = place;
  while (start != begin_ && !ends_line(start - 1, end_)) --start;
  return name_ + ':' + std::to_string(lines_ + 1) + ':' + std::to_string(place - start + 1) + ": ";
}

void PlyCursor::fail_at(const char* place, const std::string& message) const {
  throw InputError(place_of(place) + message);
}

const char* PlyCursor::take(std::uint64_t size) {
  if (size > left()) fail("the file ends early");
  const char* from = p_;
  p_ += size;
  return from;
}

float PlyCursor::text_number() {
  word();
  const char* p = p_;
  float value = 0;
  if (p_ == end_ || !take_float(p, value) || !ends_here(p) || p > end_) return careful_number();
  p_ = p;
  return value;
}

float PlyCursor::careful_number() {
  if (p_ == end_) fail("the file ends early");
  const char* stop = std::find_if(p_, end_, is_space);
  const std::string_view text(p_, static_cast<std::size_t>(stop - p_));
  const Number number = parse_number(text);
  if (number.fault != NumberFault::none) fail(std::string(describe(number.fault)) + ' ' + in_quotes(text));
  p_ = stop;
  return number.value;
}

std::int64_t PlyCursor::integer(PlyType type) {
  if (format_ != PlyFormat::ascii) {
    const char* from = take(size_of(type));
    const bool swap = format_ == PlyFormat::big_endian;
    return with_type(type, [&]<class T>(T) {
      // Floats as indices are odd; those that hold no index become one that is out of range.
      const T value = load<T>(from, swap);
      if constexpr (std::is_floating_point_v<T>)
        return value >= T(-1) && value <= T(2147483648.0) ? static_cast<std::int64_t>(value)
                                                          : std::int64_t{-2};
      else
        return static_cast<std::int64_t>(value);
    });
  }
  word();
  if (p_ == end_) fail("the file ends early");
  const char* p = p_;
  std::uint32_t small = 0;
  if (take_index(p, small) && p <= end_ && ends_here(p)) {
    p_ = p;
    return small;
  }
  const char* stop = std::find_if(p_, end_, is_space);
  const std::string_view text(p_, static_cast<std::size_t>(stop - p_));
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(p_, stop, value);
  if (error != std::errc() || end != stop) fail(in_quotes(text) + " is no integer");
  p_ = stop;
  return value;
}

void PlyCursor::skip(PlyType type) {
  if (format_ != PlyFormat::ascii) {
    take(size_of(type));
    return;
  }
  word();
  if (p_ == end_) fail("the file ends early");
  p_ = std::find_if(p_, end_, is_space);
}

} // namespace fastrt
