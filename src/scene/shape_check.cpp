// SPDX-License-Identifier: Apache-2.0
// Cones, disks, polygons and planes before anything is traced.
#include "src/scene/finite.hpp"
#include "src/scene/scene_check.hpp"
#include "src/scene/shapes.hpp"

#include <fastrt/error.hpp>

#include <cmath>
#include <initializer_list>

namespace fastrt {
namespace {

[[noreturn]] void refuse(const char* what, std::size_t i, const std::string& why) {
  throw InputError(std::string(what) + " " + std::to_string(i) + ": " + why);
}

// All columns of a kind are as long as `count`.
void check_lengths(const char* what, std::size_t count, std::initializer_list<std::size_t> lengths) {
  for (const std::size_t length : lengths)
    if (length != count) throw InputError(std::string("the ") + what + "s' columns differ in length");
}

template <class Columns>
void check_owners(const SceneDesc& desc, const Columns& columns, const char* what, std::size_t i) {
  if (columns.material[i] >= desc.materials.size())
    refuse(what, i,
           "refers to material " + std::to_string(columns.material[i]) + ", but there are " +
               std::to_string(desc.materials.size()));
  if (columns.object[i] >= desc.object_names.size())
    refuse(what, i,
           "refers to object " + std::to_string(columns.object[i]) + ", but there are " +
               std::to_string(desc.object_names.size()));
}

void check_point(const char* what, std::size_t i, const char* name, const Vec3& point) {
  if (!is_finite(point)) refuse(what, i, std::string("the ") + name + " is not finite");
}

void check_normal(const char* what, std::size_t i, const Vec3& normal) {
  if (!is_finite(normal) || normal == Vec3(0.0F)) refuse(what, i, "the normal must be finite and not 0");
}

void check_cones(const SceneDesc& desc) {
  const ConeColumns& c = desc.cones;
  check_lengths("cone", c.size(),
                {c.base.x.size(), c.base.y.size(), c.base.z.size(), c.apex.x.size(), c.apex.y.size(),
                 c.apex.z.size(), c.apex_radius.size(), c.capped.size(), c.material.size(), c.object.size()});
  for (std::size_t i = 0; i < c.size(); ++i) {
    check_point("cone", i, "base", c.base[i]);
    check_point("cone", i, "apex", c.apex[i]);
    if (c.base[i] == c.apex[i]) refuse("cone", i, "base and apex are the same point");
    const float r0 = c.base_radius[i], r1 = c.apex_radius[i];
    if (!(std::isfinite(r0) && std::isfinite(r1) && r0 >= 0.0F && r1 >= 0.0F))
      refuse("cone", i, "the radii must be finite and not negative");
    if (r0 == 0.0F && r1 == 0.0F) refuse("cone", i, "one radius must be greater than 0");
    check_owners(desc, c, "cone", i);
  }
}

void check_disks(const SceneDesc& desc) {
  const DiskColumns& d = desc.disks;
  check_lengths("disk", d.size(),
                {d.center.x.size(), d.center.y.size(), d.center.z.size(), d.normal.x.size(),
                 d.normal.y.size(), d.normal.z.size(), d.material.size(), d.object.size()});
  for (std::size_t i = 0; i < d.size(); ++i) {
    check_point("disk", i, "middle", d.center[i]);
    check_normal("disk", i, d.normal[i]);
    if (!(std::isfinite(d.radius[i]) && d.radius[i] > 0.0F))
      refuse("disk", i, "the radius must be greater than 0");
    check_owners(desc, d, "disk", i);
  }
}

// Ends go up and reach exactly `count`.
bool are_ends(const Column<std::uint32_t>& ends, std::size_t count, std::uint32_t least_step) {
  std::uint64_t last = 0;
  for (const std::uint32_t end : ends) {
    if (end < last + least_step) return false;
    last = end;
  }
  return last == count;
}

void check_polygons(const SceneDesc& desc) {
  const PolygonColumns& p = desc.polygons;
  check_lengths("polygon", p.size(), {p.material.size(), p.object.size()});
  if (!are_ends(p.contour_end, p.vertex_end.size(), 1))
    throw InputError("every polygon must have its contours, at least one");
  if (!are_ends(p.vertex_end, p.vertex.size(), 3))
    throw InputError("every contour of a polygon must have its vertices, at least three");
  for (const std::uint32_t vertex : p.vertex)
    if (vertex >= desc.positions.size())
      throw InputError("a polygon refers to vertex " + std::to_string(vertex) + ", but there are " +
                       std::to_string(desc.positions.size()));
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!plane_of(desc, i).usable) refuse("polygon", i, "its vertices lie on a line");
    check_owners(desc, p, "polygon", i);
  }
}

void check_planes(const SceneDesc& desc) {
  const PlaneColumns& p = desc.planes;
  check_lengths("plane", p.size(),
                {p.point.y.size(), p.point.z.size(), p.normal.x.size(), p.normal.y.size(), p.normal.z.size(),
                 p.material.size(), p.object.size()});
  for (std::size_t i = 0; i < p.size(); ++i) {
    check_point("plane", i, "point", p.point[i]);
    check_normal("plane", i, p.normal[i]);
    check_owners(desc, p, "plane", i);
  }
}

} // namespace

void check_shapes(const SceneDesc& desc) {
  check_cones(desc);
  check_disks(desc);
  check_polygons(desc);
  check_planes(desc);
}

} // namespace fastrt
