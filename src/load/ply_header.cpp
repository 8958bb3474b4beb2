// SPDX-License-Identifier: Apache-2.0
#include "src/load/ply_header.hpp"

#include "src/load/text.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <charconv>
#include <utility>

namespace fastrt {

namespace {

constexpr std::size_t most_lines = 100000;
constexpr std::size_t most_elements = 1024;

class HeaderParser {
public:
  HeaderParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  PlyHeader run() {
    if (take_line() != "ply") fail(0, "this is no PLY file: it does not begin with 'ply'");
    for (;;) {
      if (at_ == bytes_.size() || line_number_ > most_lines) fail(0, "the header has no 'end_header'");
      line_ = take_line();
      Words words(line_);
      const std::string_view keyword = words.next();
      if (keyword == "end_header") break;
      read(keyword, words);
    }
    if (!has_format_) fail(0, "the header has no 'format'");
    header_.size = at_;
    return std::move(header_);
  }

private:
  [[noreturn]] void fail(std::size_t column, const std::string& message) const {
    throw InputError(name_, line_number_, column + 1, message);
  }

  // Lines end with LF, CR LF or CR.
  std::string_view take_line() {
    ++line_number_;
    const std::size_t end = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
    const std::string_view line = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    if (end < bytes_.size() && bytes_[end] == '\r' && at_ < bytes_.size() && bytes_[at_] == '\n') ++at_;
    if (line.size() > max_line_bytes) fail(0, "line too long: more than 1 MiB");
    return line;
  }

  void read(std::string_view keyword, Words& words) {
    if (keyword.empty() || keyword == "obj_info") return;
    if (keyword == "comment") return read_comment(words);
    if (keyword == "format") return read_format(words);
    if (keyword == "element") return read_element(words);
    if (keyword == "property") return read_property(words);
    fail(words.position(), "unknown keyword " + in_quotes(keyword) + " in the header");
  }

  Place place_of(std::string_view word) const {
    return {line_number_, static_cast<std::size_t>(word.data() - line_.data()) + 1};
  }

  void read_comment(Words& words) {
    if (words.next() != "TextureFile") return;
    const std::string_view name = trimmed(words.rest());
    if (!name.empty()) header_.textures.push_back({std::string(name), place_of(name)});
  }

  void read_format(Words& words) {
    const std::string_view format = words.next();
    if (format == "ascii")
      header_.format = PlyFormat::ascii;
    else if (format == "binary_little_endian")
      header_.format = PlyFormat::little_endian;
    else if (format == "binary_big_endian")
      header_.format = PlyFormat::big_endian;
    else
      fail(words.position(), in_quotes(format) + " is not ascii, binary_little_endian or binary_big_endian");
    const std::string_view version = words.next();
    if (version != "1.0") fail(words.position(), "version " + in_quotes(version) + " is not 1.0");
    has_format_ = true;
  }

  void read_element(Words& words) {
    PlyElement element;
    element.name = std::string(words.next());
    if (element.name.empty()) fail(words.position(), "an element without a name");
    const std::string_view count = words.next();
    const char* end = count.data() + count.size();
    const auto [stop, error] = std::from_chars(count.data(), end, element.count);
    if (error != std::errc() || stop != end)
      fail(words.position(), in_quotes(count) + " is no number of elements");
    if (header_.elements.size() == most_elements)
      fail(0, "the header has more than " + std::to_string(most_elements) + " elements");
    for (const PlyElement& other : header_.elements)
      if (other.name == element.name) fail(words.position(), "element " + in_quotes(element.name) + " twice");
    header_.elements.push_back(std::move(element));
  }

  PlyType take_type(Words& words) {
    static constexpr std::pair<std::string_view, PlyType> types[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    const std::string_view word = words.next();
    for (const auto& [name, type] : types)
      if (name == word) return type;
    fail(words.position(), in_quotes(word) + " is no type");
  }

  void read_property(Words& words) {
    if (header_.elements.empty()) fail(words.position(), "a property before the first element");
    PlyProperty property;
    Words ahead = words;
    if (ahead.next() == "list") {
      words = ahead;
      property.is_list = true;
      property.count_type = take_type(words);
      if (!is_integer(property.count_type)) fail(words.position(), "a list's length must be an integer");
    }
    property.type = take_type(words);
    const std::string_view name = words.next();
    property.name = std::string(name);
    property.place = place_of(name);
    if (property.name.empty()) fail(words.position(), "a property without a name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  std::string_view bytes_;
  const std::string& name_;
  PlyHeader header_;
  std::string_view line_;
  std::size_t at_ = text_begin(bytes_);
  std::size_t line_number_ = 0;
  bool has_format_ = false;
};

} // namespace

PlyHeader parse_ply_header(std::string_view bytes, const std::string& name) {
  return HeaderParser(bytes, name).run();
}

} // namespace fastrt
