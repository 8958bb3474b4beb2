// SPDX-License-Identifier: Apache-2.0
#include "src/load/obj_fill.hpp"

#include "src/load/number.hpp"
#include "src/load/text.hpp"

#include <algorithm>
#include <array>

namespace fastrt {

void ObjFiller::fill(ChunkBuffer& buffer, const Chunk& chunk, const ObjState& start, const ObjCounts& counts,
                     bool with_care, ObjChunkResult& result) {
  text_ = buffer.begin();
  chunk_begin_ = chunk.begin;
  now_ = start;
  last_ = start.before;
  last_ += counts;
  totals_ = plan_.totals;
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
  const ObjCounts& done = now_.before;
  const bool complete = done.positions == last_.positions && done.normals == last_.normals &&
                        done.uvs == last_.uvs && done.triangles == last_.triangles;
  if (!complete) source_.fail_changed();
}

namespace {

// Takes `least` numbers or as many more as there is room for, and the blanks up to the line end.
template <std::size_t most>
[[gnu::always_inline]] inline bool take_numbers(const char*& p, std::size_t least,
                                                std::array<float, most>& numbers) {
  for (std::size_t count = 0; count != most; ++count) {
    while (is_blank(*p)) ++p;
    if (count >= least && is_line_end(*p)) break;
    if (!take_float(p, numbers[count])) return false;
    if (!is_blank(*p) && !is_line_end(*p)) return false;
  }
  while (is_blank(*p)) ++p;
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
  return is_blank(*p) || is_line_end(*p);
}

} // namespace

bool ObjFiller::take_plain(const char*& next) {
  const char* p = next;
  if (p[0] == 'f' && is_blank(p[1])) {
    p += 2;
    if (!take_face(p)) return false;
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

bool ObjFiller::take_face(const char*& p) {
  const ObjCounts so_far = now_.before;
  std::array<Corner, 4> corners;
  std::size_t count = 0;
  for (;; ++count) {
    while (is_blank(*p)) ++p;
    if (is_line_end(*p)) break;
    if (count == corners.size()) return take_polygon(p, corners);
    if (!take_corner(p, totals_, so_far, corners[count])) return false;
  }
  if (count < 3 || !match({corners.data(), count})) return false;
  put_face({corners.data(), count});
  return true;
}

// Goes on behind the fourth corner.
bool ObjFiller::take_polygon(const char*& p, std::span<const Corner> first) {
  corners_.assign(first.begin(), first.end());
  while (!is_line_end(*p)) {
    Corner corner;
    if (corners_.size() == max_face_corners || !take_corner(p, totals_, now_.before, corner)) return false;
    corners_.push_back(corner);
    while (is_blank(*p)) ++p;
  }
  if (!match(corners_)) return false;
  put_face(corners_);
  return true;
}

// Whether all corners have, or have not, texture coordinates and normals.
bool ObjFiller::match(std::span<const Corner> corners) {
  const auto differs = [&first = corners[0]](const Corner& corner) {
    return (corner.t == no_index) != (first.t == no_index) || (corner.n == no_index) != (first.n == no_index);
  };
  return std::none_of(corners.begin() + 1, corners.end(), differs);
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
    rows.material[i] = now_.material;
    rows.object[i] = now_.object;
    if (smoothing_ != nullptr) (*smoothing_)[i] = now_.smoothing;
  }
  now_.before.triangles = first + count;
  result_->uses_default_material |= now_.material == plan_.default_material;
  result_->uses_normals |= corners[0].n != no_index;
  result_->uses_uvs |= corners[0].t != no_index;
}

} // namespace fastrt
