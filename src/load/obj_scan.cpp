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

bool ends_word(char c) { return is_blank(c) || is_line_end(c); }

// A line as far as it has been seen.
struct LineSoFar {
  char* begin;
  char* word = nullptr; // the first one
  std::size_t words = 0;
  bool marked = false;
};

class ObjScan {
public:
  ObjScan(ChunkBuffer& buffer, std::uint64_t chunk_begin)
      : begin_(buffer.begin()), end_(buffer.end()), chunk_begin_(chunk_begin) {}

  ObjSummary run() {
    ByteTraces traces;
    line_.begin = begin_;
    // The line feed behind the text ends the last line.
    for (char* block = begin_; block <= end_;) block = scan_block(block, masks_of(block, traces));
    if (_mm_movemask_epi8(traces.nuls) != 0) summary_.needs_care = true;
    summary_.has_slash = _mm_movemask_epi8(traces.slashes) != 0;
    note_faces_before(summary_.counts.objects, summary_.face_before_object);
    note_faces_before(summary_.counts.groups, summary_.face_before_group);
    if (last_material_.data() != nullptr) summary_.material.emplace(last_material_);
    return std::move(summary_);
  }

private:
  // Returns where the next block begins: 64 bytes on, or behind a line that was read some other way.
  char* scan_block(char* block, const ByteMasks& masks) {
    const std::uint64_t starts = ~masks.blanks & ((masks.blanks << 1U) | (after_blank_ ? 1U : 0U));
    after_blank_ = (masks.blanks >> 63U) != 0;
    LineSoFar line = line_;
    std::uint64_t left = ~std::uint64_t{0}; // of the block
    const auto add = [&](std::uint64_t part) {
      const std::uint64_t here = starts & part;
      if (line.word == nullptr && here != 0) line.word = block + std::countr_zero(here);
      line.words += count_bits(here);
      line.marked |= (masks.marks & part) != 0;
    };
    for (std::uint64_t ends = masks.line_ends; ends != 0; ends &= ends - 1) {
      char* const end = block + std::countr_zero(ends);
      add(left & (ends ^ (ends - 1)));
      if (line.word != nullptr && !count_plain(line, end)) return read_statement(line.begin);
      count_line_end(end);
      left &= ~(ends ^ (ends - 1));
      line = {end + 1};
    }
    add(left);
    line_ = line;
    return block + 64;
  }

  // False for what is not a plain vertex, face or comment.
  bool count_plain(const LineSoFar& line, const char* end) {
    if (end - line.begin > static_cast<std::ptrdiff_t>(max_line_bytes)) summary_.needs_care = true;
    const char* word = line.word;
    if (*word == '#') return true;
    if (line.marked) return false;
    if (*word == 'f' && ends_word(word[1])) {
      summary_.counts.triangles += line.words < 3 ? 0 : line.words - 3;
      return true;
    }
    if (*word != 'v') return false;
    const std::size_t length = ends_word(word[1]) ? 1 : 2;
    if (length == 1 || ends_word(word[2])) count_vertex({word, length});
    return true;
  }

  // A carriage return and a line feed are one; those behind the text are none.
  void count_line_end(const char* p) {
    if (p < end_ && !(p[0] == '\n' && p[-1] == '\r')) ++summary_.lines;
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
  LineSoFar line_{};
  bool after_blank_ = true; // whether the byte before the block is one
  std::string_view last_material_;
};

} // namespace

ObjSummary scan_obj(ChunkBuffer& buffer, std::uint64_t chunk_begin) {
  return ObjScan(buffer, chunk_begin).run();
}

} // namespace fastrt
