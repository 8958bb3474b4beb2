// SPDX-License-Identifier: Apache-2.0
#include "src/load/triangle_check.hpp"

#include "src/load/text.hpp"
#include "src/load/triangle_fault.hpp"

#include <emmintrin.h>

#include <algorithm>

namespace fastrt {

namespace {

inline __m128 load_position(const SceneDesc& desc, std::uint32_t v) {
  return _mm_setr_ps(desc.positions.x[v], desc.positions.y[v], desc.positions.z[v], 0.0F);
}

template <int lane>
inline __m128 from_lane(__m128 v) {
  return _mm_shuffle_ps(v, v, _MM_SHUFFLE(3, 3, 3, lane));
}

inline __m128 to_yzx(__m128 v) { return _mm_shuffle_ps(v, v, _MM_SHUFFLE(3, 0, 2, 1)); }

// |x| + |y| + |z| of the normal, as fault_of_triangle() computes it.
inline float normal_size(const SceneDesc& desc, std::size_t i) {
  const TriangleColumns& rows = desc.triangles;
  const __m128 a = load_position(desc, rows.v0[i]);
  const __m128 b = _mm_sub_ps(load_position(desc, rows.v1[i]), a);
  const __m128 c = _mm_sub_ps(load_position(desc, rows.v2[i]), a);
  const __m128 zxy = _mm_sub_ps(_mm_mul_ps(b, to_yzx(c)), _mm_mul_ps(c, to_yzx(b)));
  const __m128 sizes = _mm_andnot_ps(_mm_set1_ps(-0.0F), zxy);
  return _mm_cvtss_f32(_mm_add_ss(_mm_add_ss(from_lane<1>(sizes), from_lane<2>(sizes)), sizes));
}

} // namespace

void TriangleCheck::run(std::uint64_t first, std::uint64_t last, bool drop_zero_normals,
                        ObjChunkResult& result) {
  findings_.clear();
  for (const Polygon& polygon : result.polygons) triangulate(polygon);
  for (std::uint64_t i = first; i < last; ++i) {
    if (drop_zero_normals) forget_zero_normals(i);
    const float size = normal_size(desc_, i);
    if (!(size > 0 && size < modest_normal)) check(i, result);
  }
  std::stable_sort(findings_.begin(), findings_.end(),
                   [](const Finding& a, const Finding& b) { return a.triangle < b.triangle; });
  result.findings = findings_;
}

TriangleCheck::Row TriangleCheck::corner_of(const Polygon& polygon, std::size_t corner) const {
  const TriangleColumns& rows = desc_.triangles;
  const std::size_t i = polygon.first_triangle + (corner < 2 ? 0 : corner - 2);
  const auto row = [&](const auto& a, const auto& b, const auto& c) {
    if (a.empty()) return no_index;
    return corner == 0 ? a[i] : corner == 1 ? b[i] : c[i];
  };
  return {row(rows.v0, rows.v1, rows.v2), row(rows.n0, rows.n1, rows.n2), row(rows.t0, rows.t1, rows.t2)};
}

void TriangleCheck::put_row(std::size_t i, const std::array<Row, 3>& corners) {
  TriangleColumns& rows = desc_.triangles;
  const auto& [a, b, c] = corners;
  rows.v0[i] = a[0], rows.v1[i] = b[0], rows.v2[i] = c[0];
  if (!rows.n0.empty()) rows.n0[i] = a[1], rows.n1[i] = b[1], rows.n2[i] = c[1];
  if (!rows.t0.empty()) rows.t0[i] = a[2], rows.t1[i] = b[2], rows.t2[i] = c[2];
}

void TriangleCheck::triangulate(const Polygon& polygon) {
  corners_.clear();
  points_.clear();
  for (std::size_t k = 0; k < polygon.corners; ++k) {
    corners_.push_back(corner_of(polygon, k));
    points_.push_back(desc_.positions[corners_.back()[0]]);
  }
  const auto result = triangulator_.run(points_, triangles_);
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    const auto& [a, b, c] = triangles_[k];
    put_row(polygon.first_triangle + k, {corners_[a], corners_[b], corners_[c]});
  }
  if (result.tangled)
    findings_.push_back({polygon.first_triangle, "tangled polygon",
                         "the polygon crosses itself or has no area; it is split into a fan"});
  if (result.bent)
    findings_.push_back({polygon.first_triangle, "bent polygon", "the polygon is far from planar"});
}

// Drops the triangle if no ray can meet it.
void TriangleCheck::check(std::size_t i, ObjChunkResult& result) {
  const TriangleColumns& rows = desc_.triangles;
  const Columns3& at = desc_.positions;
  const TriangleFault fault = fault_of_triangle(at[rows.v0[i]], at[rows.v1[i]], at[rows.v2[i]]);
  if (fault == TriangleFault::none) return;
  findings_.push_back({i, kind_of(fault), message_of(fault)});
  result.dropped.push_back(static_cast<std::uint32_t>(i));
}

void TriangleCheck::forget_zero_normals(std::size_t i) {
  TriangleColumns& rows = desc_.triangles;
  if (rows.n0.empty()) return;
  for (auto* column : {&rows.n0, &rows.n1, &rows.n2}) {
    std::uint32_t& n = (*column)[i];
    if (n != no_index && desc_.normals[n] == Vec3(0.0F)) n = no_index;
  }
}

void report_findings(const Source& source, const Chunk& chunk, std::uint64_t first,
                     const std::vector<Finding>& findings, EventLog& log) {
  ChunkBuffer buffer;
  char* p = nullptr;
  std::uint64_t offset = chunk.begin, behind = first;
  for (const Finding& finding : findings) {
    if (log.keeps(finding.kind)) {
      if (p == nullptr) {
        buffer.read(source, chunk);
        p = buffer.begin();
      }
      while (p < buffer.end() && behind <= finding.triangle) {
        const Line line = take_line(p, buffer.end());
        p = line.next;
        Words words(line.text());
        if (words.next() != "f") continue;
        offset = chunk.begin + static_cast<std::uint64_t>(line.begin - buffer.begin()) + words.position();
        behind += triangles_in_face(words.rest());
      }
    }
    log.warn(offset, finding.kind, finding.message);
  }
}

void drop_rows(Column<std::uint32_t>& column, const std::vector<std::uint32_t>& dropped) {
  if (column.empty() || dropped.empty()) return;
  std::uint32_t* target = column.begin() + dropped.front();
  for (std::size_t k = 0; k < dropped.size(); ++k) {
    const std::uint32_t* from = column.begin() + dropped[k] + 1;
    const std::uint32_t* to = k + 1 < dropped.size() ? column.begin() + dropped[k + 1] : column.end();
    target = std::copy(from, to, target);
  }
  column.resize(column.size() - dropped.size());
}

} // namespace fastrt
