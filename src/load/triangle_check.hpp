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
  TriangleCheck(const Source& source, SceneDesc& desc) : source_(source), desc_(desc) {}

  // Checks the triangles first .. last, which came from `chunk`. Those to be dropped are marked by v0 =
  // no_index; returns how many. drop_zero_normals: corners whose normal is 0 lose it.
  std::size_t run(const Chunk& chunk, std::uint64_t first, std::uint64_t last, bool drop_zero_normals,
                  ObjChunkResult& result);

private:
  struct Finding {
    std::uint64_t triangle;
    const char* kind;
    const char* message;
  };
  using Row = std::array<std::uint32_t, 3>; // v, n, t of a corner

  void triangulate(const Polygon& polygon);
  Row corner_of(const Polygon& polygon, std::size_t corner) const;
  void put_row(std::size_t triangle, const std::array<Row, 3>& corners);
  bool can_be_hit(std::size_t triangle);
  void forget_zero_normals(std::size_t triangle);
  void report(const Chunk& chunk, std::uint64_t first, EventLog& log);

  const Source& source_;
  SceneDesc& desc_;
  PolygonTriangulator triangulator_;
  std::vector<PolygonTriangulator::Triangle> triangles_;
  std::vector<Row> corners_;
  std::vector<Vec3> points_;
  std::vector<Finding> findings_;
  ChunkBuffer buffer_;
};

// Removes the rows whose v0 is no_index, from `more` too if it is not null.
void drop_marked(TriangleColumns& rows, Column<std::uint32_t>* more);

} // namespace fastrt
