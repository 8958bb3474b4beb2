// SPDX-License-Identifier: Apache-2.0
#include "src/scene/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastrt {
namespace {

using Vec3d = glm::dvec3;

// What rounding may move the points of a shape by, as a share of its numbers.
constexpr double box_margin = 0x1p-22;

double largest_magnitude(const Vec3d& v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

// The box around low .. high, `margin` larger, in numbers that a tree can take.
Aabb rounded_box(const Vec3d& low, const Vec3d& high, double margin) {
  constexpr double most = std::numeric_limits<float>::max();
  const Vec3d grown_low = glm::clamp(low - margin, Vec3d(-most), Vec3d(most));
  const Vec3d grown_high = glm::clamp(high + margin, Vec3d(-most), Vec3d(most));
  return {Vec3(grown_low), Vec3(grown_high)};
}

// How far a circle of radius 1, square to the unit vector `axis`, reaches along x, y and z.
Vec3d circle_extent(const Vec3d& axis) { return glm::sqrt(glm::max(1.0 - axis * axis, Vec3d(0.0))); }

// Divided by its largest part first, so that the square neither overflows nor vanishes.
Vec3d unit(const Vec3d& v) { return glm::normalize(v / largest_magnitude(v)); }

// Square to the unit vector n: along x if that is not too near, else along z.
Vec3 side_of(const Vec3d& n) {
  const Vec3d along = std::fabs(n.x) < 0.9 ? Vec3d(1, 0, 0) : Vec3d(0, 0, 1);
  return Vec3(unit(along - glm::dot(along, n) * n));
}

ConeShape make_cone(const ConeColumns& cones, std::size_t row) {
  const Vec3d base(cones.base[row]);
  const Vec3d apex(cones.apex[row]);
  const double r0 = static_cast<double>(cones.base_radius[row]);
  const double r1 = static_cast<double>(cones.apex_radius[row]);
  const double size = largest_magnitude(apex - base);
  const double height = size * glm::length((apex - base) / size);
  return {Vec3(0.5 * (base + apex)),
          Vec3(unit(apex - base)),
          side_of(unit(apex - base)),
          static_cast<float>(0.5 * height),
          static_cast<float>(0.5 * (r0 + r1)),
          static_cast<float>((r1 - r0) / height),
          cones.capped[row] != 0,
          cone_box(cones, row)};
}

DiskShape make_disk(const DiskColumns& disks, std::size_t row) {
  const Vec3d normal = unit(Vec3d(disks.normal[row]));
  return {disks.center[row], Vec3(normal), side_of(normal), disks.radius[row], disk_box(disks, row)};
}

PlaneShape make_plane(const PlaneColumns& planes, std::size_t row) {
  const Vec3d normal = unit(Vec3d(planes.normal[row]));
  return {planes.point[row], Vec3(normal), side_of(normal)};
}

// The contour around its first vertex: twice its area along its normal.
struct ContourArea {
  Vec3d sum{0.0}, largest{0.0}; // of all corners' triangles, and the largest of these
  double total = 0;             // of their magnitudes
};

ContourArea area_of(const SceneDesc& desc, std::size_t begin, std::size_t end) {
  const auto position = [&](std::size_t i) { return Vec3d(desc.positions[desc.polygons.vertex[i]]); };
  const Vec3d origin = position(begin);
  ContourArea area;
  for (std::size_t i = begin + 1; i + 1 < end; ++i) {
    const Vec3d corner = glm::cross(position(i) - origin, position(i + 1) - origin);
    area.sum += corner;
    area.total += glm::length(corner);
    if (glm::length(corner) > glm::length(area.largest)) area.largest = corner;
  }
  return area;
}

// The polygon's edges in the plane of axis_x and axis_y. Level ones cross no height.
void add_edges(const SceneDesc& desc, std::size_t row, PolygonShape& shape, std::vector<PolygonEdge>& edges) {
  const PolygonColumns& polygons = desc.polygons;
  const auto [first, last] = contours_of(polygons, row);
  const auto axis_x = static_cast<int>(shape.axis_x), axis_y = static_cast<int>(shape.axis_y);
  shape.first_edge = static_cast<std::uint32_t>(edges.size());
  for (std::size_t contour = first; contour < last; ++contour) {
    const std::size_t begin = contour_begin(polygons, contour), end = polygons.vertex_end[contour];
    for (std::size_t i = begin; i < end; ++i) {
      Vec3 low = desc.positions[polygons.vertex[i]];
      Vec3 high = desc.positions[polygons.vertex[i + 1 < end ? i + 1 : begin]];
      if (low[axis_y] == high[axis_y]) continue;
      if (low[axis_y] > high[axis_y]) std::swap(low, high);
      const double slope = (static_cast<double>(high[axis_x]) - static_cast<double>(low[axis_x])) /
                           (static_cast<double>(high[axis_y]) - static_cast<double>(low[axis_y]));
      edges.push_back({low[axis_y], high[axis_y], low[axis_x], static_cast<float>(slope)});
    }
  }
  shape.edge_count = static_cast<std::uint32_t>(edges.size()) - shape.first_edge;
}

// The box of the vertices, with room for a plane that does not go through all of them.
Aabb polygon_box(const SceneDesc& desc, std::size_t row, double deviation) {
  const PolygonColumns& polygons = desc.polygons;
  const auto [first, last] = contours_of(polygons, row);
  Aabb box;
  for (std::size_t i = contour_begin(polygons, first); i < polygons.vertex_end[last - 1]; ++i)
    box.extend(desc.positions[polygons.vertex[i]]);
  const Vec3d low(box.lower), high(box.upper);
  const double size = std::max(largest_magnitude(low), largest_magnitude(high));
  return rounded_box(low, high, 2.0 * deviation + box_margin * size);
}

PolygonShape make_polygon(const SceneDesc& desc, std::size_t row, std::vector<PolygonEdge>& edges) {
  const PolygonPlane plane = plane_of(desc, row);
  PolygonShape shape{};
  shape.point = Vec3(plane.point);
  shape.normal = Vec3(plane.normal);
  shape.side = side_of(plane.normal);
  const Vec3d size = glm::abs(plane.normal);
  const std::uint32_t across = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  shape.axis_x = (across + 1) % 3;
  shape.axis_y = (across + 2) % 3;
  shape.box = polygon_box(desc, row, plane.deviation);
  add_edges(desc, row, shape, edges);
  return shape;
}

} // namespace

std::size_t SceneShapes::bytes() const noexcept {
  return cones.capacity() * sizeof(ConeShape) + disks.capacity() * sizeof(DiskShape) +
         polygons.capacity() * sizeof(PolygonShape) + edges.capacity() * sizeof(PolygonEdge) +
         planes.capacity() * sizeof(PlaneShape) + instances.capacity() * sizeof(InstanceShape);
}

Aabb cone_box(const ConeColumns& cones, std::size_t row) {
  const Vec3d base(cones.base[row]);
  const Vec3d apex(cones.apex[row]);
  const Vec3d extent = base == apex ? Vec3d(1.0) : circle_extent(unit(apex - base));
  const Vec3d at_base = static_cast<double>(cones.base_radius[row]) * extent;
  const Vec3d at_apex = static_cast<double>(cones.apex_radius[row]) * extent;
  const Vec3d low = glm::min(base - at_base, apex - at_apex);
  const Vec3d high = glm::max(base + at_base, apex + at_apex);
  return rounded_box(low, high, box_margin * std::max(largest_magnitude(low), largest_magnitude(high)));
}

Aabb disk_box(const DiskColumns& disks, std::size_t row) {
  const Vec3d center(disks.center[row]);
  const Vec3d normal(disks.normal[row]);
  const Vec3d extent = normal == Vec3d(0.0) ? Vec3d(1.0) : circle_extent(unit(normal));
  const Vec3d reach = static_cast<double>(disks.radius[row]) * extent;
  return rounded_box(center - reach, center + reach,
                     box_margin * (largest_magnitude(center) + largest_magnitude(reach)));
}

ContourRange contours_of(const PolygonColumns& polygons, std::size_t row) {
  return {row == 0 ? 0 : polygons.contour_end[row - 1], polygons.contour_end[row]};
}

std::size_t contour_begin(const PolygonColumns& polygons, std::size_t contour) {
  return contour == 0 ? 0 : polygons.vertex_end[contour - 1];
}

PolygonPlane plane_of(const SceneDesc& desc, std::size_t polygon) {
  const PolygonColumns& polygons = desc.polygons;
  const auto [first, last] = contours_of(polygons, polygon);
  const std::size_t begin = contour_begin(polygons, first), end = polygons.vertex_end[last - 1];
  const auto position = [&](std::size_t i) { return Vec3d(desc.positions[polygons.vertex[i]]); };
  PolygonPlane plane{};
  for (std::size_t i = begin; i < end; ++i) plane.point += position(i);
  plane.point /= static_cast<double>(end - begin);

  // The largest contour says how the polygon lies: the holes' normals may point either way. One that crosses
  // itself may have none left; then its largest corner does.
  Vec3d normal(0.0);
  for (std::size_t contour = first; contour < last; ++contour) {
    const ContourArea area = area_of(desc, contour_begin(polygons, contour), polygons.vertex_end[contour]);
    const Vec3d candidate = glm::length(area.sum) > 1e-6 * area.total ? area.sum : area.largest;
    if (glm::length(candidate) > glm::length(normal)) normal = candidate;
  }
  plane.usable = largest_magnitude(normal) > 0.0;
  if (!plane.usable) return plane;
  plane.normal = unit(normal);
  // As floats: what rays will meet.
  const Vec3d point{Vec3(plane.point)};
  const Vec3d rounded{Vec3(plane.normal)};
  for (std::size_t i = begin; i < end; ++i)
    plane.deviation = std::max(plane.deviation, std::fabs(glm::dot(position(i) - point, rounded)));
  return plane;
}

bool is_flat(const SceneDesc& desc, std::size_t polygon, const PolygonPlane& plane) {
  constexpr double most_bent = 1e-3;
  const PolygonColumns& polygons = desc.polygons;
  const auto [first, last] = contours_of(polygons, polygon);
  Aabb box;
  for (std::size_t i = contour_begin(polygons, first); i < polygons.vertex_end[last - 1]; ++i)
    box.extend(desc.positions[polygons.vertex[i]]);
  return !(plane.deviation > most_bent * static_cast<double>(glm::length(box.extent())));
}

const Aabb& box_of_shape(const SceneShapes& shapes, PrimitiveKind kind, std::size_t row) {
  if (kind == PrimitiveKind::cone) return shapes.cones[row].box;
  if (kind == PrimitiveKind::disk) return shapes.disks[row].box;
  return shapes.polygons[row].box;
}

SceneShapes make_shapes(const SceneDesc& desc) {
  SceneShapes shapes;
  for (std::size_t i = 0; i < desc.cones.size(); ++i) shapes.cones.push_back(make_cone(desc.cones, i));
  for (std::size_t i = 0; i < desc.disks.size(); ++i) shapes.disks.push_back(make_disk(desc.disks, i));
  for (std::size_t i = 0; i < desc.polygons.size(); ++i)
    shapes.polygons.push_back(make_polygon(desc, i, shapes.edges));
  for (std::size_t i = 0; i < desc.planes.size(); ++i) shapes.planes.push_back(make_plane(desc.planes, i));
  shapes.instances = make_instances(desc);
  shapes.world = world_rows(desc);
  return shapes;
}

} // namespace fastrt
