// SPDX-License-Identifier: Apache-2.0
// The third pass over an OBJ file: what needs all positions. Polygons become triangles for good, and
// triangles that can't be hit go.
#pragma once

#include "src/load/chunks.hpp"
#include "src/load/obj_plan.hpp"
#include "src/load/polygon.hpp"

#include <fastrt/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastrt {

// Works on the triangles of one chunk at a time. Keeps its memory from one to the next.
class TriangleCheck {
public:
  explicit TriangleCheck(SceneDesc& desc) : desc_(desc) {}

  // Checks the triangles first .. last of a chunk, adding to the result's findings and dropped triangles.
  // drop_zero_normals: corners whose normal is 0 lose it.
  void run(std::uint64_t first, std::uint64_t last, bool drop_zero_normals, ObjChunkResult& result);

private:
  using Row = std::array<std::uint32_t, 3>; // v, n, t of a corner

  void triangulate(const Polygon& polygon);
  Row corner_of(const Polygon& polygon, std::size_t corner) const;
  void put_row(std::size_t triangle, const std::array<Row, 3>& corners);
  void check(std::size_t triangle, ObjChunkResult& result);
  void forget_zero_normals(std::size_t triangle);

  SceneDesc& desc_;
  PolygonTriangulator triangulator_;
  std::vector<PolygonTriangulator::Triangle> triangles_;
  std::vector<Row> corners_;
  std::vector<Vec3> points_;
  std::vector<Finding> findings_;
};

// Puts the findings of the triangles from `first` on, which came from `chunk`, into the log, each with the
// place of its face: reads the chunk once more if some are to be kept.
void report_findings(const Source& source, const Chunk& chunk, std::uint64_t first,
                     const std::vector<Finding>& findings, EventLog& log);

// Removes these rows, ascending, from a column.
void drop_rows(Column<std::uint32_t>& column, const std::vector<std::uint32_t>& dropped);

} // namespace fastrt
