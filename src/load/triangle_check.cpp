// SPDX-License-Identifier: Apache-2.0
#include "src/load/triangle_check.hpp"

#include "src/load/text.hpp"

#include <algorithm>
#include <cmath>

namespace fastrt {

void TriangleCheck::run(std::uint64_t first, std::uint64_t last, bool drop_zero_normals,
                        ObjChunkResult& result) {
  findings_.clear();
  for (const Polygon& polygon : result.polygons) triangulate(polygon);
  for (std::uint64_t i = first; i < last; ++i) {
    if (drop_zero_normals) forget_zero_normals(i);
    if (!can_be_hit(i)) result.dropped.push_back(static_cast<std::uint32_t>(i));
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

// Tested with the very cross product that shading normalises later: 0 and overflow have no normal.
bool TriangleCheck::can_be_hit(std::size_t i) {
  const TriangleColumns& rows = desc_.triangles;
  const Vec3 a = desc_.positions[rows.v0[i]];
  const Vec3 b = desc_.positions[rows.v1[i]] - a, c = desc_.positions[rows.v2[i]] - a;
  const float x = b.y * c.z - c.y * b.z, y = b.z * c.x - c.z * b.x, z = b.x * c.y - c.x * b.y;
  const float size = std::abs(x) + std::abs(y) + std::abs(z);
  if (size > 0 && size < infinity) return true;
  if (size == 0)
    findings_.push_back({i, "degenerate face", "triangle without area skipped"});
  else
    findings_.push_back({i, "huge face", "triangle too large for single precision skipped"});
  return false;
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
