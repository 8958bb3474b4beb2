// SPDX-License-Identifier: Apache-2.0
#include "src/scene/shapes.hpp"
#include "src/trace/tracer_parts.hpp"

namespace fastrt {
namespace {

template <class Row>
void copy_box(const Aabb& box, Row& row) {
  copy(box.lower, row.low);
  copy(box.upper, row.high);
}

ConeRow row_of(const ConeShape& cone) {
  ConeRow row{};
  copy(cone.center, row.center);
  copy(cone.axis, row.axis);
  copy(cone.side, row.side);
  row.half_height = cone.half_height;
  row.radius = cone.radius;
  row.slope = cone.slope;
  row.capped = cone.capped ? 1 : 0;
  copy_box(cone.box, row);
  return row;
}

DiskRow row_of(const DiskShape& disk) {
  DiskRow row{};
  copy(disk.center, row.center);
  copy(disk.normal, row.normal);
  copy(disk.side, row.side);
  row.radius = disk.radius;
  copy_box(disk.box, row);
  return row;
}

PolygonRow row_of(const PolygonShape& polygon) {
  PolygonRow row{};
  copy(polygon.point, row.point);
  copy(polygon.normal, row.normal);
  copy(polygon.side, row.side);
  copy_box(polygon.box, row);
  row.axis_x = polygon.axis_x;
  row.axis_y = polygon.axis_y;
  row.first_edge = polygon.first_edge;
  row.edge_count = polygon.edge_count;
  return row;
}

EdgeRow row_of(const PolygonEdge& edge) { return {edge.low, edge.high, edge.x, edge.slope}; }

PlaneRow row_of(const PlaneShape& plane) {
  PlaneRow row{};
  copy(plane.point, row.point);
  copy(plane.normal, row.normal);
  copy(plane.side, row.side);
  return row;
}

void copy_map(const Affine& from, float (&to)[4][3]) {
  copy(from.x, to[0]);
  copy(from.y, to[1]);
  copy(from.z, to[2]);
  copy(from.origin, to[3]);
}

InstanceRow instance_row(const Scene& scene, std::size_t i, const std::vector<PrototypeTree>& prototypes) {
  const InstanceColumns& instances = scene.desc().instances;
  const InstanceShape& shape = scene.shapes().instances[i];
  const PrototypeTree& tree = prototypes[instances.prototype[i]];
  InstanceRow row{};
  copy_map(shape.to_object, row.to_object);
  copy_map(instances.to_world[i], row.to_world);
  copy_box(shape.box, row);
  row.growth = shape.growth;
  row.largest_coordinate = tree.largest_coordinate;
  row.root = tree.root;
  row.material = instances.material[i];
  row.object = instances.object[i];
  return row;
}

template <class Shape, class Row>
void fill(const std::vector<Shape>& shapes, const char* what, Column<Row>& rows) {
  check_row_count<Row>(shapes.size(), what);
  rows.resize(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) rows[i] = row_of(shapes[i]);
}

// Of a primitive, or of an instance by its number after all primitives.
const Aabb& box_of(const Scene& scene, std::uint32_t primitive) {
  if (primitive >= scene.primitive_count())
    return scene.shapes().instances[primitive - scene.primitive_count()].box;
  const PrimitiveKind kind = scene.kind(primitive);
  return box_of_shape(scene.shapes(), kind, primitive - scene.first_of(kind));
}

} // namespace

std::size_t ShapeRows::bytes() const noexcept {
  return cones.bytes() + disks.bytes() + polygons.bytes() + edges.bytes() + bands.bytes() + planes.bytes() +
         instances.bytes() + materials.bytes() + objects.bytes();
}

ShapeRows shape_rows(const Scene& scene, const std::vector<PrototypeTree>& prototypes) {
  ShapeRows rows;
  check_row_count<InstanceRow>(scene.instance_count(), "instances");
  rows.instances.resize(scene.instance_count());
  for (std::size_t i = 0; i < rows.instances.size(); ++i)
    rows.instances[i] = instance_row(scene, i, prototypes);
  fill(scene.shapes().cones, "cones", rows.cones);
  fill(scene.shapes().disks, "disks", rows.disks);
  fill(scene.shapes().polygons, "polygons", rows.polygons);
  fill(scene.shapes().edges, "edges of polygons", rows.edges);
  fill(scene.shapes().planes, "planes", rows.planes);
  add_bands(rows);
  const SceneDesc& desc = scene.desc();
  const auto append = [&](const auto& columns) {
    rows.materials.append(columns.material.data(), columns.size());
    rows.objects.append(columns.object.data(), columns.size());
  };
  append(desc.cones);
  append(desc.disks);
  append(desc.polygons);
  append(desc.planes);
  return rows;
}

ShapeView shape_view(const Scene& scene, const ShapeRows& rows) {
  ShapeView view{};
  view.cones = rows.cones.data();
  view.disks = rows.disks.data();
  view.polygons = rows.polygons.data();
  view.edges = rows.edges.data();
  view.bands = rows.bands.data();
  view.planes = rows.planes.data();
  view.instances = rows.instances.data();
  view.first_cone = static_cast<std::int32_t>(scene.first_of(PrimitiveKind::cone));
  view.first_disk = static_cast<std::int32_t>(scene.first_of(PrimitiveKind::disk));
  view.first_polygon = static_cast<std::int32_t>(scene.first_of(PrimitiveKind::polygon));
  view.first_plane = static_cast<std::int32_t>(scene.first_of(PrimitiveKind::plane));
  view.first_instance = static_cast<std::int32_t>(scene.primitive_count());
  view.plane_count = scene.count_of(PrimitiveKind::plane);
  view.instance_count = scene.instance_count();
  return view;
}

Column<ShapeBlock> shape_blocks(const Scene& scene, const Column<std::int32_t>& slots) {
  Column<ShapeBlock> blocks(slots.size() / block_size);
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    ShapeBlock& block = blocks[slot / block_size];
    const std::size_t i = slot % block_size;
    block.primitive[i] = slots[slot];
    Aabb box{Vec3(infinity), Vec3(-infinity)}; // a row that is not used is met by nothing
    if (slots[slot] >= 0) box = box_of(scene, static_cast<std::uint32_t>(slots[slot]));
    block.low_x[i] = box.lower.x;
    block.low_y[i] = box.lower.y;
    block.low_z[i] = box.lower.z;
    block.high_x[i] = box.upper.x;
    block.high_y[i] = box.upper.y;
    block.high_z[i] = box.upper.z;
  }
  return blocks;
}

} // namespace fastrt
