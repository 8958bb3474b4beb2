// SPDX-License-Identifier: Apache-2.0
#include "src/load/obj_fill.hpp"

#include "src/load/marked_text.hpp"
#include "src/load/polygon.hpp"

#include <array>
#include <cstring>

namespace fastrt {

namespace {

// Takes `least` numbers or as many more as there is room for, up to the line end. Returns how many; 0 if it
// can't.
template <std::size_t least, std::size_t most>
[[gnu::always_inline]] inline std::size_t take_numbers(MarkedText& p, std::array<float, most>& numbers) {
  if (p.length() == 0) skip_spaces(p);
  if (p.at_line_end()) return 0;
  std::size_t count = take_pointed_numbers<least>(p, numbers.data()) ? least : 0;
  if (count == least && p.mark() == '\n') return least;
  for (skip_spaces(p); !p.at_line_end(); skip_spaces(p)) {
    if (count == most || !take_number(p, numbers[count])) return 0;
    ++count;
  }
  return count >= least ? count : 0;
}

[[gnu::always_inline]] inline std::array<std::uint32_t, 3> first_three(__m128i lanes) {
  std::array<std::uint32_t, 4> all;
  std::memcpy(all.data(), &lanes, sizeof all);
  return {all[0], all[1], all[2]};
}

// How many of what the three numbers of a corner count there are.
inline __m128i corner_totals(const ObjCounts& totals) {
  const auto signed_of = [](std::uint64_t total) { return static_cast<int>(total); };
  return _mm_set_epi32(0, signed_of(totals.normals), signed_of(totals.uvs), signed_of(totals.positions));
}

// Takes v/t/n or v//n behind one space, and goes to the space or line end behind it. False, and p where it
// was, for other corners.
[[gnu::always_inline]] inline bool take_whole_corner(MarkedText& p, __m128i most, Corner& corner) {
  if (p.mark() != ' ' || p.text[p.at[1]] != '/' || p.text[p.at[2]] != '/') return false;
  const MarkedText behind{p.text, p.at + 3};
  __m128i indices;
  if (!take_three_indices<true>(p, most, indices) || !behind.at_space_or_end()) return false;
  const auto [v, t, n] = first_three(indices);
  corner = {v, t, n};
  p = behind;
  return true;
}

// Takes an index behind a slash as take_reference does; where none stands there it stays no_index.
[[gnu::always_inline]] inline bool take_optional(MarkedText& p, std::uint64_t total, std::uint64_t so_far,
                                                 std::uint32_t& index) {
  if (p.length() != 0) return take_reference(p, total, so_far, index);
  ++p.at;
  return true;
}

// Takes v, v/t, v//n or v/t/n behind spaces, also with a slash and nothing behind it, and goes to the space
// or line end behind it.
[[gnu::always_inline]] inline bool take_corner(MarkedText& p, const ObjCounts& totals,
                                               const ObjCounts& so_far, Corner& corner) {
  skip_spaces(p);
  if (p.at_line_end()) return false;
  corner.t = corner.n = no_index;
  if (!take_reference(p, totals.positions, so_far.positions, corner.v)) return false;
  if (p.mark() == '/' && !take_optional(p, totals.uvs, so_far.uvs, corner.t)) return false;
  if (p.mark() == '/' && !take_optional(p, totals.normals, so_far.normals, corner.n)) return false;
  return p.at_space_or_end();
}

} // namespace

// Three bare vertex indices behind one space each, in a file whose faces have nothing else.
[[gnu::always_inline]] inline bool ObjFiller::take_bare_face(MarkedText& next) {
  MarkedText p = next;
  const std::uint64_t i = now_.before.triangles;
  const __m128i most = _mm_set1_epi32(static_cast<int>(totals_.positions));
  __m128i indices;
  if (p.text[p.at[1]] != ' ' || p.text[p.at[2]] != ' ' || i == last_.triangles) return false;
  if (!take_three_indices<false>(p, most, indices)) return false;
  p.at += 3;
  if (p.mark() != '\n') skip_spaces(p);
  if (!p.at_line_end()) return false;
  TriangleColumns& rows = desc_.triangles;
  const auto [a, b, c] = first_three(indices);
  rows.v0[i] = a, rows.v1[i] = b, rows.v2[i] = c;
  now_.before.triangles = i + 1;
  next = p;
  return true;
}

// Three corners that end the line, as most faces have.
bool ObjFiller::take_face(MarkedText& p) {
  const ObjCounts so_far = now_.before;
  const __m128i most = corner_totals(totals_);
  std::array<Corner, 3> corners;
  for (Corner& corner : corners)
    if (!take_whole_corner(p, most, corner) && !take_corner(p, totals_, so_far, corner)) return false;
  skip_spaces(p);
  if (!p.at_line_end()) return take_polygon(p, corners);
  if (!match(corners)) return false;
  put_face(corners);
  return true;
}

// The same where `p` had better stay in registers.
[[gnu::always_inline]] inline bool ObjFiller::take_any_face(MarkedText& p) {
  MarkedText copy = p;
  if (!take_face(copy)) return false;
  p = copy;
  return true;
}

// Goes on behind the third corner.
bool ObjFiller::take_polygon(MarkedText& p, std::span<const Corner> first) {
  corners_.assign(first.begin(), first.end());
  const __m128i most = corner_totals(totals_);
  while (!p.at_line_end()) {
    Corner corner;
    if (corners_.size() == max_face_corners) return false;
    if (!take_whole_corner(p, most, corner) && !take_corner(p, totals_, now_.before, corner)) return false;
    corners_.push_back(corner);
    skip_spaces(p);
  }
  if (!match(corners_)) return false;
  put_face(corners_);
  return true;
}

// As a fan for now: its corners are those of the first triangle and then the last one of each.
void ObjFiller::put_face(std::span<const Corner> corners) {
  const std::uint64_t first = now_.before.triangles;
  const std::size_t count = corners.size() - 2;
  if (count > last_.triangles - first) source_.fail_changed();
  if (count > 1)
    result_->polygons.push_back(
        {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(corners.size())});
  TriangleColumns& rows = desc_.triangles;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t i = first + k;
    const Corner &a = corners[0], &b = corners[k + 1], &c = corners[k + 2];
    rows.v0[i] = a.v, rows.v1[i] = b.v, rows.v2[i] = c.v;
    if (plan_.has_normals) rows.n0[i] = a.n, rows.n1[i] = b.n, rows.n2[i] = c.n;
    if (plan_.has_uvs) rows.t0[i] = a.t, rows.t1[i] = b.t, rows.t2[i] = c.t;
  }
  now_.before.triangles = first + count;
  result_->uses_normals |= corners[0].n != no_index;
  result_->uses_uvs |= corners[0].t != no_index;
}

// The line at `line`, whose first mark is at p. Goes to its end.
[[gnu::always_inline]] inline bool ObjFiller::take_plain(const char* line, MarkedText& p) {
  const std::ptrdiff_t length = p.place() - line; // of the keyword, if it is one
  if (p.mark() != ' ' && !is_blank(p.mark())) return false;
  if (length == 1 && line[0] == 'f') return (bare_faces_ && take_bare_face(p)) || take_any_face(p);
  if (line[0] != 'v') return false;
  if (length == 1) {
    std::array<float, 8> numbers; // weight and colours too
    const std::size_t count = take_numbers<3>(p, numbers);
    if (count > 4) return put_colored(numbers, count);
    if (count == 0) return false;
    put_position(numbers);
    return true;
  }
  const bool is_normal = line[1] == 'n';
  if (length != 2 || (!is_normal && line[1] != 't')) return false;
  std::array<float, 3> numbers{};
  if ((is_normal ? take_numbers<3>(p, numbers) : take_numbers<2>(p, numbers)) == 0) return false;
  if (!is_normal)
    put_uv(numbers);
  else if (numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0)
    return false;
  else
    put_normal(numbers);
  return true;
}

// Takes the lines from p on whose ends are among the marks; one at least. False after an error.
bool ObjFiller::take_lines(char*& next, char* limit) {
  char* const text = next;
  marks_.find(text, limit + 1); // a line feed stands there
  const std::uint16_t* last = marks_.end();
  while (last != marks_.begin() && !is_line_end(text[last[-1]])) --last;
  if (last == marks_.begin()) return read_line(next, limit);
  char* const behind = text + last[-1] + 1;
  MarkedText p{text, marks_.begin()};
  for (char* line = text; line < behind;) {
    if (p.place() == line && (p.at_line_end() || is_blank(p.mark()))) {
      ++line, ++p.at;
    } else if (MarkedText end = p; take_plain(line, end)) {
      line = text + end.at[0] + 1;
      p.at = end.at + 1;
    } else {
      if (!read_line(line, limit)) return false;
      while (p.at != marks_.end() && p.place() < line) ++p.at;
    }
    next = line;
  }
  return true;
}

void ObjFiller::fill(ChunkBuffer& buffer, const Chunk& chunk, const ObjState& start, const ObjCounts& counts,
                     bool with_care, ObjChunkResult& result) {
  text_ = buffer.begin();
  chunk_begin_ = chunk.begin;
  first_position_ = start.before.positions;
  now_ = start;
  last_ = start.before;
  last_ += counts;
  totals_ = plan_.totals;
  bare_faces_ = !plan_.has_normals && !plan_.has_uvs;
  state_since_ = start.before.triangles;
  result_ = &result;
  for (char* p = buffer.begin(); p < buffer.end();)
    if (!(with_care ? read_line(p, buffer.end()) : take_lines(p, buffer.end()))) return;
  if (chunk.torn) {
    result.log.fail(line_offset_, "line too long: more than 1 MiB with its continuations");
    return;
  }
  put_state();
  const ObjCounts& done = now_.before;
  const bool complete = done.positions == last_.positions && done.normals == last_.normals &&
                        done.uvs == last_.uvs && done.triangles == last_.triangles;
  if (!complete) source_.fail_changed();
}

} // namespace fastrt
