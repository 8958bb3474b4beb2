// SPDX-License-Identifier: Apache-2.0
#include "src/load/obj_fill.hpp"

#include "src/load/number.hpp"
#include "src/load/text.hpp"

#include <array>

namespace fastrt {

namespace {

// The fast way knows no other blank than spaces.
[[gnu::always_inline]] inline const char* skip_spaces(const char* p) {
  while (*p == ' ') ++p;
  return p;
}

// Takes `least` numbers or as many more as there is room for, and the spaces up to the line end.
template <std::size_t most>
[[gnu::always_inline]] inline bool take_numbers(const char*& p, std::size_t least,
                                                std::array<float, most>& numbers) {
  const char* q = p;
  for (std::size_t count = 0; count != most; ++count) {
    q = skip_spaces(q);
    if (count >= least && is_line_end(*q)) break;
    if (!take_float(q, numbers[count])) return false;
    if (*q != ' ' && count + 1 < least) return false;
    if (*q != ' ' && !is_line_end(*q)) return false;
  }
  p = skip_spaces(q);
  return is_line_end(*p);
}

// Takes "17" or "-3" at p as an index from 0. `so_far`: how many there are before this line.
[[gnu::always_inline]] inline bool take_reference(const char*& p, std::uint64_t total, std::uint64_t so_far,
                                                  std::uint32_t& index) {
  std::uint32_t value = 0;
  if (*p != '-') {
    if (!take_index(p, value)) return false;
    index = value - 1U;
    return index < total;
  }
  ++p;
  if (!take_index(p, value)) return false;
  index = static_cast<std::uint32_t>(so_far) - value;
  return index < so_far;
}

// Takes v, v/t, v//n or v/t/n.
[[gnu::always_inline]] inline bool take_corner(const char*& p, const ObjCounts& totals,
                                               const ObjCounts& so_far, Corner& corner) {
  corner.t = corner.n = no_index;
  if (!take_reference(p, totals.positions, so_far.positions, corner.v)) return false;
  if (*p == '/') {
    ++p;
    if (*p != '/' && !take_reference(p, totals.uvs, so_far.uvs, corner.t)) return false;
    if (*p == '/') {
      ++p;
      if (!take_reference(p, totals.normals, so_far.normals, corner.n)) return false;
    }
  }
  return *p == ' ' || is_line_end(*p);
}

} // namespace

inline void ObjFiller::put_state(std::uint64_t i) {
  desc_.triangles.material[i] = now_.material;
  desc_.triangles.object[i] = now_.object;
  if (smoothing_ != nullptr) (*smoothing_)[i] = now_.smoothing;
}

// Three bare vertex indices that end the line, in a file whose faces have nothing else.
[[gnu::always_inline]] inline bool ObjFiller::take_bare_face(const char*& next) {
  const char* p = next;
  const std::uint64_t i = now_.before.triangles;
  std::array<std::uint32_t, 3> v;
  for (std::uint32_t& index : v) {
    p = skip_spaces(p);
    if (!take_reference(p, totals_.positions, now_.before.positions, index)) return false;
    if (*p != ' ' && !is_line_end(*p)) return false;
  }
  p = skip_spaces(p);
  if (!is_line_end(*p) || i == last_.triangles) return false;
  TriangleColumns& rows = desc_.triangles;
  rows.v0[i] = v[0], rows.v1[i] = v[1], rows.v2[i] = v[2];
  put_state(i);
  now_.before.triangles = i + 1;
  next = p;
  return true;
}

// Three corners that end the line, as most faces have.
bool ObjFiller::take_face(const char*& next) {
  const char* p = next;
  const ObjCounts so_far = now_.before;
  std::array<Corner, 3> corners;
  for (Corner& corner : corners) {
    p = skip_spaces(p);
    if (!take_corner(p, totals_, so_far, corner)) return false;
  }
  p = skip_spaces(p);
  next = p;
  if (!is_line_end(*p)) return take_polygon(next, corners);
  if (!match(corners)) return false;
  put_face(corners);
  return true;
}

// Goes on behind the third corner.
bool ObjFiller::take_polygon(const char*& p, std::span<const Corner> first) {
  corners_.assign(first.begin(), first.end());
  while (!is_line_end(*p)) {
    Corner corner;
    if (corners_.size() == max_face_corners || !take_corner(p, totals_, now_.before, corner)) return false;
    corners_.push_back(corner);
    p = skip_spaces(p);
  }
  if (!match(corners_)) return false;
  put_face(corners_);
  return true;
}

void ObjFiller::put_position(std::span<const float> numbers) {
  const std::uint64_t i = now_.before.positions;
  if (i == last_.positions) source_.fail_changed();
  desc_.positions.x[i] = numbers[0];
  desc_.positions.y[i] = numbers[1];
  desc_.positions.z[i] = numbers[2];
  now_.before.positions = i + 1;
}

void ObjFiller::put_normal(std::span<const float> numbers) {
  const std::uint64_t i = now_.before.normals;
  if (i == last_.normals) source_.fail_changed();
  desc_.normals.x[i] = numbers[0];
  desc_.normals.y[i] = numbers[1];
  desc_.normals.z[i] = numbers[2];
  now_.before.normals = i + 1;
}

void ObjFiller::put_uv(std::span<const float> numbers) {
  const std::uint64_t i = now_.before.uvs;
  if (i == last_.uvs) source_.fail_changed();
  desc_.uvs.x[i] = numbers[0];
  desc_.uvs.y[i] = numbers[1];
  now_.before.uvs = i + 1;
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
    put_state(i);
  }
  now_.before.triangles = first + count;
  result_->uses_normals |= corners[0].n != no_index;
  result_->uses_uvs |= corners[0].t != no_index;
}

[[gnu::always_inline]] inline bool ObjFiller::take_plain(const char*& next) {
  const char* p = next;
  if (p[0] == 'f' && is_blank(p[1])) {
    p += 2;
    if (!(bare_faces_ && take_bare_face(p)) && !take_face(p)) return false;
  } else if (p[0] == 'v' && is_blank(p[1])) {
    std::array<float, 3> numbers;
    p += 2;
    if (!take_numbers(p, 3, numbers)) return false;
    put_position(numbers);
  } else if (p[0] == 'v' && (p[1] == 'n' || p[1] == 't') && is_blank(p[2])) {
    std::array<float, 3> numbers{};
    const bool is_normal = p[1] == 'n';
    p += 3;
    if (!take_numbers(p, is_normal ? 3 : 2, numbers)) return false;
    if (is_normal && numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0) return false;
    if (is_normal)
      put_normal(numbers);
    else
      put_uv(numbers);
  } else {
    return false;
  }
  next = p;
  return true;
}

void ObjFiller::fill(ChunkBuffer& buffer, const Chunk& chunk, const ObjState& start, const ObjCounts& counts,
                     bool with_care, ObjChunkResult& result) {
  text_ = buffer.begin();
  chunk_begin_ = chunk.begin;
  now_ = start;
  last_ = start.before;
  last_ += counts;
  totals_ = plan_.totals;
  bare_faces_ = !plan_.has_normals && !plan_.has_uvs;
  material_since_ = start.before.triangles;
  result_ = &result;
  char* p = buffer.begin();
  while (p < buffer.end()) {
    if (is_line_end(*p) || (!with_care && is_blank(*p))) {
      ++p;
    } else if (const char* q = p; !with_care && take_plain(q)) {
      p += q - p;
    } else if (!read_line(p, buffer.end())) {
      return;
    }
  }
  if (chunk.torn) {
    result.log.fail(line_offset_, "line too long: more than 1 MiB with its continuations");
    return;
  }
  note_material();
  const ObjCounts& done = now_.before;
  const bool complete = done.positions == last_.positions && done.normals == last_.normals &&
                        done.uvs == last_.uvs && done.triangles == last_.triangles;
  if (!complete) source_.fail_changed();
}

} // namespace fastrt
