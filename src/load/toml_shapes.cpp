// SPDX-License-Identifier: Apache-2.0
// [[sphere]], [[cylinder]] and so on: one row of the scene each.
#include "src/load/scene_append.hpp"
#include "src/load/toml_scene.hpp"
#include "src/load/triangle_fault.hpp"
#include "src/scene/row_counts.hpp"
#include "src/scene/shapes.hpp"

#include <utility>

namespace fastrt {
namespace {

template <class Columns>
void push_owners(const TomlFields& fields, const char* kind, Columns& columns, TomlScene& scene) {
  columns.material.push_back(scene.material_of(fields));
  const auto name = fields.find("name");
  columns.object.push_back(scene.add_object(name ? name->text() : scene.next_name(kind)));
}

void add_sphere(const TomlFile&, const TomlFields& fields, TomlScene& scene) {
  Vec3 center(0.0F);
  float radius = 1;
  fields.read_vector("center", center);
  fields.read("radius", radius, positive);
  SphereColumns& spheres = scene.desc.spheres;
  spheres.x.push_back(center.x);
  spheres.y.push_back(center.y);
  spheres.z.push_back(center.z);
  spheres.radius.push_back(radius);
  push_owners(fields, "sphere", spheres, scene);
}

struct ConeEnds {
  Vec3 base{0.0F, 0.0F, -1.0F}, apex{0.0F, 0.0F, 1.0F};
  float base_radius = 1, apex_radius = 1;
};

void push_cone(const TomlFields& fields, const char* kind, ConeEnds ends, TomlScene& scene) {
  bool is_capped = true;
  fields.read_vector("base", ends.base);
  fields.read_vector("apex", ends.apex);
  fields.read("capped", is_capped);
  if (ends.base == ends.apex)
    fields.fail(fields.place(), fields.what() + ": base and apex are the same point");
  if (ends.base_radius == 0.0F && ends.apex_radius == 0.0F)
    fields.fail(fields.place(), fields.what() + ": one radius must be greater than 0");
  ConeColumns& cones = scene.desc.cones;
  cones.base.push_back(ends.base);
  cones.apex.push_back(ends.apex);
  cones.base_radius.push_back(ends.base_radius);
  cones.apex_radius.push_back(ends.apex_radius);
  cones.capped.push_back(is_capped ? 1 : 0);
  push_owners(fields, kind, cones, scene);
}

void add_cylinder(const TomlFile&, const TomlFields& fields, TomlScene& scene) {
  ConeEnds ends;
  fields.read("radius", ends.base_radius, positive);
  ends.apex_radius = ends.base_radius;
  push_cone(fields, "cylinder", ends, scene);
}

void add_cone(const TomlFile&, const TomlFields& fields, TomlScene& scene) {
  ConeEnds ends;
  ends.apex_radius = 0;
  fields.read("base_radius", ends.base_radius, not_negative);
  fields.read("apex_radius", ends.apex_radius, not_negative);
  push_cone(fields, "cone", ends, scene);
}

void add_disk(const TomlFile&, const TomlFields& fields, TomlScene& scene) {
  Vec3 center(0.0F), normal(0.0F, 0.0F, 1.0F);
  float radius = 1;
  fields.read_vector("center", center);
  fields.read_direction("normal", normal);
  fields.read("radius", radius, positive);
  DiskColumns& disks = scene.desc.disks;
  disks.center.push_back(center);
  disks.normal.push_back(normal);
  disks.radius.push_back(radius);
  push_owners(fields, "disk", disks, scene);
}

void push_contour(const std::vector<Vec3>& points, SceneDesc& desc) {
  PolygonColumns& polygons = desc.polygons;
  for (const Vec3& point : points) {
    polygons.vertex.push_back(checked_size(desc.positions.size(), "vertices"));
    desc.positions.push_back(point);
  }
  polygons.vertex_end.push_back(checked_size(polygons.vertex.size(), "vertices"));
}

void check_polygon(const TomlFields& fields, const SceneDesc& desc) {
  const std::size_t row = desc.polygons.contour_end.size() - 1;
  const PolygonPlane plane = plane_of(desc, row);
  if (!plane.usable) fields.fail(fields.place(), "[[polygon]]: its points lie on a line");
  if (!is_flat(desc, row, plane)) fields.fail(fields.place(), "[[polygon]]: it is not flat");
}

void add_polygon(const TomlFile&, const TomlFields& fields, TomlScene& scene) {
  push_contour(fields.need("points").vectors(3), scene.desc);
  if (const auto holes = fields.find("holes"))
    for (const TomlValue& hole : holes->elements()) push_contour(hole.vectors(3), scene.desc);
  PolygonColumns& polygons = scene.desc.polygons;
  polygons.contour_end.push_back(checked_size(polygons.vertex_end.size(), "contours"));
  check_polygon(fields, scene.desc);
  push_owners(fields, "polygon", polygons, scene);
}

// Corner i has the lower x, y, z where bit 0, 1, 2 of i is 0. Each face turns left as seen from outside.
constexpr std::uint32_t cube_faces[6][4] = {{0, 4, 6, 2}, {5, 1, 3, 7}, {0, 1, 5, 4},
                                            {6, 7, 3, 2}, {1, 0, 2, 3}, {4, 5, 7, 6}};

// Corner k of a face has the cube's texture coordinates k.
void push_cube_face(const std::uint32_t (&face)[4], const TomlFields& fields, SceneDesc& cube,
                    TomlScene& scene) {
  TriangleColumns& t = cube.triangles;
  for (const std::uint32_t k : {1U, 2U}) {
    const TriangleFault fault =
        fault_of_triangle(cube.positions[face[0]], cube.positions[face[k]], cube.positions[face[k + 1]]);
    if (fault != TriangleFault::none) {
      scene.warn(fields.file(), fields.place(), kind_of(fault), message_of(fault));
      continue;
    }
    t.v0.push_back(face[0]), t.v1.push_back(face[k]), t.v2.push_back(face[k + 1]);
    t.t0.push_back(0), t.t1.push_back(k), t.t2.push_back(k + 1);
  }
}

void add_cube(const TomlFile&, const TomlFields& fields, TomlScene& scene) {
  Vec3 lower(-1.0F), upper(1.0F);
  fields.read_vector("lower", lower);
  fields.read_vector("upper", upper);
  if (!glm::all(glm::lessThan(lower, upper)))
    fields.fail(fields.place(), "[[cube]]: 'upper' must be greater than 'lower' in x, y and z");
  SceneDesc cube;
  for (unsigned i = 0; i < 8; ++i)
    cube.positions.push_back({(i & 1U) != 0 ? upper.x : lower.x, (i & 2U) != 0 ? upper.y : lower.y,
                              (i & 4U) != 0 ? upper.z : lower.z});
  cube.uvs = {{0, 1, 1, 0}, {0, 0, 1, 1}};
  for (const auto& face : cube_faces) push_cube_face(face, fields, cube, scene);
  const std::uint32_t material = scene.material_of(fields);
  append_scene(scene.desc, std::move(cube));
  const auto name = fields.find("name");
  const std::uint32_t object = scene.add_object(name ? name->text() : scene.next_name("cube"));
  scene.desc.triangles.material.extend(scene.desc.triangles.size(), material);
  scene.desc.triangles.object.extend(scene.desc.triangles.size(), object);
}

} // namespace

const TomlShape* find_toml_shape(std::string_view name) {
  static const std::vector<TomlShape> shapes = {
      {"sphere", {"center", "radius"}, add_sphere},
      {"cylinder", {"base", "apex", "radius", "capped"}, add_cylinder},
      {"cone", {"base", "apex", "base_radius", "apex_radius", "capped"}, add_cone},
      {"disk", {"center", "normal", "radius"}, add_disk},
      {"polygon", {"points", "holes"}, add_polygon},
      {"cube", {"lower", "upper"}, add_cube},
      {"mesh", {"file", "materials", "points", "faces", "normals", "uvs", "colors"}, add_toml_mesh}};
  for (const TomlShape& shape : shapes)
    if (shape.name == name) return &shape;
  return nullptr;
}

} // namespace fastrt
