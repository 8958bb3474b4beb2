// SPDX-License-Identifier: Apache-2.0
// Cones, disks, polygons and planes as rays meet them: what docs/numerics.md computes once per scene. Data
// that both paths share, like the columns themselves.
#pragma once

#include <fastrt/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastrt {

// The unit vector `side` is square to a shape's axis or normal n: (u, v) are counted from it towards n x
// side.

// Along the unit vector `axis` from -half_height to half_height the radius is radius + slope * height.
struct ConeShape {
  Vec3 center, axis, side;
  float half_height, radius, slope;
  bool capped;
  Aabb box;
};

struct DiskShape {
  Vec3 center, normal, side;
  float radius;
  Aabb box;
};

// A polygon's edge in the two coordinates that show most of it: it crosses the height y at x + (y - low) *
// slope where low <= y < high.
struct PolygonEdge {
  float low, high, x, slope;
};

// A plane through `point`, and the edges first_edge .. of SceneShapes::edges.
struct PolygonShape {
  Vec3 point, normal, side;
  std::uint32_t axis_x, axis_y;
  std::uint32_t first_edge, edge_count;
  Aabb box;
};

struct PlaneShape {
  Vec3 point, normal, side;
};

// An instance: the inverse of its map, the box in world space around what it shows (empty if that is
// nothing), and by how much the map and its inverse may blow up a rounding error.
struct InstanceShape {
  Affine to_object;
  Aabb box;
  float growth;
};

// Rows begin .. end - 1 of a kind's columns.
struct RowRange {
  std::uint32_t begin, end;
};
using KindRanges = std::array<std::vector<RowRange>, 5>; // of all kinds but planes

struct SceneShapes {
  std::vector<ConeShape> cones;
  std::vector<DiskShape> disks;
  std::vector<PolygonShape> polygons;
  std::vector<PolygonEdge> edges;
  std::vector<PlaneShape> planes;
  std::vector<InstanceShape> instances;
  KindRanges world; // the rows that are in no prototype
  std::size_t bytes() const noexcept;
};

// Of a cone, disk or polygon.
const Aabb& box_of_shape(const SceneShapes& shapes, PrimitiveKind kind, std::size_t row);

// Of a scene that has been checked.
SceneShapes make_shapes(const SceneDesc& desc);

// The rows that are in no prototype, in order. The scene need not have been checked.
KindRanges world_rows(const SceneDesc& desc);

// The inverse of a map and its growth (InstanceShape); false if it has none that floats can hold.
bool invert(const Affine& map, Affine& inverse, float& growth);
// The box around a map's image of a box, with a margin for rounding.
Aabb image_of(const Affine& map, const Aabb& box);
// Of a scene that has been checked.
std::vector<InstanceShape> make_instances(const SceneDesc& desc);

// The box around a prototype in its own space; of the primitives, not their margins. The scene need not have
// been checked.
Aabb bounds_of(const SceneDesc& desc, const Prototype& prototype);

// Boxes with a margin for the rounding of a shape's numbers; of rows that are finite.
Aabb cone_box(const ConeColumns& cones, std::size_t row);
Aabb disk_box(const DiskColumns& disks, std::size_t row);

// Where the contours of polygon `row` begin and end in vertex_end.
struct ContourRange {
  std::size_t first, end;
};
ContourRange contours_of(const PolygonColumns& polygons, std::size_t row);

// Where the vertices of a contour begin in `vertex`; it ends at vertex_end[contour].
std::size_t contour_begin(const PolygonColumns& polygons, std::size_t contour);

// The plane that the vertices of a polygon lie in, more or less. usable: they enclose some area.
struct PolygonPlane {
  glm::dvec3 point, normal; // unit
  double deviation;         // the largest distance of a vertex from it
  bool usable;
};
PolygonPlane plane_of(const SceneDesc& desc, std::size_t polygon);

// Whether no vertex is farther from the polygon's plane than a thousandth of the polygon's size.
bool is_flat(const SceneDesc& desc, std::size_t polygon, const PolygonPlane& plane);

} // namespace fastrt
