// SPDX-License-Identifier: Apache-2.0
#include "src/load/obj_fill.hpp"

#include "src/load/number.hpp"
#include "src/load/text.hpp"

#include <array>

namespace fastrt {

void ObjFiller::fill(ChunkBuffer& buffer, const Chunk& chunk, const ObjState& start, const ObjCounts& counts,
                     bool with_care, ObjChunkResult& result) {
  text_ = buffer.begin();
  chunk_begin_ = chunk.begin;
  now_ = start;
  last_ = start.before;
  last_ += counts;
  result_ = &result;
  char* p = buffer.begin();
  while (p < buffer.end()) {
    if (is_line_end(*p) || (!with_care && is_blank(*p))) {
      ++p;
    } else if (with_care || !take_plain(p)) {
      if (!read_line(p, buffer.end())) return;
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

bool ObjFiller::take_plain(char*& p) {
  if (p[0] == 'v') return take_vertex(p, p);
  if (p[0] == 'f' && is_blank(p[1])) return take_face(p + 2, p);
  return false;
}

bool ObjFiller::take_numbers(const char*& p, std::span<float> numbers, std::size_t least,
                             std::size_t& count) const {
  const char* q = p;
  for (count = 0; count != numbers.size(); ++count) {
    while (is_blank(*q)) ++q;
    if (count >= least && is_line_end(*q)) break;
    if (!take_float(q, numbers[count])) return false;
    if (!is_blank(*q) && !is_line_end(*q)) return false;
  }
  while (is_blank(*q)) ++q;
  if (!is_line_end(*q)) return false;
  p = q;
  return true;
}

bool ObjFiller::take_vertex(const char* p, char*& next) {
  std::array<float, 3> numbers;
  std::size_t count = 0;
  const char* const start = p;
  if (is_blank(p[1])) {
    p += 2;
    if (!take_numbers(p, numbers, 3, count)) return false;
    put_position(numbers);
  } else if (p[1] == 'n' && is_blank(p[2])) {
    p += 3;
    if (!take_numbers(p, numbers, 3, count)) return false;
    if (numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0) return false;
    put_normal(numbers);
  } else if (p[1] == 't' && is_blank(p[2])) {
    p += 3;
    if (!take_numbers(p, numbers, 2, count)) return false;
    put_uv(numbers);
  } else {
    return false;
  }
  next += p - start;
  return true;
}

namespace {

// Takes "17" or "-3" at p as an index from 0. `so_far`: how many there are before this line.
bool take_reference(const char*& p, std::uint64_t total, std::uint64_t so_far, std::uint32_t& index) {
  const bool negative = *p == '-';
  if (negative) ++p;
  std::uint32_t value = 0;
  if (!take_index(p, value)) return false;
  index = negative ? static_cast<std::uint32_t>(so_far) - value : value - 1U;
  return index < (negative ? so_far : total);
}

} // namespace

bool ObjFiller::take_corner(const char*& p, Corner& corner) const {
  corner.t = corner.n = no_index;
  if (!take_reference(p, plan_.totals.positions, now_.before.positions, corner.v)) return false;
  if (*p != '/') return true;
  ++p;
  if (*p != '/') {
    if (!take_reference(p, plan_.totals.uvs, now_.before.uvs, corner.t)) return false;
    if (*p != '/') return true;
  }
  ++p;
  return take_reference(p, plan_.totals.normals, now_.before.normals, corner.n);
}

bool ObjFiller::take_face(const char* p, char*& next) {
  const char* const start = p;
  std::size_t count = 0;
  bool mixed = false;
  for (;;) {
    while (is_blank(*p)) ++p;
    if (is_line_end(*p)) break;
    if (count == max_face_corners) return false;
    if (count == corners_.size()) corners_.resize(2 * count + 16);
    Corner& corner = corners_[count];
    if (!take_corner(p, corner) || !(is_blank(*p) || is_line_end(*p))) return false;
    const Corner& first = corners_.front();
    mixed |=
        (corner.t == no_index) != (first.t == no_index) || (corner.n == no_index) != (first.n == no_index);
    ++count;
  }
  if (count < 3 || mixed) return false;
  put_face({corners_.data(), count});
  next += 2 + (p - start);
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
