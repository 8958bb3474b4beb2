// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/number.hpp"
#include "src/load/ply_header.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace fastrt {

// Takes the values of a PLY file one after the other. The bytes have `padding` more behind them.
class PlyCursor {
public:
  static constexpr std::size_t padding = 16;

  PlyCursor(std::string_view bytes, std::size_t begin, PlyFormat format, const std::string& name)
      : begin_(bytes.data()), p_(begin_ + begin), end_(begin_ + bytes.size()), format_(format), name_(name),
        counted_(begin_) {}

  // All throw InputError where the file ends or holds something else.
  float number(PlyType type) { return format_ == PlyFormat::ascii ? text_number() : binary_number(type); }
  std::int64_t integer(PlyType type);
  void skip(PlyType type);
  // A property of one row: its value, or all of its list.
  void skip(const PlyProperty& property) {
    for (std::int64_t count = property.is_list ? list_length(property) : 1; count > 0; --count)
      skip(property.type);
  }
  // How many items a list has, before they are taken.
  std::int64_t list_length(const PlyProperty& property) {
    const char* place = p_;
    const std::int64_t count = integer(property.count_type);
    if (count < 0) fail_at(place, "a list of " + std::to_string(count) + " items");
    return count;
  }
  // So many bytes of binary data, at once.
  const char* take(std::uint64_t size);

  std::size_t left() const { return static_cast<std::size_t>(end_ - p_); }
  PlyFormat format() const { return format_; }
  const char* place() const { return p_; }
  // At `place`, or where the next value begins: by line and column, or by the byte in binary data.
  [[noreturn]] void fail(const std::string& message) {
    fail_at(format_ == PlyFormat::ascii ? word() : p_, message);
  }
  [[noreturn]] void fail_at(const char* place, const std::string& message) const;
  std::string place_of(const char* place) const; // for warnings: "file:line:column: "

  template <class T>
  static T load(const char* p, bool swap) {
    using Bits = std::conditional_t<
        sizeof(T) == 8, std::uint64_t,
        std::conditional_t<sizeof(T) == 4, std::uint32_t,
                           std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
    Bits bits;
    std::memcpy(&bits, p, sizeof bits);
    if (swap) {
      if constexpr (sizeof(T) == 8) bits = __builtin_bswap64(bits);
      if constexpr (sizeof(T) == 4) bits = __builtin_bswap32(bits);
      if constexpr (sizeof(T) == 2) bits = __builtin_bswap16(bits);
    }
    return std::bit_cast<T>(bits);
  }

  // Calls use(T()) with the C++ type of a PLY type.
  template <class Use>
  static auto with_type(PlyType type, const Use& use) {
    switch (type) {
    case PlyType::int8:
      return use(std::int8_t());
    case PlyType::uint8:
      return use(std::uint8_t());
    case PlyType::int16:
      return use(std::int16_t());
    case PlyType::uint16:
      return use(std::uint16_t());
    case PlyType::int32:
      return use(std::int32_t());
    case PlyType::uint32:
      return use(std::uint32_t());
    case PlyType::float32:
      return use(float());
    default:
      return use(double());
    }
  }

private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  // Where the next word of text begins.
  const char* word() {
    while (p_ != end_ && is_space(*p_)) ++p_;
    return p_;
  }
  bool ends_here(const char* p) const { return p >= end_ || is_space(*p); }
  float text_number();
  float careful_number();
  float binary_number(PlyType type) {
    const char* from = take(size_of(type));
    const bool swap = format_ == PlyFormat::big_endian;
    return with_type(type, [&]<class T>(T) { return static_cast<float>(load<T>(from, swap)); });
  }

  const char* begin_;
  const char* p_;
  const char* end_;
  PlyFormat format_;
  const std::string& name_;
  // Lines that end before counted_: places are mostly asked for one after the other.
  mutable const char* counted_;
  mutable std::size_t lines_ = 0;
};

} // namespace fastrt
