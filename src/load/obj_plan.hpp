// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/event_log.hpp"
#include "src/load/material_set.hpp"
#include "src/load/obj_scan.hpp"

#include <cstdint>
#include <vector>

namespace fastrt {

// In which state a chunk starts: how much of everything lies before it, and what is current there.
struct ObjState {
  ObjCounts before;
  std::uint32_t material = 0;
  std::uint32_t object = 0; // of the next face
  std::uint32_t smoothing = 0;
};

// What all chunks share in the second pass.
struct ObjPlan {
  ObjCounts totals;
  bool has_normals = false, has_uvs = false, has_smoothing = false;
  // `o` starts an object; in a file without, `g` does.
  bool objects_are_groups = false;
  // Faces before the first of them belong to an object of their own, number 0.
  bool has_unnamed_object = false;
  std::uint32_t default_material = 0;
  MaterialIds materials;
};

// A face of more than three corners. It lies in the triangle columns as a fan until all positions are known.
struct Polygon {
  std::uint32_t first_triangle;
  std::uint32_t corners;
};

// Something about a triangle: faces keep no place in the file.
struct Finding {
  std::uint64_t triangle;
  const char* kind;
  const char* message;
};

// What the second and third pass have to say about a chunk.
struct ObjChunkResult {
  EventLog log;
  std::vector<Polygon> polygons;
  bool uses_default_material = false;
  bool uses_normals = false, uses_uvs = false;
  bool has_colors = false;
  bool has_zero_normal = false;
  std::vector<Finding> findings;      // in the order of the triangles
  std::vector<std::uint32_t> dropped; // triangles, ascending
};

} // namespace fastrt
