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

constexpr std::uint64_t bits_from(unsigned position) { return ~std::uint64_t{0} << position; }

class ObjScan {
public:
  ObjScan(ChunkBuffer& buffer, std::uint64_t chunk_begin)
      : begin_(buffer.begin()), end_(buffer.end()), chunk_begin_(chunk_begin) {}

  ObjSummary run() {
    __m128i nuls = _mm_setzero_si128();
    line_ = begin_;
    char* block = begin_;
    // One turn more than the text needs: the line feeds behind it end the last line.
    while (block < end_ + 1) {
      const ByteMasks masks = masks_of(block, nuls);
      char* next = scan_block(block, masks);
      block = next;
    }
    if (_mm_movemask_epi8(nuls) != 0) summary_.needs_care = true;
    if (last_material_ != nullptr)
      summary_.material.emplace(last_material_,
                                static_cast<std::size_t>(last_material_end_ - last_material_));
    return std::move(summary_);
  }

private:
  // Returns where the next block begins: 64 bytes on, or behind a line that was read some other way.
  char* scan_block(char* block, const ByteMasks& masks) {
    const std::uint64_t starts = ~masks.blanks & ((masks.blanks << 1U) | (after_blank_ ? 1U : 0U));
    after_blank_ = (masks.blanks >> 63U) != 0;
    unsigned from = 0;
    for (std::uint64_t ends = masks.line_ends; ends != 0; ends &= ends - 1) {
      const auto at = static_cast<unsigned>(std::countr_zero(ends));
      const std::uint64_t part = bits_from(from) & ~bits_from(at);
      add_part(block, starts & part, (masks.marks & part) != 0, (masks.slashes & part) != 0);
      if (word_ != nullptr) {
        if (char* next = end_line(block + at)) return next;
      }
      start_line(block + at + 1);
      from = at + 1;
      if (from == 64) return block + 64;
    }
    const std::uint64_t part = bits_from(from);
    add_part(block, starts & part, (masks.marks & part) != 0, (masks.slashes & part) != 0);
    return block + 64;
  }

  void add_part(char* block, std::uint64_t starts, bool marked, bool slashed) {
    if (word_ == nullptr && starts != 0) word_ = block + std::countr_zero(starts);
    for (; starts != 0; starts &= starts - 1) ++words_;
    marked_ = marked_ || marked;
    slashed_ = slashed_ || slashed;
  }

  void start_line(char* line) {
    line_ = line;
    word_ = nullptr;
    words_ = 0;
    marked_ = slashed_ = false;
  }

  // Null, or where to go on if the line was longer than it seemed.
  char* end_line(char* end) {
    if (end - line_ > static_cast<std::ptrdiff_t>(max_line_bytes)) summary_.needs_care = true;
    if (*word_ == '#') return nullptr;
    if (marked_) return read_statement();
    if (*word_ == 'v') {
      const std::size_t length = is_blank(word_[1]) || is_line_end(word_[1]) ? 1 : 2;
      if (length == 1 || is_blank(word_[2]) || is_line_end(word_[2])) count_vertex({word_, length});
    } else if (*word_ == 'f' && (is_blank(word_[1]) || word_ + 1 == end)) {
      count_face(words_ < 3 ? 0 : words_ - 3);
    } else {
      return read_statement();
    }
    return nullptr;
  }

  void count_vertex(std::string_view keyword) {
    if (keyword == "v") ++summary_.counts.positions;
    if (keyword == "vn") ++summary_.counts.normals;
    if (keyword == "vt") ++summary_.counts.uvs;
  }

  void count_face(std::size_t triangles) {
    summary_.counts.triangles += triangles;
    summary_.has_slash = summary_.has_slash || slashed_;
    summary_.face_before_object = summary_.face_before_object || summary_.counts.objects == 0;
    summary_.face_before_group = summary_.face_before_group || summary_.counts.groups == 0;
  }

  char* read_statement() {
    const Line line = take_line(line_, end_);
    if (line.end - line.begin > static_cast<std::ptrdiff_t>(max_line_bytes)) summary_.needs_care = true;
    Words words(line.text());
    const std::string_view keyword = words.next();
    const std::string_view rest = words.rest();
    if (keyword.starts_with('v')) {
      count_vertex(keyword);
    } else if (keyword == "f") {
      slashed_ = rest.find('/') != std::string_view::npos;
      count_face(triangles_in_face(rest));
    } else if (keyword == "o") {
      ++summary_.counts.objects;
    } else if (keyword == "g") {
      ++summary_.counts.groups;
    } else if (keyword == "usemtl") {
      const std::string_view name = name_in(rest);
      last_material_ = name.data();
      last_material_end_ = name.data() + name.size();
    } else if (keyword == "s") {
      summary_.smoothing = smoothing_group_in(rest).value_or(0);
      summary_.has_smoothing = summary_.has_smoothing || *summary_.smoothing != 0;
    } else if (keyword == "mtllib") {
      summary_.libraries.push_back(
          {chunk_begin_ + static_cast<std::uint64_t>(line.begin - begin_), std::string(name_in(rest))});
    }
    start_line(line.next);
    after_blank_ = true;
    return line.next;
  }

  char* begin_;
  char* end_;
  std::uint64_t chunk_begin_;
  ObjSummary summary_;
  // The line so far.
  char* line_ = nullptr;
  char* word_ = nullptr; // its first word
  std::size_t words_ = 0;
  bool marked_ = false, slashed_ = false;
  bool after_blank_ = true; // whether the byte before the block is one
  const char* last_material_ = nullptr;
  const char* last_material_end_ = nullptr;
};

} // namespace

ObjSummary scan_obj(ChunkBuffer& buffer, std::uint64_t chunk_begin) {
  return ObjScan(buffer, chunk_begin).run();
}

} // namespace fastrt
