// SPDX-License-Identifier: Apache-2.0
#include "src/load/obj_scan.hpp"

#include "src/load/byte_masks.hpp"
#include "src/load/text.hpp"

#include <algorithm>
#include <bit>
#include <charconv>

namespace fastrt {

ObjCounts& ObjCounts::operator+=(const ObjCounts& other) {
  positions += other.positions, normals += other.normals, uvs += other.uvs;
  triangles += other.triangles, objects += other.objects, groups += other.groups;
  return *this;
}

std::optional<std::uint32_t> smoothing_group_in(std::string_view rest) {
  Words words(rest);
  const std::string_view word = words.next();
  if (word == "off") return 0;
  std::uint32_t group = 0;
  const auto parsed = std::from_chars(word.data(), word.data() + word.size(), group);
  if (word.empty() || parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size())
    return std::nullopt;
  return group;
}

std::size_t triangles_in_face(std::string_view rest) {
  Words words(rest);
  std::size_t corners = 0;
  while (!words.next().empty()) ++corners;
  return std::max<std::size_t>(corners, 2) - 2;
}

namespace {

// Without the instruction, which not every x86-64 has.
unsigned count_bits(std::uint64_t bits) {
  bits -= (bits >> 1U) & 0x5555555555555555U;
  bits = (bits & 0x3333333333333333U) + ((bits >> 2U) & 0x3333333333333333U);
  bits = (bits + (bits >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
  return static_cast<unsigned>((bits * 0x0101010101010101U) >> 56U);
}

enum class LineKind { blank, position, normal, uv, face, comment, other };

bool ends_word(char c) { return is_blank(c) || is_line_end(c); }

// Of a line whose first word is there.
[[gnu::always_inline]] inline LineKind kind_of(const char* word) {
  if (word[1] == ' ' && word[0] == 'f') return LineKind::face;
  if (word[1] == ' ' && word[0] == 'v') return LineKind::position;
  if (word[0] == 'f' && ends_word(word[1])) return LineKind::face;
  if (word[0] == '#') return LineKind::comment;
  if (word[0] != 'v') return LineKind::other;
  if (ends_word(word[1])) return LineKind::position;
  if (!ends_word(word[2])) return LineKind::other;
  return word[1] == 'n' ? LineKind::normal : word[1] == 't' ? LineKind::uv : LineKind::other;
}

// A line as far as it has been seen.
struct LineSoFar {
  char* begin;
  LineKind kind = LineKind::blank;
  std::size_t words = 0; // of a face
};

class ObjScan {
public:
  ObjScan(ChunkBuffer& buffer, std::uint64_t chunk_begin)
      : begin_(buffer.begin()), end_(buffer.end()), chunk_begin_(chunk_begin), line_{begin_} {}

  ObjSummary run() {
    ByteTraces traces;
    // The line feed behind the text ends the last line.
    for (char* block = begin_; block <= end_;) {
      const ByteMasks masks = masks_of(block, traces);
      block = masks.has_comment ? scan_block<true>(block, masks) : scan_block<false>(block, masks);
    }
    if (traces.has_nul()) summary_.needs_care = true;
    summary_.has_slash = traces.has_slash();
    note_faces_before(summary_.counts.objects, summary_.face_before_object);
    note_faces_before(summary_.counts.groups, summary_.face_before_group);
    if (last_material_.data() != nullptr) summary_.material.emplace(last_material_);
    return std::move(summary_);
  }

private:
  // Returns where the next block begins: 64 bytes on, or behind a line that was read some other way.
  template <bool has_comment>
  char* scan_block(char* block, const ByteMasks& masks) {
    const std::uint64_t starts = ~masks.blanks & ((masks.blanks << 1U) | (after_blank_ ? 1U : 0U));
    const std::uint64_t comments = has_comment ? comments_of(block) : 0;
    LineSoFar line = line_;
    // False for what is not a plain vertex, face or comment.
    const auto add = [&](std::uint64_t part) {
      const std::uint64_t words = starts & part;
      if (line.kind == LineKind::blank && words != 0) line.kind = kind_of(block + std::countr_zero(words));
      if (line.kind == LineKind::face) line.words += count_bits(words);
      return line.kind != LineKind::other &&
             (!has_comment || (comments & part) == 0 || line.kind == LineKind::comment);
    };
    std::uint64_t left = ~std::uint64_t{0}; // of the block
    for (std::uint64_t ends = masks.line_ends; ends != 0; ends &= ends - 1) {
      const std::uint64_t upto = ends ^ (ends - 1);
      char* const end = block + std::countr_zero(ends);
      if (!add(left & upto) || (end[-1] == '\\' && line.kind != LineKind::comment))
        return read_statement(line.begin);
      count_line(line, end);
      left &= ~upto;
      line = {end + 1};
    }
    if (!add(left)) return read_statement(line.begin);
    after_blank_ = (masks.blanks >> 63U) != 0;
    // With care, then, if it may be too long.
    if (block + 128 - line.begin > static_cast<std::ptrdiff_t>(max_line_bytes)) summary_.needs_care = true;
    line_ = line;
    return block + 64;
  }

  void count_line(const LineSoFar& line, const char* end) {
    ObjCounts& counts = summary_.counts;
    if (line.kind == LineKind::face)
      counts.triangles += line.words < 3 ? 0 : line.words - 3;
    else if (line.kind == LineKind::position)
      ++counts.positions;
    else if (line.kind == LineKind::normal)
      ++counts.normals;
    else if (line.kind == LineKind::uv)
      ++counts.uvs;
    // A carriage return and a line feed are one, and between them is a blank line; those behind the text are
    // none.
    const bool goes_on = line.kind == LineKind::blank && end[0] == '\n' && end[-1] == '\r';
    if (end < end_ && !goes_on) ++summary_.lines;
  }

  void count_vertex(std::string_view keyword) {
    ObjCounts& counts = summary_.counts;
    if (keyword.size() == 1)
      ++counts.positions;
    else if (keyword == "vn")
      ++counts.normals;
    else if (keyword == "vt")
      ++counts.uvs;
  }

  // To be called before the first of its kind, or at the end.
  void note_faces_before(std::uint64_t started, bool& face_before) const {
    if (started == 0) face_before = summary_.counts.triangles != 0;
  }

  // Reads the line there with its continuations. Returns the one after.
  char* read_statement(char* begin) {
    const Line line = take_line(begin, end_);
    if (line.end - line.begin > static_cast<std::ptrdiff_t>(max_line_bytes)) summary_.needs_care = true;
    summary_.lines += line.line_ends;
    Words words(line.text());
    const std::string_view keyword = words.next();
    const std::string_view rest = words.rest();
    if (keyword == "v" || keyword == "vn" || keyword == "vt") {
      count_vertex(keyword);
    } else if (keyword == "f") {
      summary_.counts.triangles += triangles_in_face(rest);
    } else if (keyword == "o") {
      note_faces_before(summary_.counts.objects++, summary_.face_before_object);
    } else if (keyword == "g") {
      note_faces_before(summary_.counts.groups++, summary_.face_before_group);
    } else if (keyword == "usemtl") {
      last_material_ = name_in(rest);
    } else if (keyword == "s") {
      summary_.smoothing = smoothing_group_in(rest).value_or(0);
      summary_.has_smoothing = summary_.has_smoothing || *summary_.smoothing != 0;
    } else if (keyword == "mtllib") {
      summary_.libraries.push_back(
          {chunk_begin_ + static_cast<std::uint64_t>(line.begin - begin_), std::string(name_in(rest))});
    }
    line_ = {line.next};
    after_blank_ = true;
    return line.next;
  }

  char* begin_;
  char* end_;
  std::uint64_t chunk_begin_;
  ObjSummary summary_;
  LineSoFar line_;
  bool after_blank_ = true; // whether the byte before the block is one
  std::string_view last_material_;
};

} // namespace

ObjSummary scan_obj(ChunkBuffer& buffer, std::uint64_t chunk_begin) {
  return ObjScan(buffer, chunk_begin).run();
}

} // namespace fastrt
