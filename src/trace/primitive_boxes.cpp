// SPDX-License-Identifier: Apache-2.0
#include "src/trace/primitive_boxes.hpp"

#include "src/accel/parallel.hpp"
#include "src/scene/shapes.hpp"
#include "src/trace/scene_view.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cstddef>

namespace fastrt {
namespace {

PrimitiveBox box_of(const Aabb& bounds, std::uint32_t id, std::uint32_t group) {
  return {{bounds.lower.x, bounds.lower.y, bounds.lower.z},
          id,
          {bounds.upper.x, bounds.upper.y, bounds.upper.z},
          group};
}

constexpr std::size_t boxes_per_task = std::size_t{1} << 14U;

// As Aabb::extend does, NaN and -0 included, in SSE2 registers.
PrimitiveBox triangle_box(const SceneDesc& desc, std::size_t row) {
  __m128 lower = _mm_set1_ps(infinity), upper = _mm_set1_ps(-infinity);
  for (const std::uint32_t v : {desc.triangles.v0[row], desc.triangles.v1[row], desc.triangles.v2[row]}) {
    const __m128 point = _mm_setr_ps(desc.positions.x[v], desc.positions.y[v], desc.positions.z[v], 0.0F);
    lower = _mm_min_ps(point, lower);
    upper = _mm_max_ps(point, upper);
  }
  PrimitiveBox box;
  _mm_storeu_ps(box.lower, lower);
  _mm_storeu_ps(box.upper, upper);
  box.id = static_cast<std::uint32_t>(row);
  box.group = triangle_group;
  return box;
}

PrimitiveBox* put_triangle_boxes(const Scene& scene, const RowRange& rows, PrimitiveBox* to) {
  const std::size_t count = rows.end - rows.begin;
  for_each_piece(count, boxes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) to[i] = triangle_box(scene.desc(), rows.begin + i);
  });
  return to + count;
}

PrimitiveBox sphere_box(const Scene& scene, std::uint32_t row) {
  const SphereColumns& spheres = scene.spheres();
  const Vec3 center{spheres.x[row], spheres.y[row], spheres.z[row]}, size = glm::abs(center);
  const float radius = spheres.radius[row];
  // Two ulps more than the radius, so that no rounding leaves the rim outside.
  const Vec3 reach{radius + 0x1p-22F * (radius + std::max({size.x, size.y, size.z}))};
  return box_of({center - reach, center + reach}, scene.triangle_count() + row, sphere_group);
}

PrimitiveBox shape_box(const Scene& scene, PrimitiveKind kind, std::uint32_t row) {
  return box_of(box_of_shape(scene.shapes(), kind, row), scene.first_of(kind) + row, shape_group);
}

// Writes the boxes of some rows of a kind; returns where the next go.
PrimitiveBox* put_boxes(const Scene& scene, std::size_t kind, const RowRange& rows, PrimitiveBox* to) {
  const auto primitive = static_cast<PrimitiveKind>(kind);
  if (primitive == PrimitiveKind::triangle) return put_triangle_boxes(scene, rows, to);
  for (std::uint32_t row = rows.begin; row < rows.end; ++row)
    *to++ = primitive == PrimitiveKind::sphere ? sphere_box(scene, row) : shape_box(scene, primitive, row);
  return to;
}

} // namespace

Column<PrimitiveBox> world_boxes(const Scene& scene) {
  const KindRanges& world = scene.shapes().world;
  std::size_t count = 0;
  for (const auto& ranges : world)
    for (const RowRange& rows : ranges) count += rows.end - rows.begin;
  Column<PrimitiveBox> boxes(count);
  PrimitiveBox* to = boxes.data();
  for (std::size_t kind = 0; kind < world.size(); ++kind)
    for (const RowRange& rows : world[kind]) to = put_boxes(scene, kind, rows, to);
  for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
    const Aabb& box = scene.shapes().instances[i].box;
    if (!box.empty()) boxes.push_back(box_of(box, scene.primitive_count() + i, shape_group));
  }
  return boxes;
}

Column<PrimitiveBox> prototype_boxes(const Scene& scene, const Prototype& prototype) {
  std::size_t count = 0;
  for (std::size_t kind = 0; kind < prototype.begin.size(); ++kind)
    count += prototype.end[kind] - prototype.begin[kind];
  Column<PrimitiveBox> boxes(count);
  PrimitiveBox* to = boxes.data();
  for (std::size_t kind = 0; kind < prototype.begin.size(); ++kind)
    to = put_boxes(scene, kind, {prototype.begin[kind], prototype.end[kind]}, to);
  return boxes;
}

} // namespace fastrt
